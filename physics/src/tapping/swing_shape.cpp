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
  p_ = c_ = 0.0;
  square_rates_ = 0.0;
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

// In the order in which the nodes were added.
double SwingShape::sum_of_square_rates(const Nodes& nodes, std::size_t count) const noexcept {
  Turned before{0.0, 0.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = nodes[i];
    const double here = exact_ ? 0.5 * node.bending : 0.0;
    const double rate = response_.rate(used_p_, used_c_, node.angle, node.of_angle, node.turned, before, here);
    sum += node.weight * rate * rate;
    before.cosine += node.bending * node.turned.cosine;
    before.sine += node.bending * node.turned.sine;
  }
  return sum;
}

double SwingShape::mean_square_rate() const noexcept {
  // most quadratures of a search are never asked
  if (!square_rates_) square_rates_ = sum_of_square_rates(nodes_[1 - filling_], old_count_);
  return *square_rates_ / std::numbers::pi;
}

double SwingShape::finish() noexcept {
  Nodes& newest = nodes_[filling_];
  used_p_ = p_;
  used_c_ = c_;
  square_rates_.reset();
  // the branches of a latch overlap
  const auto before = [](const Node& a, const Node& b) { return a.angle < b.angle; };
  const auto end = newest.begin() + static_cast<std::ptrdiff_t>(count_);
  if (!std::is_sorted(newest.begin(), end, before)) {
    square_rates_ = sum_of_square_rates(newest, count_);
    std::sort(newest.begin(), end, before);
  }
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
