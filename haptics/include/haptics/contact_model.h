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
#include "haptics/particle_push.h"
#include "haptics/passivity_observer.h"
#include "haptics/potential_energy.h"
#include "haptics/sample_surface.h"
#include "haptics/scaling.h"
#include "physics/dynamic_model.h"
#include "physics/force_model.h"
#include "physics/law_tables.h"
#include "physics/tapping/tapping_model.h"
#include "scene/shared/felt_heights.h"
#include "scene/shared/shared_blocks.h"
#include "scene/shared/tip_blocks.h"

namespace afm::haptics {

class FeltMarks;
class FeltParticles;
class MapContact;
class PaidForce;

// Largest curvature that a surface of this material may have on this device, as limited by create(): where a surface
// bends, a force on it acts as a lateral stiffness. `fit` is the scale of Fit.
double largest_curvature_per_m(const Scaling& fit, const DeviceSpec& device);

// Tables of the felt and displayed law; for a dynamic lever, those of the same lever at rest, and for one that taps,
// those of its push (physics/tapping/tapping_model.h). Checks everything in
// `material`; `curves` are those of its SharedModel. Fails with a line that begins with the material's name if its
// parameters have no such law. Takes milliseconds, or for a lever that taps tenths of a second, and allocates.
core::Result<std::shared_ptr<const physics::LawTables>> build_tables(
    const scene::SharedContact& material, std::span<const scene::SharedMeasuredCurve> curves);

// Feedback of a scan, which moves the tip up and down in place of the hand (scene::ScanLead).
struct ScanFeedback {
  bool on = false;
  double gain_per_s = 0;
  double elapsed_s = 0;       // time since the previous step
  bool without_force = true;  // true: a step of the force would not be felt
};

// One step over a map; forces on the hand.
struct MapTouch {
  physics::TipResponse response;
  double force_n = 0;            // force along the normal
  glm::dvec2 sideways_n{0.0};    // force along the sample's x and y, at a constant height above the surface
  double stored_j = 0;           // potential of the branch, zero at the least of the map
  double damping_n_s_per_m = 0;  // viscous damping of the hand in any direction; 0 without a viscous map
  glm::dvec3 vibration_n{0.0};   // vibration force in the sample's frame; zero unless the map vibrates
  scene::LawHere here;           // law of force below the tip
};

// One step of the tip over the sample; positions and forces in the sample's frame.
struct Touch {
  physics::TipResponse response;
  scene::Swing swing;  // state of the tapping lever; empty: the lever does not tap
  double z_m = 0;      // height above the surface below the tip
  glm::dvec2 tip_xy_m{0.0};
  MapTouch map;  // step over a map of modulus and adhesion; its response is `response`
  FeltFriction::Step friction;
  ParticlePush push;
  GroovePull groove;  // pull of the groove on the hand, along the axes of the sample
  double surface_height_m = 0;
  glm::dvec3 normal{0.0, 0.0, 1.0};  // unit normal of the surface below the tip
  glm::dvec3 hand_force_n{0.0};      // force on the hand
  double level_given_j = 0;          // energy given to the hand by the feedback's motion
};

// One material under the tip, as felt by the hand: its force law, its surface, and its scales.
//
// Z is measured from the surface below the tip, d = z - h(x, y). The force on the hand derives from the potential of
// F(d): F(d) (-dh/dx, -dh/dy, 1), along the local normal (docs/decisions/0007). No lateral path therefore gains energy
// on a branch of the law, and the jumps have the law's forces wherever they happen. Laterally, a metre of the hand
// corresponds to as many metres of the nanoworld as along z, or to fewer on the scale Atoms, on which slopes are
// flatter by the same factor. Friction (haptics/felt_friction.h) is added to that and dissipates energy.
//
// On the scale Particles the tip also pushes the particles on the sample (haptics/felt_particles.h). Their force is
// added only where one is touched; without force, under a scan's feedback, and until the tip has been lifted, there is
// none. The groove of a plan (haptics/felt_groove.h) is also felt only on that scale.
//
// A sample with marks (haptics/felt_marks.h) is felt only on that scale, too, and there instead of everything else: the
// law, friction, the surface and a scan's feedback are silent.
//
// Under a scan's feedback (ScanFeedback) the sample feels level: the loop, z' = gain (h - z), removes the heights
// before the hand feels them. Only the residual deflection, the part not yet followed, is felt, up to kMostResidualM of
// the hand. Friction is felt as before; slopes are not. The loop moves by itself, so the energy it adds to the
// potential comes from an EnergyTank, which is refilled whenever the tip leaves the sample; if the tank is empty, the
// felt residual waits. Feedback begins and ends only where the step is not felt: with the tip off the sample, or
// without force.
//
// Over a map of modulus and adhesion (scene::SharedLawMap) the potential also depends on the place, and its slope is
// one more force sideways (haptics/map_contact.h); all of the map is felt on the same scales. A vibration takes the
// room that the other forces leave below the force cap.
//
// A lever that taps is felt by its push, not by its mean force, which would give energy to the hand. The energy that
// the push gives because it follows the hand late is excess energy for the passivity observer. With
// SharedContact::felt_mean_force the mean force is felt instead, as a PaidForce; not under a scan's feedback.
//
// create() takes milliseconds (on a topography or with a lever that taps, tenths of a second) and allocates; everything
// else may be called in a tick of the servo.
class ContactModel {
 public:
  // `tables` are build_tables() of `material`, `drawn` is its surface (scene::surface_of); `common` is the scale shared
  // by all materials; `map` is valid, and has points, if the
  // material refers to it. Fails if the device cannot render it
  // at this tick period. `edit_revision` is that of the MaterialEdit with the material's parameters, 0 for none.
  static core::Result<std::unique_ptr<ContactModel>> create(const scene::SharedContact& material,
                                                            std::uint32_t edit_revision,
                                                            std::shared_ptr<const physics::LawTables> tables,
                                                            const scene::FeltHeights& drawn, const CommonScale& common,
                                                            const DeviceSpec& device, std::int64_t period_ns,
                                                            const scene::SharedLawMap* map = nullptr);

  using Scalings = std::array<Scaling, scene::kScaleModes.size()>;  // scalings in the order of scene::kScaleModes

  ~ContactModel();

  static constexpr double kMostResidualM = 0.001;

  // `hand_m` is measured from the device's contact point, along the sample's axes.
  Touch step(const glm::dvec3& hand_m, const ScanFeedback& feedback = {}) noexcept;
  bool is_level() const noexcept { return level_; }  // true: the newest step was under a scan's feedback
  void wait_for_lift() noexcept;
  physics::Phase phase() const noexcept;
  double slow_motion() const noexcept { return slow_motion_; }  // slow-motion factor, as in scene::ActiveContact

  // Call only without force: the hand would feel the step. Fit before the first call. `particles` are those on the
  // sample, null for none, or else they are `marks`; they must outlive the use. Particles needs the scale that create()
  // was given, or that of the same particles with other settings.
  void use(scene::ScaleMode mode, FeltParticles* particles = nullptr, FeltMarks* marks = nullptr) noexcept;
  const Scaling& scaling() const noexcept { return scalings_[static_cast<std::size_t>(mode_)]; }
  const SampleSurface& surface() const noexcept { return surface_; }

  // Potential of the force on the current scale, by the height above the surface: Scaling::hand_height_m(z).
  const PotentialEnergy& stored_energy() const noexcept { return stored_energies_[static_cast<std::size_t>(mode_)]; }

  // Input of the passivity observer; call after the step that returned this touch.
  PassivityObserver::Law energy(const Touch& touch) const noexcept;

  std::uint32_t edit_revision() const noexcept { return edit_revision_; }

 private:
  using Model = std::variant<physics::ApproachRetractModel, physics::DynamicModel, physics::TappingModel>;

  using StoredEnergies = std::vector<PotentialEnergy>;  // energies in the order of scene::kScaleModes

  ContactModel(Model model, std::unique_ptr<MapContact> map, SampleSurface surface,
               std::optional<FeltFriction> friction, const Scalings& scalings, StoredEnergies stored_energies,
               std::shared_ptr<const physics::LawTables> tables, double force_cap_n, std::uint32_t edit_revision);

  Touch step_marks(const glm::dvec3& hand_m, const ScanFeedback& feedback) noexcept;
  PassivityObserver::Law marks_energy(const Touch& touch) const noexcept;
  physics::TipResponse step_law(physics::Length z) noexcept;
  double felt_force_n(Touch& touch, double elapsed_s) noexcept;
  bool feels_mean_force() const noexcept { return mean_force_ && !level_; }
  bool may_change_level(double hand_z_m, double height_m, const ScanFeedback& feedback) const noexcept;
  void follow_surface(double hand_z_m, double height_m, const ScanFeedback& feedback, Touch& touch) noexcept;
  void meet_particles(const glm::dvec2& slope, const ScanFeedback& feedback, Touch& touch) noexcept;
  double attached_j(const Touch& touch, double z_m) const noexcept;
  double stiffness_n_per_m() const noexcept;

  Model model_;                      // model of the lever; never valueless, so that visiting it cannot throw
  std::unique_ptr<MapContact> map_;  // map that replaces the model; null: none
  SampleSurface surface_;
  std::optional<FeltFriction> friction_;
  double steepest_slope_;
  double largest_curvature_per_m_;
  double force_cap_n_;
  Scalings scalings_;
  StoredEnergies stored_energies_;
  std::shared_ptr<const physics::LawTables> tables_;  // tables for the lever at rest
  scene::ScaleMode mode_ = scene::ScaleMode::Fit;
  double slow_motion_;
  bool level_ = false;
  double loop_m_ = 0;                      // height followed by the feedback
  double residual_m_ = 0;                  // felt part of the remaining height
  EnergyTank tank_;                        // pays for the feedback's motion
  std::unique_ptr<PaidForce> mean_force_;  // mean force of a tapping lever, felt instead of its push; null: none
  double mean_force_m_ = 0;                // height of the hand in the previous step of mean_force_
  FeltParticles* particles_ = nullptr;     // pushed particles, not owned; null: none
  FeltMarks* marks_ = nullptr;             // marks felt in place of everything else, not owned; null: none
  std::uint32_t edit_revision_;
};

}  // namespace afm::haptics
