// SPDX-License-Identifier: Apache-2.0
#include "tapping/swing_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace afm::physics {

double SwingShape::bend(double angle) const noexcept {
  if (old_count_ == 0) return 0.0;
  const Nodes& old = nodes_[1 - filling_];
  // a quadrature asks in order
  while (cursor_ > 0 && old[cursor_ - 1].angle >= angle) --cursor_;
  while (cursor_ < old_count_ && old[cursor_].angle < angle) ++cursor_;
  if (cursor_ == old_count_) return old[old_count_ - 1].bend;
  const Node& right = old[cursor_];
  if (cursor_ == 0) {
    // a parabola from the lowest point
    const double share = angle / right.angle;
    return right.bend * share * share;
  }
  const Node& left = old[cursor_ - 1];
  return left.bend + (angle - left.angle) / (right.angle - left.angle) * (right.bend - left.bend);
}

void SwingShape::straighten() noexcept {
  old_count_ = cursor_ = 0;
  p_ = c_ = rate_squares_ = 0.0;
  straight_ = {};
}

// Mean and first harmonic over both ways.
SwingShape::Straight SwingShape::straight_part_of(const Nodes& nodes) const noexcept {
  Straight straight;
  for (std::size_t i = 0; i < count_; ++i) {
    straight.mean += nodes[i].force / std::numbers::pi;
    straight.cosine += 2.0 * nodes[i].force * nodes[i].of_angle.cosine / std::numbers::pi;
  }
  return straight;
}

double SwingShape::finish() noexcept {
  Nodes& newest = nodes_[filling_];
  // the branches of a latch overlap
  const auto before = [](const Node& a, const Node& b) { return a.angle < b.angle; };
  const auto end = newest.begin() + static_cast<std::ptrdiff_t>(count_);
  if (!std::is_sorted(newest.begin(), end, before)) std::sort(newest.begin(), end, before);
  double p = 0.0, c = 0.0;
  const auto sum_up = [&] {
    p = c = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Node& node = newest[i];
      const double force = node.force - node.weight * straight_.at(node.of_angle);
      p += response_.p_of(force, node.angle, node.of_angle, node.turned);
      c += force * node.of_angle.cosine;
    }
  };
  sum_up();
  const double p_more = p - p_, c_more = c - c_;
  double weight = 0.0, square = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Node& node = newest[i];
    const double more = response_.bend_of_sums(p_more, c_more, node.angle, node.of_angle, node.turned);
    weight += std::abs(node.force);
    square += std::abs(node.force) * more * more;
  }
  if (exact_) {
    straight_ = straight_part_of(newest);
    sum_up();
  }
  p_ = p;
  c_ = c;
  filling_ = 1 - filling_;
  old_count_ = count_;
  cursor_ = 0;
  return weight > 0.0 ? std::sqrt(square / weight) : 0.0;
}

}  // namespace afm::physics
