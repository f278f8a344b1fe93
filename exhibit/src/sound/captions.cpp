// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/captions.h"

#include <utility>

namespace afm::exhibit {

void Captions::add(HeardEvent event, std::string text, std::int64_t now_ns) {
  const bool often = row_of(event).spoken == Spoken::OnRequest;
  const bool being_read = !shown_.text.empty() && !shown_.often && now_ns - since_ns_ < kReadableNs;
  if (often && (being_read || (next_ && !next_->often))) return;
  next_ = {std::move(text), often};
}

const std::string& Captions::text(std::int64_t now_ns) {
  if (next_ && (shown_.text.empty() || now_ns - since_ns_ >= kLeastNs)) {
    shown_ = std::move(*next_);
    next_.reset();
    since_ns_ = now_ns;
  }
  if (now_ns - since_ns_ >= kShownNs) shown_ = {};
  return shown_.text;
}

}  // namespace afm::exhibit
