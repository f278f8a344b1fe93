// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

class AveragedFlow;
class TapTable;
struct DrivenLever;
struct TapState;

// The swing of a lever over a surface that moves. For a quality factor of at least AveragedFlow::kLeastQuality it is
// the averaged flow, in the variables u = A cos(phi), v = A sin(phi), time in 1/w0:
//
//   u' = -g u - w v,   v' = -g v + w u + a/2r,   g = 1/2Q + E/(2 pi k r A^2),   w = (r^2 - 1)/2r + V/(r k A^2)
//
// V, E and the forces come from a table over amplitude and gap, which the constructor builds. At rest the amplitude is
// that of AveragedFlow within 0.2 %. Below that quality factor u and v approach the swing at rest of a TapTable, on the
// branch that its jumps leave, with the relaxation 2Q/w0; they do not ring, and the forces are those at rest.
//
// One thread. Only the constructor allocates; copies share the table.
class TapEnvelope {
 public:
  // Steps of a call of advance() that are enough for a change by a few relaxations.
  static constexpr int kUsualSteps = 48;

  // Length of a step in w0 t that is short enough.
  static double longest_step(const DrivenLever& lever) noexcept;

  // `flow` of the surface that comes into contact at `contact_height`; its lever has a Q of at least
  // AveragedFlow::kLeastQuality. The swing is the free one.
  TapEnvelope(AveragedFlow& flow, Length contact_height);

  // A lever with a low quality factor. The swing is the free one.
  explicit TapEnvelope(std::shared_ptr<const TapTable> rests);

  // Puts the swing into this state with the base `gap_m` above the surface.
  void place(double u_m, double v_m, double gap_m) noexcept;
  void place(const TapState& state, double gap_m) noexcept;

  // Changes the drive of the same lever from now on; the swing goes on. Allocates. Not for a lever with a low quality
  // factor. The tables reach to 1.25 times the free amplitude of the constructor; larger swings have the averages of
  // that one.
  void drive(const DrivenLever& lever);

  // Lets the swing follow for `angle`, in w0 t, while the base moves evenly from one height above the surface to
  // another, in at most so many steps: a contact so stiff that it needs more is in slow motion.
  void advance(double from_gap_m, double to_gap_m, double angle, int most_steps = kUsualSteps) noexcept;

  double amplitude_m() const noexcept { return amplitude_; }
  double phase_rad() const noexcept;                               // lag behind the drive, 0 to 2 pi
  double lost_j() const noexcept { return contact().lost; }        // energy lost in the sample per swing
  double peak_force_n() const noexcept { return contact().peak; }  // force at the lowest point
  double mean_force_n() const noexcept { return contact().mean; }  // mean force on the tip over a swing

  // Sine of the phase's excess over that of the free lever: positive where the sample attracts on average.
  double attraction() const noexcept;

  const DrivenLever& lever() const noexcept { return *lever_; }
  bool at_rest_only() const noexcept { return rests_ != nullptr; }  // true: states come from a TapTable
  bool repelled() const noexcept { return repelled_; }              // branch; true: repulsive

 private:
  // Averages of one swing.
  struct Swing {
    double lost = 0, peak = 0, mean = 0;
  };
  // Terms that move the swing, and its forces. In the tables virial and energy are over sqrt(A), and the mean force is
  // times sqrt(A): their changes with A are then slow. Single precision halves what a tick reads.
  struct Moving {
    float virial = 0, lost = 0;
  };
  struct Forces {
    float peak = 0, mean = 0, lost = 0;  // lost: in the sample only
  };
  struct Tables {
    std::vector<Moving> moving;
    std::vector<Forces> forces;
  };
  // Terms that move a swing, between two columns and between two rows. A column there is
  // `columns` (`whole` + (`share` + `by_gap` gap)), with the gap of the lowest point from contact.
  struct Line {
    double from = 0, rise = 0;
    double at(double share) const noexcept { return from + share * rise; }
  };
  struct Moved {
    double virial = 0, lost = 0;
    bool beyond = true;  // true: farther than the last column, where both are zero
  };
  struct Cell {
    double left = -1, low = -1, high = -1;  // column and rows of the cell; -1: none yet
    double columns = 0, whole = 0, share = 0, by_gap = 0;
    Line virial_below, virial_above, lost_below, lost_above;

    Moved at(double x, double y) const noexcept {
      const double right = x - left, up = y - low;
      const double virial = virial_below.at(right), lost = lost_below.at(right);
      return {.virial = virial + up * (virial_above.at(right) - virial),
              .lost = lost + up * (lost_above.at(right) - lost),
              .beyond = false};
    }
  };
  // `cell`: the one to look in first; then that of this swing, unless it is beyond the tables.
  Moved moving_at(double amplitude_m, double gap_m, Cell& cell) const noexcept;
  void enter_cell(double x, double y, Cell& cell) const noexcept;

  // Place in the tables.
  struct Place {
    std::ptrdiff_t node = 0;
    double right = 0, up = 0;
    bool beyond = true;  // true: farther than the last column, where no force acts
  };
  Place place_of(double amplitude_m, double gap_m) const noexcept;
  template <class Node>
  double between(const std::vector<Node>& nodes, const Place& place, float Node::* value) const noexcept;
  double least_swing_m() const noexcept { return 1e-3 * least_amplitude_m_; }  // smallest amplitude with a phase
  Swing contact() const noexcept;                                              // averages of the current swing
  void approach_rest(double gap_m, double angle) noexcept;
  void set_pace() noexcept;
  void measure() noexcept;  // computes amplitude_ from u_ and v_

  // Numbers of a step that no swing changes.
  struct Pace {
    double drive = 0, detuned = 0, damping = 0;  // terms a/2r, (r^2 - 1)/2r, 1/2Q
    double by_stored = 0, by_turn = 0;           // factors 1/kr, 1/(2 pi k r)
    double by_row = 0, by_nudge = 0;             // rates by the rows' distance and by a small part of it, 1/m
    double slowest = 0;                          // inverse of the longest step
  };

  std::shared_ptr<const DrivenLever> lever_;
  double contact_m_ = 0;
  double least_amplitude_m_ = 0, amplitude_step_m_ = 0, least_x_ = 0, last_column_ = 0;
  std::ptrdiff_t columns_ = 0;
  Pace pace_;
  std::shared_ptr<const Tables> tables_;    // tables of the averaged flow; null for a low quality factor
  std::shared_ptr<const TapTable> rests_;   // table of resting swings; null for a high quality factor
  bool repelled_ = false;                   // current branch of rests_; true: the repulsive one
  double free_cosine_ = 0, free_sine_ = 1;  // cosine and sine of the free phase
  double u_ = 0, v_ = 0, amplitude_ = 0;
  double gap_m_ = 0;  // gap of the newest swing
  struct Cells {
    Cell first, middle, longer;  // cells used for a step's beginning, its middle, and its ringing
  } cells_;
};

}  // namespace afm::physics
