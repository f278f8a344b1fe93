// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/result.h"
#include "haptics/device.h"
#include "haptics/energy_tank.h"
#include "haptics/felt_friction.h"
#include "haptics/passivity_observer.h"
#include "haptics/potential_energy.h"
#include "haptics/sample_surface.h"
#include "haptics/scaling.h"
#include "physics/dynamic_model.h"
#include "physics/force_model.h"
#include "physics/law_tables.h"
#include "scene/shared/felt_heights.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// The most bent place that a surface of this material may have on this device, as create() has it: where it bends, a
// force on it is a stiffness sideways. `fit` is the scale of Fit.
double largest_curvature_per_m(const Scaling& fit, const DeviceSpec& device);

// The tables of what is felt, and shown: of a dynamic lever those of the same lever at rest. Believes nothing of
// `material`; `curves` are those of its SharedModel. Fails with a line that begins with the material's name if its
// parameters have no such law. Takes milliseconds and allocates.
core::Result<std::shared_ptr<const physics::LawTables>> build_tables(
    const scene::SharedContact& material, std::span<const scene::SharedMeasuredCurve> curves);

// A scan's feedback, which moves the tip up and down in the hand's place (scene::ScanLead).
struct ScanFeedback {
  bool on = false;
  double gain_per_s = 0;
  double elapsed_s = 0;       // since the step before
  bool without_force = true;  // no hand feels a step
};

// One step of the tip over the sample; places and forces in the sample's frame.
struct Touch {
  physics::TipResponse response;
  double z_m = 0;  // above the surface below the tip
  glm::dvec2 tip_xy_m{0.0};
  FeltFriction::Step friction;
  double surface_height_m = 0;
  glm::dvec3 normal{0.0, 0.0, 1.0};  // of the surface below the tip, unit
  glm::dvec3 hand_force_n{0.0};      // for the hand
  double level_given_j = 0;          // on the hand: by the feedback's motion
};

// One material under the tip, as the hand meets it: its law of force, its surface, and its scales.
//
// Z is measured from the surface below the tip, d = z - h(x, y), and the force on the hand is what the potential of
// F(d) gives: F(d) (-dh/dx, -dh/dy, 1), along the local normal (docs/decisions/0007). So no path sideways gains energy
// on a branch of the law, and the jumps have the law's forces wherever they happen. Sideways a hand's metre is as many
// metres of the nanoworld as along z, or fewer on the scale Atoms, on which the slopes are as much flatter. Friction
// (haptics/felt_friction.h) comes on top of that and takes energy.
//
// Under a scan's feedback (ScanFeedback) the sample is felt level: the loop, z' = gain (h - z), takes the heights away
// before the hand meets them. What it has not yet followed is felt, kMostResidualM of the hand at most: the residual
// deflection. Friction is felt as before, slopes are not. The loop moves by itself, so what it adds to the potential
// comes from an EnergyTank, full whenever the tip leaves the sample; where that is empty the felt residual waits.
// Feedback begins and ends where no hand feels a step: with the tip off the sample, or without force.
//
// create() takes milliseconds (on a topography, tenths of a second) and allocates; the rest is for a tick of the servo.
class ContactModel {
 public:
  // `tables` are build_tables() of `material`, `drawn` is its surface (scene::surface_of); `common` is the scale that
  // all materials share. Fails if the device cannot show it at this tick period. `edit_revision` is of the MaterialEdit
  // that the material came with, 0 for none.
  static core::Result<std::unique_ptr<ContactModel>> create(const scene::SharedContact& material,
                                                            std::uint32_t edit_revision,
                                                            std::shared_ptr<const physics::LawTables> tables,
                                                            const scene::FeltHeights& drawn, const CommonScale& common,
                                                            const DeviceSpec& device, std::int64_t period_ns);

  static constexpr double kMostResidualM = 0.001;

  // `hand_m`: from the device's contact point, along the sample's axes.
  Touch step(const glm::dvec3& hand_m, const ScanFeedback& feedback = {}) noexcept;
  bool is_level() const noexcept { return level_; }  // under a scan's feedback, in the newest step
  void wait_for_lift() noexcept;
  physics::Phase phase() const noexcept;
  double slow_motion() const noexcept { return slow_motion_; }  // as in scene::ActiveContact

  // Only without force: the hand would feel the step. Fit before the first call.
  void use(scene::ScaleMode mode) noexcept { mode_ = mode; }
  const Scaling& scaling() const noexcept { return scalings_[static_cast<std::size_t>(mode_)]; }
  const SampleSurface& surface() const noexcept { return surface_; }

  // The potential of the force on the scale in use, by the height above the surface: Scaling::hand_height_m(z).
  const PotentialEnergy& stored_energy() const noexcept { return stored_energies_[static_cast<std::size_t>(mode_)]; }

  // For the passivity observer, after the step that gave this touch.
  PassivityObserver::Law energy(const Touch& touch) const noexcept;

  std::uint32_t edit_revision() const noexcept { return edit_revision_; }

 private:
  using Model = std::variant<physics::ApproachRetractModel, physics::DynamicModel>;

  using Scalings = std::array<Scaling, scene::kScaleModes.size()>;  // in their order

  using StoredEnergies = std::vector<PotentialEnergy>;  // likewise

  ContactModel(Model model, SampleSurface surface, std::optional<FeltFriction> friction, const Scalings& scalings,
               StoredEnergies stored_energies, std::shared_ptr<const physics::LawTables> tables, double force_cap_n,
               std::uint32_t edit_revision);

  physics::TipResponse step_law(physics::Length z) noexcept;
  bool may_change_level(double hand_z_m, double height_m, const ScanFeedback& feedback) const noexcept;
  void follow_surface(double hand_z_m, double height_m, const ScanFeedback& feedback, Touch& touch) noexcept;
  double attached_j(double z_m) const noexcept;
  double stiffness_n_per_m() const noexcept;

  Model model_;  // never without a value, so that visiting it cannot throw
  SampleSurface surface_;
  std::optional<FeltFriction> friction_;
  double steepest_slope_;
  double largest_curvature_per_m_;
  double force_cap_n_;
  Scalings scalings_;
  StoredEnergies stored_energies_;
  std::shared_ptr<const physics::LawTables> tables_;  // at rest
  scene::ScaleMode mode_ = scene::ScaleMode::Fit;
  double slow_motion_;
  bool level_ = false;
  double loop_m_ = 0;      // the height that the feedback has followed
  double residual_m_ = 0;  // that is felt of what it has not
  EnergyTank tank_;        // of its motion
  std::uint32_t edit_revision_;
};

}  // namespace afm::haptics
