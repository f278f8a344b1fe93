// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/result.h"
#include "exhibit/words/guidance.h"

namespace afm::exhibit {
class LiveScan;
}

namespace afm::app {

// Scan on the wall; null `scan`: none.
struct ShownScan {
  const exhibit::LiveScan* scan = nullptr;
  std::size_t material = 0;
  std::uint64_t begun = 0;  // number of scans started so far
};

// State that controls share with the loop and with each other.
struct ViewTurn {
  bool leaving = false;                             // true: window to be closed after this frame
  std::optional<core::Error> failure;               // failure that closes the window; sets the exit code
  bool draws_unseen = false;                        // true: frames drawn even while all windows are hidden
  bool paced = false;                               // true: frame rate limited elsewhere, so the loop does not wait
  bool blank = false;                               // true: picture hidden, for users who rely on sound and touch
  bool dark = false;                                // true: picture hidden until a blind task ends
  std::function<bool(std::int64_t now_ns)> unseen;  // true while nobody sees the picture; unset: unknown
  std::function<std::int64_t(std::int64_t now_ns)> seen_elsewhere_ns;  // newest picture of the sample on other machines
  exhibit::Hint hint = exhibit::Hint::ChooseSample;                    // next step of the procedure
  ShownScan scan;
};

}  // namespace afm::app
