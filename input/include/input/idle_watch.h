// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::input {

// Detects from the input whether a visitor is present. One thread.
class IdleWatch {
 public:
  enum class Change { None, WentAway, CameBack };

  explicit IdleWatch(std::int64_t patience_ns) : patience_ns_(patience_ns) {}

  // Call once per frame; `used` is true after any press, motion or pointing since the last call.
  Change update(bool used, std::int64_t now_ns);

  bool away() const { return away_; }

 private:
  std::int64_t patience_ns_;
  std::int64_t used_ns_ = 0;
  bool began_ = false;
  bool away_ = false;
};

}  // namespace afm::input
