// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/law_tables.h"
#include "physics/units.h"

namespace afm::physics {

// The force on a tip at a height, optimised for the dynamics, which evaluate it some hundred times per tick: a law's
// tables for fixed grips (physics/law_tables.h, with an infinite spring constant) as straight pieces.
//
// - A piece is 1/128 of the octave of its distance to the end of its branch, down to 1 pm. A force that falls as a
//   power of the distance is accurate to some 1e-5, and kinks are at the ends of pieces, except those of Maugis-Dugdale
//   on both branches, which are rounded by 2 pN. Beyond 7.6 um a free tip has no force.
// - F is continuous along a branch, so a tip that stays on one neither gains nor loses energy.
// - The branch is a latch, the caller's `attached`: a law with intrinsic hysteresis (JKR, Maugis-Dugdale) keeps its
//   memory.
// - No slope into the sample exceeds kSteepestRatio times stiffness(); at larger depths F continues along a straight
//   line, so that an integrator chosen for stiffness() is known to be stable at every depth.
//
// Constant after construction. Any thread.
class TipForce {
 public:
  static constexpr double kSteepestRatio = 25.0;

  // Throws std::invalid_argument unless `grips` was built with an infinite spring constant.
  TipForce(const LawTables& grips, Force largest_load);

  // The steepest -dF/dh of an attached tip up to the largest load. Ignores slopes of attraction, which make a tip jump,
  // not oscillate, and are infinite where JKR's neck ends.
  Stiffness stiffness() const noexcept { return Stiffness(stiffness_); }

  // Heights at which a free tip comes into contact and an attached one is released.
  Length contact_height() const noexcept { return Length(contact_height_); }
  Length release_height() const noexcept { return Length(release_height_); }

  // F at a height; first updates the latch `attached`.
  Force operator()(Length height, bool& attached) const noexcept {
    double distance = distance_of(height.si, attached);
    if (distance < 0.0) {
      attached = !attached;
      distance = distance_of(height.si, attached);
    }
    const std::vector<Piece>& branch = branches_[attached ? 1 : 0];
    // the top bits of a double count the pieces; the offset makes the first octave's the smallest
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(distance + kFirstOctave) >> kDroppedBits;
    const Piece& piece = branch[std::min<std::size_t>(bits - kFirstBits, branch.size() - 1)];
    return Force(piece.force + piece.slope * distance);
  }

 private:
  struct Piece {
    double force = 0.0;  // force extrapolated to distance 0
    double slope = 0.0;  // derivative of the force by the distance
  };

  static constexpr double kFirstOctave = 0x1p-40;
  static constexpr int kOctaves = 23;
  static constexpr int kPiecesPerOctave = 128;
  static constexpr int kDroppedBits = 52 - std::countr_zero(unsigned{kPiecesPerOctave});
  static constexpr std::uint64_t kFirstBits = std::bit_cast<std::uint64_t>(kFirstOctave) >> kDroppedBits;

  // Distance from the end of the branch, positive on the branch.
  double distance_of(double height, bool attached) const noexcept {
    return attached ? release_height_ - height : height - contact_height_;
  }

  static double left_of(std::size_t piece) noexcept {
    return std::bit_cast<double>((kFirstBits + piece) << kDroppedBits) - kFirstOctave;
  }

  double contact_height_;
  double release_height_;
  double stiffness_ = 0.0;
  std::array<std::vector<Piece>, 2> branches_;  // branch of the free tip, branch of the attached tip
};

}  // namespace afm::physics
