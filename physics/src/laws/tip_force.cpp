// SPDX-License-Identifier: Apache-2.0
#include "physics/tip_force.h"

#include <cmath>
#include <stdexcept>

namespace afm::physics {

TipForce::TipForce(const LawTables& grips, Force largest_load)
    : contact_height_(grips.figures.z_jtc.si), release_height_(grips.figures.z_joc.si) {
  if (!std::isinf(grips.contact.spring_constant.si)) {
    throw std::invalid_argument("the tip's force needs tables of fixed grips");
  }
  constexpr std::size_t kPieces = std::size_t{kOctaves} * kPiecesPerOctave;

  const auto pieces = [&](const BranchTable& table, double end, double side) {
    std::vector<Piece> branch;
    branch.reserve(kPieces);
    double left = 0.0, force = table.force(Length(end)).si;
    for (std::size_t i = 0; i < kPieces; ++i) {
      const double right = left_of(i + 1);
      const double next = table.force(Length(end + side * right)).si;
      const double slope = (next - force) / (right - left);
      branch.push_back({force - slope * left, slope});
      left = right;
      force = next;
    }
    return branch;
  };
  branches_[0] = pieces(grips.free, contact_height_, 1.0);
  branches_[1] = pieces(grips.attached, release_height_, -1.0);

  std::vector<Piece>& deep = branches_[1];
  for (std::size_t i = 0; i < deep.size(); ++i) {
    if (deep[i].force + deep[i].slope * left_of(i) > largest_load.si) break;
    stiffness_ = std::max(stiffness_, deep[i].slope);
  }

  // zero far away; deep inside the last slope for which the integrator was chosen
  branches_[0].push_back({});
  const auto too_steep = std::find_if(deep.begin(), deep.end(),
                                      [this](const Piece& piece) { return piece.slope > kSteepestRatio * stiffness_; });
  deep.erase(std::max(too_steep, deep.begin() + 1), deep.end());
}

}  // namespace afm::physics
