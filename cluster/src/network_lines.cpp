// SPDX-License-Identifier: Apache-2.0
#include "network_lines.h"

#include <fmt/format.h>

#include <utility>

namespace afm::cluster {

std::optional<std::string> NetworkLines::line(std::string_view message, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  if (logged_ns_ && now_ns - *logged_ns_ < kPauseNs) {
    ++left_out_;
    return std::nullopt;
  }
  logged_ns_ = now_ns;
  while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) message.remove_suffix(1);
  std::string text = fmt::format("cluster: DDS reports: {}", message.substr(0, kLongest));
  if (message.size() > kLongest) text += " ...";
  if (const std::uint64_t before = std::exchange(left_out_, 0); before > 0)
    text += fmt::format(" ({} more lines before it)", before);
  return text;
}

}  // namespace afm::cluster
