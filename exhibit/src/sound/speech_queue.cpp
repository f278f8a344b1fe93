// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/speech_queue.h"

#include <limits>
#include <utility>

namespace afm::exhibit {

void SpeechQueue::offer(SpeechText text) { (text.kind == SpeechKind::Event ? event_ : guidance_) = std::move(text); }

std::optional<std::int64_t> SpeechQueue::next_ns() const {
  if (event_) return 0;
  if (!guidance_) return std::nullopt;
  return speaking_ == SpeechKind::Guidance ? 0 : end_ns_;
}

std::optional<SpeechText> SpeechQueue::take(std::int64_t now_ns) {
  const auto next = next_ns();
  if (!next || now_ns < *next) return std::nullopt;
  auto taken = std::exchange(event_ ? event_ : guidance_, std::nullopt);
  speaking_ = taken->kind;
  end_ns_ = std::numeric_limits<std::int64_t>::max();
  return taken;
}

}  // namespace afm::exhibit
