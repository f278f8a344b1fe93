// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exhibit/sound/heard_event.h"

namespace afm::exhibit {

// Caption of the newest event, shown on the wall for some seconds. Each is shown for at least kLeastNs, so that
// captions never flash more than three times a second (WCAG 2.3.1); frequent events, such as slips, do not replace rare
// ones. One thread.
class Captions {
 public:
  static constexpr std::int64_t kShownNs = 4'000'000'000;
  static constexpr std::int64_t kReadableNs = 2'000'000'000;  // shortest display before a frequent event
  static constexpr std::int64_t kLeastNs = 400'000'000;       // shortest display before any other event

  void add(HeardEvent event, std::string text, std::int64_t now_ns);

  // The caption at this time, or empty.
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
