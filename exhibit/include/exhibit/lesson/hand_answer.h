// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace afm::exhibit {

// An answer given with the haptic device alone: its height moves a mark through the answers, Turn-On answers. Down goes
// to the next answer of a list and down a scale. The mark stays at an end however far the hand goes, and turns round
// with it, three times a second at most, so that it does not flash (WCAG 2.3.1). One thread.
class HandAnswer {
 public:
  enum class Layout { List, Scale };

  // Another prompt: of a list none is marked at first, so that nobody answers without having moved. `answers` may be 0,
  // where Turn-On only goes on.
  void ask(std::size_t answers, Layout layout, std::optional<std::size_t> marked);

  // The mark that keys or wand have moved.
  void set_marked(std::size_t marked) { marked_ = marked; }
  std::optional<std::size_t> marked() const { return marked_; }

  // The hand's height, and how often its button has been pressed: every frame, whatever is asked. True where it was
  // pressed since the last call. Time never goes back.
  bool add(double height_m, std::uint64_t presses, double now_s);

 private:
  void move(bool down);

  std::size_t answers_ = 0;
  Layout layout_ = Layout::List;
  double step_m_ = 0;
  std::optional<std::size_t> marked_;
  std::optional<double> from_m_;   // where the mark moved last
  std::optional<bool> went_down_;  // then
  double moved_s_ = 0;
  std::optional<std::uint64_t> presses_;  // at the last call
};

}  // namespace afm::exhibit
