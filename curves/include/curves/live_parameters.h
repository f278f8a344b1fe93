// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "curves/map_place.h"
#include "curves/sample_model.h"
#include "physics/force_curve.h"

namespace afm::curves {

// Range of a cycle on the wall above and below the undeformed surface, in units of the height at which the hand's
// stroke ends.
inline constexpr double kReachAbove = 1.42, kReachBelow = 0.42;
double cycle_reach_m(const SampleModel& material);

// A quantity of physics/quantity_text.h in correct typography: "31.8 mJ/m²" for "31.8 mJ/m2".
std::string typographic(std::string text);

// The parameters of a material that a user may change while it is felt, and the resulting curve; of a force map, the
// pixel. Always valid: a step that would leave the laws' ranges or the map changes nothing and gives the reason.
class LiveParameters {
 public:
  enum class Row { TipRadius, SpringConstant, Hamaker, WorkOfAdhesion, ReducedModulus, Law, PixelColumn, PixelRow };
  static constexpr std::size_t kRows = 8;

  // `loaded` is the servo's initial model.
  explicit LiveParameters(const SampleModel& loaded);

  // The rows that this material has; a recorded curve that is no pixel of a force map has none.
  std::span<const Row> rows() const;

  // One step down (-1) or up (+1): a factor of the fourth root of two, the next law, or the next pixel with a curve.
  // Returns whether anything changed. A pixel is read from its file, which takes milliseconds.
  bool step(Row row, int direction);

  // Goes to a pixel of the force map, for a material of one. Errors as of CurveMap::material(); nothing has changed
  // then.
  core::Result<void> choose(const MapPlace& place);

  // Returns to the loaded parameters. Returns whether anything changed.
  bool reset();

  // Complete state, relative to the loaded model, for transfer to another machine.
  struct State {
    std::array<int, kRows> steps{};
    std::optional<Row> refused;  // row whose last step changed nothing; empty: none
    int refused_direction = 0;

    bool operator==(const State&) const = default;
  };
  State state() const { return {steps_, refused_, refused_direction_}; }
  // Returns false, without any change, if the state is invalid.
  bool restore(const State& state);

  // The model with the current parameters, which the caller sends to the servo.
  const SampleModel& model() const { return now_; }

  std::string value(Row row) const;                                           // value with its unit
  bool automatic_law() const { return !law_after(steps_[index(Row::Law)]); }  // true: the adhesion map selects the law
  bool changed(Row row) const { return steps_[index(row)] != 0; }
  bool changed() const { return steps_ != Steps{}; }

  const physics::ForceCurve& curve() const { return curve_; }  // predicted curve of one cycle
  const std::string& refusal() const { return refusal_; }      // reason why the last step changed nothing, or empty

 private:
  // Number of steps of each row from the loaded value; for the law, places in the list of laws.
  using Steps = std::array<int, kRows>;

  static std::size_t index(Row row) { return static_cast<std::size_t>(row); }
  std::optional<physics::Law> law_after(int steps) const;  // empty: the adhesion map selects the law
  bool take(const Steps& steps);
  bool take_pixel(const Steps& steps);
  std::optional<MapPlace> place_after(const Steps& steps) const;  // empty: outside the map
  bool try_step(Row row, int direction);

  SampleModel loaded_;
  SampleModel now_;
  Steps steps_{};
  physics::ForceCurve curve_;
  std::string refusal_;
  std::optional<Row> refused_;
  int refused_direction_ = 0;
};

}  // namespace afm::curves
