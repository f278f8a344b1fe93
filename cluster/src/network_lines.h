// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace afm::cluster {

// Limits the lines of DDS's log: any machine of the network can cause them. Any thread.
class NetworkLines {
 public:
  static constexpr std::int64_t kPauseNs = 60'000'000'000;
  static constexpr std::size_t kLongest = 200;  // bytes per line

  // Line to log for a message of DDS, or none within kPauseNs of the previous one. A line counts the messages left
  // out before it.
  std::optional<std::string> line(std::string_view message, std::int64_t now_ns);

 private:
  std::mutex mutex_;
  std::optional<std::int64_t> logged_ns_;
  std::uint64_t left_out_ = 0;
};

}  // namespace afm::cluster
