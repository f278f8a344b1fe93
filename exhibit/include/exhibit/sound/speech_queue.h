// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace afm::exhibit {

enum class SpeechKind { Event, Guidance };

struct SpeechText {
  std::string text;
  SpeechKind kind = SpeechKind::Guidance;
};

// Selects the next text to speak: the newest. An event, or the answer to key Y, interrupts any speech. Guidance
// interrupts only older guidance, and waits for the end of an event. At most one text of each kind waits, so many texts
// at once end in the newest. One thread.
class SpeechQueue {
 public:
  void offer(SpeechText text);

  // Text to begin now, or empty; it interrupts the previous one. Report the end of its speech as soon as it is
  // known: until then no guidance follows an event.
  std::optional<SpeechText> take(std::int64_t now_ns);
  void spoken_until(std::int64_t end_ns) { end_ns_ = end_ns; }

  // Earliest time at which take() may return a text without a new offer; empty if none waits, 0 if it is due.
  std::optional<std::int64_t> next_ns() const;

 private:
  std::optional<SpeechText> event_, guidance_;
  SpeechKind speaking_ = SpeechKind::Guidance;
  std::int64_t end_ns_ = 0;
};

}  // namespace afm::exhibit
