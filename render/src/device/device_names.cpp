// SPDX-License-Identifier: Apache-2.0
#include "device/device_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace afm::render {
namespace {

std::string small_letters(std::string text) {
  for (char& letter : text) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::vector<std::string> distinct_names(std::vector<std::string> names) {
  const std::vector<std::string> given = names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto before = std::count(given.begin(), given.begin() + static_cast<std::ptrdiff_t>(i), given[i]);
    if (before > 0) names[i] += fmt::format(" #{}", before + 1);
  }
  return names;
}

core::Result<std::size_t> find_device(const std::vector<std::string>& names, const std::string& wanted) {
  const std::string part = small_letters(wanted);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = small_letters(names[i]);
    if (name == part) return i;
    if (name.find(part) != std::string::npos) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("no graphics device is called '{}': this machine has '{}'", wanted, fmt::join(names, "', '")));
  }
  std::vector<std::string> meant;
  meant.reserve(found.size());
  for (const std::size_t i : found) meant.push_back(names[i]);
  return core::wrong_usage(fmt::format("'{}' could be any of the graphics devices '{}': give the whole name", wanted,
                                       fmt::join(meant, "', '")));
}

}  // namespace afm::render
