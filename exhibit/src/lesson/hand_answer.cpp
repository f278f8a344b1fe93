// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/hand_answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace afm::exhibit {

namespace {

constexpr double kWayM = 0.080;       // range of the hand for all answers, available on small devices
constexpr double kShortestM = 0.004;  // shortest step, well above a hand's tremor
constexpr double kLongestM = 0.015;
constexpr double kTurnS = 0.35;  // shortest time before a step back

}  // namespace

void HandAnswer::ask(std::size_t answers, Layout layout, std::optional<std::size_t> marked) {
  answers_ = answers;
  layout_ = layout;
  step_m_ = std::clamp(kWayM / static_cast<double>(std::max<std::size_t>(answers, 1)), kShortestM, kLongestM);
  marked_ = marked;
  from_m_.reset();
  went_down_.reset();
}

bool HandAnswer::add(double height_m, std::uint64_t presses, double now_s) {
  // a press selects the mark of the previous frame, wherever the hand has moved since
  if (std::exchange(presses_, presses).value_or(presses) != presses) return true;
  if (!from_m_) from_m_ = height_m;
  while (answers_ > 0 && std::abs(height_m - *from_m_) >= step_m_) {
    const bool down = height_m < *from_m_;
    if (went_down_.value_or(down) != down && now_s - moved_s_ < kTurnS) break;
    went_down_ = down;
    moved_s_ = now_s;
    *from_m_ += down ? -step_m_ : step_m_;
    move(down);
  }
  return false;
}

void HandAnswer::move(bool down) {
  const bool onwards = down == (layout_ == Layout::List);
  const std::size_t last = answers_ - 1;
  if (!marked_) {
    marked_ = onwards ? 0 : last;
  } else if (onwards) {
    marked_ = std::min(*marked_ + 1, last);
  } else {
    marked_ = *marked_ == 0 ? 0 : *marked_ - 1;
  }
}

}  // namespace afm::exhibit
