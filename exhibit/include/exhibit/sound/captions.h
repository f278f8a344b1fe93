// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exhibit/sound/heard_event.h"

namespace afm::exhibit {

// The caption of what is heard, on the wall: of the newest event, for some seconds. None is replaced sooner than after
// kLeastNs, so that it never flashes more than three times a second (WCAG 2.3.1); and what comes often, such as slips,
// does not push away what comes once. One thread.
class Captions {
 public:
  static constexpr std::int64_t kShownNs = 4'000'000'000;
  static constexpr std::int64_t kReadableNs = 2'000'000'000;  // before what comes often
  static constexpr std::int64_t kLeastNs = 400'000'000;       // before anything else

  void add(HeardEvent event, std::string text, std::int64_t now_ns);

  // Empty: none.
  const std::string& text(std::int64_t now_ns);

 private:
  struct Caption {
    std::string text;
    bool often = false;
  };

  Caption shown_;
  std::optional<Caption> next_;
  std::int64_t since_ns_ = 0;
};

}  // namespace afm::exhibit
