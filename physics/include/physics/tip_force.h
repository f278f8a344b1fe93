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

// The force on a tip at a height, as the dynamics ask for it some hundred times a tick: the tables of a law under fixed
// grips (physics/law_tables.h, with an infinite spring constant) once more, as straight pieces.
//
// - A piece is 1/128 of the octave of its distance to the place where its branch ends, down to 1 pm: a force that falls
//   as a power of the distance is met to some 1e-5 of itself, and kinks lie at the ends; those of Maugis-Dugdale,
//   on both branches, do not, and are rounded by 2 pN. 7.6 um from there a free tip feels nothing.
// - F is continuous along a branch, so a tip that stays on one neither gains nor loses energy.
// - Which branch holds is a latch, as the caller's `attached`: a law that is hysteretic by itself (JKR,
//   Maugis-Dugdale) keeps its memory.
// - No slope into the sample exceeds kSteepestRatio times stiffness(): deeper, F goes on along a straight line. So
//   the stability of an integrator that is chosen for stiffness() is known for every depth.
//
// Constant after construction; for any thread.
class TipForce {
 public:
  static constexpr double kSteepestRatio = 25.0;

  // Throws std::invalid_argument unless `grips` was built with an infinite spring constant.
  TipForce(const LawTables& grips, Force largest_load);

  // The steepest -dF/dh of an attached tip up to the largest load: what it is held by. Slopes of attraction do not
  // count; they make a tip jump, not swing, and are infinite where JKR's neck ends.
  Stiffness stiffness() const noexcept { return Stiffness(stiffness_); }

  // Where a free tip comes into contact, and where an attached one comes off.
  Length contact_height() const noexcept { return Length(contact_height_); }
  Length release_height() const noexcept { return Length(release_height_); }

  // F at a height, after the latch has been asked.
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
    double force = 0.0;  // continued to distance 0
    double slope = 0.0;  // dF/d(distance)
  };

  static constexpr double kFirstOctave = 0x1p-40;
  static constexpr int kOctaves = 23;
  static constexpr int kPiecesPerOctave = 128;
  static constexpr int kDroppedBits = 52 - std::countr_zero(unsigned{kPiecesPerOctave});
  static constexpr std::uint64_t kFirstBits = std::bit_cast<std::uint64_t>(kFirstOctave) >> kDroppedBits;

  // From the end of the branch, into it.
  double distance_of(double height, bool attached) const noexcept {
    return attached ? release_height_ - height : height - contact_height_;
  }

  static double left_of(std::size_t piece) noexcept {
    return std::bit_cast<double>((kFirstBits + piece) << kDroppedBits) - kFirstOctave;
  }

  double contact_height_;
  double release_height_;
  double stiffness_ = 0.0;
  std::array<std::vector<Piece>, 2> branches_;  // free, attached
};

}  // namespace afm::physics
