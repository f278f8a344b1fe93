// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace afm::exhibit {

// An answer given with the haptic device: its height moves a mark through the answers, and Turn-On answers. Moving down
// marks the next answer of a list and a lower value of a scale. At either end the mark stops, and it follows as soon as
// the hand turns round. It moves at most three times a second, so that it does not flash (WCAG 2.3.1). One thread.
class HandAnswer {
 public:
  enum class Layout { List, Scale };

  // Starts another prompt. In a list no answer is marked at first, so that nobody answers without moving. `answers` may
  // be 0; then Turn-On only continues.
  void ask(std::size_t answers, Layout layout, std::optional<std::size_t> marked);

  // Follows a mark moved by keys or wand.
  void set_marked(std::size_t marked) { marked_ = marked; }
  std::optional<std::size_t> marked() const { return marked_; }

  // Adds the hand's height and its count of button presses; call in every frame. Returns true if the button was pressed
  // since the last call. Time must not decrease.
  bool add(double height_m, std::uint64_t presses, double now_s);

 private:
  void move(bool down);

  std::size_t answers_ = 0;
  Layout layout_ = Layout::List;
  double step_m_ = 0;
  std::optional<std::size_t> marked_;
  std::optional<double> from_m_;   // height of the mark's last step
  std::optional<bool> went_down_;  // direction of that step
  double moved_s_ = 0;
  std::optional<std::uint64_t> presses_;  // number of presses at the last call
};

}  // namespace afm::exhibit
