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

// What is spoken next: the newest. An event, or an answer to the key Y, cuts off whatever is spoken. Guidance cuts off
// older guidance alone, and waits until an event has been spoken. One text of each kind waits at most: a flood ends in
// its newest text. One thread.
class SpeechQueue {
 public:
  void offer(SpeechText text);

  // The text that begins now, if one does; it cuts off the one before. As soon as it is known, say when it will have
  // been spoken: until then an event is not followed by guidance.
  std::optional<SpeechText> take(std::int64_t now_ns);
  void spoken_until(std::int64_t end_ns) { end_ns_ = end_ns; }

  // When take() may give a text without a new offer: none waits, or at once, or then.
  std::optional<std::int64_t> next_ns() const;

 private:
  std::optional<SpeechText> event_, guidance_;
  SpeechKind speaking_ = SpeechKind::Guidance;
  std::int64_t end_ns_ = 0;
};

}  // namespace afm::exhibit
