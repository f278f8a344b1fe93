// SPDX-License-Identifier: Apache-2.0
#include "app/options/wrapped_help.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "core/printable.h"

namespace afm::app {

namespace {

// Column of the description behind two blanks or more; otherwise that of the first word.
std::size_t description_at(std::string_view line) {
  const std::size_t word = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", word);
  return gap == std::string_view::npos ? word : std::min(line.find_first_not_of(' ', gap), line.size());
}

void add_wrapped(std::string_view line, std::size_t columns, std::string& text) {
  constexpr std::size_t kStep = 4;
  if (core::count_characters(line) <= columns) {
    text.append(line);
    return;
  }
  const std::size_t word = std::min(line.find_first_not_of(' '), line.size()), described = description_at(line);
  const std::size_t indent = std::min(described <= columns / 2 ? described : word + kStep, columns / 2);
  text.append(line.substr(0, described));
  std::size_t used = core::count_characters(line.substr(0, described));
  bool begins = true;  // no blank before the first word of a line
  for (line.remove_prefix(described); !line.empty();) {
    const std::size_t end = std::min(line.find(' '), line.size()), width = core::count_characters(line.substr(0, end));
    if (used > indent && used + (begins ? 0 : 1) + width > columns) {
      text.erase(text.find_last_not_of(' ') + 1);
      text.append("\n").append(indent, ' ');
      used = indent;
      begins = true;
    }
    if (!begins) text.push_back(' ');
    used += width + (begins ? 0 : 1);
    text.append(line.substr(0, end));
    begins = false;
    line.remove_prefix(std::min(end + 1, line.size()));
  }
}

}  // namespace

std::string wrapped_help(std::string_view text, std::size_t columns) {
  std::string wrapped;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    add_wrapped(text.substr(0, end), columns, wrapped);
    if (end < text.size()) wrapped.push_back('\n');
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return wrapped;
}

std::size_t terminal_columns() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace afm::app
