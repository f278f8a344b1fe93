// SPDX-License-Identifier: Apache-2.0
#include "app/commands/fault_bundle.h"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string_view>

#include "core/printable.h"
#include "core/version.h"

namespace afm::app {

namespace {

constexpr std::size_t kShortestName = 3;

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

void replace_word(std::string& text, const std::string& word, std::string_view by) {
  if (word.size() < kShortestName) return;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
    const std::size_t end = at + word.size();
    const bool whole = (at == 0 || !in_word(text[at - 1])) && (end == text.size() || !in_word(text[end]));
    if (whole) text.replace(at, word.size(), by);
    at += whole ? by.size() : word.size();
  }
}

// Replaces /home/NAME of any user.
void replace_homes(std::string& text) {
  constexpr std::string_view kHomes = "/home/";
  for (std::size_t at = text.find(kHomes); at != std::string::npos; at = text.find(kHomes, at)) {
    const std::size_t end = text.find_first_of("/ \t\n\"':,;)", at + kHomes.size());
    text.replace(at, std::min(end, text.size()) - at, "~");
  }
}

// Value in the first line of the file that begins with `key`, without quotes.
std::string line_of(const char* path, std::string_view key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    std::string value = line.substr(std::min(line.find_first_of("=:") + 1, line.size()));
    std::erase(value, '"');
    value.erase(0, std::min(value.find_first_not_of(" \t"), value.size()));
    return core::printable(value);
  }
  return "unknown";
}

std::string nodes_text(const char* what, const std::vector<DeviceNode>& nodes) {
  std::string text;
  for (const DeviceNode& node : nodes) {
    text += fmt::format("{} {}: {}\n", what, node.path, node.accessible ? "accessible" : "not accessible");
  }
  return text;
}

}  // namespace

PrivateWords private_words() {
  PrivateWords secrets;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): the command has no other thread that asks
  if (const passwd* const user = ::getpwuid(::getuid()); user != nullptr) {
    secrets.home = user->pw_dir;
    if (::getuid() != 0) secrets.user = user->pw_name;
  }
  utsname names{};
  if (::uname(&names) == 0) secrets.host = names.nodename;
  return secrets;
}

std::string without(const PrivateWords& secrets, std::string text) {
  if (secrets.home.size() >= kShortestName) {
    for (std::size_t at = text.find(secrets.home); at != std::string::npos; at = text.find(secrets.home, at + 1)) {
      text.replace(at, secrets.home.size(), "~");
    }
  }
  replace_homes(text);
  replace_word(text, secrets.user, "USER");
  replace_word(text, secrets.host, "HOST");
  return text;
}

std::string fault_bundle(const MachineFacts& facts, const std::string& findings) {
  utsname machine{};
  ::uname(&machine);
  std::string text = fmt::format(
      "TouchAFM fault report\n"
      "=====================\n\n"
      "Please add: what you did, what you saw, what you expected, and everything that touchafm printed.\n"
      "This report leaves out the names of people, of this computer and of home folders. Read it before you send "
      "it.\n\n");
  text += fmt::format("touchafm {}\ncompiler: {}\nsystem: {}, {}\nkernel: {}\nprocessor: {}, {} in use\nmemory: {}\n",
                      core::kVersion, __VERSION__, line_of("/etc/os-release", "PRETTY_NAME"), machine.machine,
                      facts.kernel, line_of("/proc/cpuinfo", "model name"), ::sysconf(_SC_NPROCESSORS_ONLN),
                      line_of("/proc/meminfo", "MemTotal"));
  text += fmt::format("display: {}\n\nGraphics\n--------\n", facts.display.empty() ? "none" : facts.display);
  for (const render::DeviceDescription& device : facts.graphics) {
    text += fmt::format("{}: {}, {}; {}\n", device.name, device.kind, device.driver,
                        device.usable ? "usable" : device.reason);
  }
  if (!facts.graphics_refusal.empty()) text += facts.graphics_refusal + "\n";
  text += "\nDevices\n-------\n" + nodes_text("graphics", facts.render_nodes) + nodes_text("HID", facts.hid_nodes) +
          nodes_text("serial", facts.serial_nodes);
  for (const haptics::ProbeLine& line : facts.haptics) {
    text += fmt::format("haptic {}: {}; {}\n", line.subject, line.usable ? "usable" : "not usable",
                        core::printable(line.said));
  }
  text += "\nFindings of touchafm doctor\n---------------------------\n" + findings;
  return without(private_words(), std::move(text));
}

}  // namespace afm::app
