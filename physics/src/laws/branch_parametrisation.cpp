// SPDX-License-Identifier: Apache-2.0
#include "laws/branch_parametrisation.h"

#include <array>

namespace afm::physics {
namespace {

// Work between two places without a kink in between. Integrates over the square root of the remaining distance, in
// which a contact that shrinks to a point at `to` and one that loses its grip there are smooth; Gauss' rule of four
// points is then accurate to the last digits.
double smooth_work(const LawBranch& branch, double from, double to) {
  struct Node {
    double place, weight;
  };
  constexpr std::array kGauss{
      Node{-0.8611363115940526, 0.3478548451374538}, Node{-0.3399810435848563, 0.6521451548625461},
      Node{0.3399810435848563, 0.6521451548625461}, Node{0.8611363115940526, 0.3478548451374538}};
  constexpr int kPanels = 160;
  const double panel = std::sqrt(to - from) / kPanels;
  double sum = 0.0;
  for (int i = 0; i < kPanels; ++i) {
    for (const Node& node : kGauss) {
      const double left = panel * (i + 0.5 * (1.0 + node.place));
      const LawPoint point = branch.at(to - left * left);
      sum += node.weight * panel * left * point.force.si * point.dh_ds;
    }
  }
  return sum;
}

}  // namespace

LawBranch reversed(const LawBranch& branch, double to) {
  const auto at = [forwards = branch.at](double s) {
    LawPoint point = forwards(-s);
    point.dh_ds = -point.dh_ds;
    point.dforce_ds = -point.dforce_ds;
    return point;
  };
  LawBranch back{-branch.last, -to, at, {}};
  for (auto kink = branch.kinks.rbegin(); kink != branch.kinks.rend() && *kink > to; ++kink)
    back.kinks.push_back(-*kink);
  return back;
}

Energy work_along(const LawBranch& branch, double from, double to) {
  double sum = 0.0;
  for (const double kink : branch.kinks) {
    if (kink <= from || kink >= to) continue;
    sum += smooth_work(branch, from, kink);
    from = kink;
  }
  return Energy(sum + smooth_work(branch, from, to));
}

}  // namespace afm::physics
