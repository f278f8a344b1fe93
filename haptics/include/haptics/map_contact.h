// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/result.h"
#include "haptics/contact_model.h"
#include "haptics/device.h"
#include "haptics/law_family.h"
#include "haptics/map_law.h"
#include "haptics/sample_surface.h"
#include "haptics/scaling.h"
#include "physics/force_model.h"
#include "scene/shared/map_vibration.h"
#include "scene/shared/scale_modes.h"
#include "scene/shared/tip_blocks.h"

namespace afm::haptics {

class FeltVibration;

// A tip on a sample whose modulus and adhesion change from place to place: the latch of physics/force_model.h over
// haptics/map_law.h, for every scale.
//
// The map's coordinates are smooth surfaces of their own, continuous with their slopes. Where they rise steeply, the
// hand feels a force sideways. Along the normal a map has kShareAlong of the largest force on the device; on each scale
// the surfaces are smoothed (haptics/sample_surface.h) until the force sideways is at most kShareSideways of it for
// each coordinate, so that both together need no clamp, which would cost energy on one path and not on another; and
// until each of the three parts of the stiffness that a coordinate adds, by the bend of its surface, by the bend of the
// energy between the laws, and by the change of the force along the normal, is at most kShareOfStiffness of what the
// device renders. Beyond the edge the values of the edge merge into one.
//
// Deeper than Scaling::kPushM of the hand all places become as stiff as the stiffest, over another kFloorM or more:
// energies deep in the sample would differ so much from place to place that hardly any map could be felt.
//
// A viscous map also damps the hand, from kLeastOfDamping of kMostDampingNSPerM to all of it, in proportion to the
// energy that the law below the tip loses in a slow cycle; kDampsAboveM above the height at which the tip lets go there
// is none. On a device whose force is limited the most is what its force cap damps at 1 m/s. The damping only takes
// energy: it acts on a velocity behind a low-pass (haptics/hand_motion.h) with the time constant T, which holds back
// the energy b T v^2 / 2, and grows by no more than a factor of e in T, though such a low-pass would bear two.
//
// A map that vibrates (scene::MapVibration) also has a FeltVibration, as strong as its quantity is large: from none at
// the least modulus or adhesion of the map, or where a cycle loses nothing, to all of it at the largest;
// kVibratesAboveM above the height at which the tip lets go there is none. The modulus counts by its logarithm. A touch
// vibrates most when it begins, and fades with kCollisionS.
//
// Building takes tenths of a second and allocates; step() may be called in a tick of the servo.
class MapContact {
 public:
  static constexpr double kShareAlong = 0.8;
  static constexpr double kShareSideways = 0.42;
  static constexpr double kShareOfStiffness = 0.2;
  static constexpr double kFloorM = 0.010;
  static constexpr double kMostDampingNSPerM = 2.0;
  static constexpr double kLeastOfDamping = 0.1;
  static constexpr double kDampsAboveM = 0.020;
  static constexpr double kVibratesAboveM = 0.005;  // distance above the release; less than that of arming
  static constexpr double kCollisionS = 0.1;

  using Scalings = ContactModel::Scalings;

  // Effects on the hand in addition to the law.
  struct Channels {
    bool damps = false;
    scene::MapVibration vibration = scene::MapVibration::None;
  };

  // The device for which all scalings of a map are made.
  static DeviceSpec along_normal(const DeviceSpec& device) {
    return limited_to(device, kShareAlong * force_cap_n(device));
  }

  // `nominal` are the tables of the material, for lever and support. `spacing_m` is the distance of the map's points as
  // felt. All scalings are those of the family on along_normal() of the device.
  MapContact(std::shared_ptr<const LawFamily> family, std::shared_ptr<const physics::LawTables> nominal,
             const scene::SharedLawMap& map, double spacing_m, const Scalings& scalings, const DeviceSpec& device,
             const Channels& channels);
  ~MapContact();

  // Feels the map at a place in the sample's frame and a height above its surface; `scale` is that of the mode.
  // `elapsed_s` is the time since the previous step.
  MapTouch step(scene::ScaleMode mode, const Scaling& scale, const glm::dvec2& xy_m, double z_m,
                double elapsed_s) noexcept;

  // Force of the vibration after that step, no longer than `room_n`, on a hand at this position.
  glm::dvec3 vibrate(const glm::dvec3& hand_m, double room_n, double elapsed_s) noexcept;
  const FeltVibration& vibration() const noexcept { return *vibration_; }

  void wait_for_lift() noexcept;
  physics::Phase phase() const noexcept { return phase_; }

  // Potential on the attached branch, as in MapTouch::stored_j.
  double attached_j(scene::ScaleMode mode, const Scaling& scale, const glm::dvec2& xy_m, double z_m) const noexcept;

  // Upper limit of the stiffness on this scale, in any direction, over a level surface.
  double stiffness_n_per_m(scene::ScaleMode mode) const noexcept { return on(mode).stiffness_n_per_m; }

 private:
  // A coordinate as a surface over the sample.
  struct Laid {
    double length_m = 1;  // height at which the coordinate is 1
    SampleSurface surface;
    double steepest_per_m = 0;  // upper limit of the coordinate's slope, per metre of the hand
    double bend_per_m2 = 0;     // upper limit of the coordinate's curvature, per square metre of the hand
  };

  // Range of the map's values.
  struct Spread {
    double least = 0, most = 0;
    double share_of(double value) const noexcept;  // 0 at the least value, 1 at the largest; 0 without a difference
  };
  static Spread spread_of(const scene::SharedLawMap& map, std::span<const float> values);
  double most_loss_j(const MapLaw& law, const scene::SharedLawMap& map) const;

  // The family and the map on one scale.
  struct OnScale {
    std::shared_ptr<const MapLaw> law;
    MapLaw::Steepness steepness;
    double least_j = 0;
    double most_loss_j = 0;  // largest loss of a cycle at any point of the map
    double stiffness_n_per_m = 0;
    Laid columns, rows;
  };
  const OnScale& on(scene::ScaleMode mode) const noexcept { return scales_[static_cast<std::size_t>(mode)]; }
  static MapLaw::Place place_at(const OnScale& scale, const glm::dvec2& xy_m, double lateral_m_per_m) noexcept;
  physics::Force tip_force(physics::Phase phase, const MapLaw::Mixture& mixture, double z_m) const noexcept;
  double damp(const MapLaw& law, const MapLaw::Place& place, double hand_m, double elapsed_s) noexcept;
  double strength_of_vibration(const OnScale& scale, const MapLaw::Place& place, double hand_m, physics::Phase before,
                               double elapsed_s) noexcept;
  void note_jump(const MapLaw& law, const Scaling& scale, const MapLaw::Place& place, double hand_m,
                 physics::Phase before, MapTouch& touch) const noexcept;

  std::shared_ptr<const LawFamily> family_;
  std::shared_ptr<const physics::LawTables> nominal_;
  std::array<OnScale, scene::kScaleModes.size()> scales_;
  physics::Phase phase_ = physics::Phase::WaitForLift;
  double above_in_m_ = 0, above_off_m_ = 0;  // height of the hand above the two jumps in the previous step
  double most_damping_n_s_per_m_ = 0;        // largest damping; 0: the map is not viscous
  double damping_n_s_per_m_ = 0;
  scene::MapVibration vibrates_by_;
  Spread ln_modulus_, adhesion_j_per_m2_;
  std::unique_ptr<FeltVibration> vibration_;
  double vibrates_ = 0;     // strength of the vibration, 0 to 1
  double touched_s_ = 1e3;  // time since the tip touched; large if the touch is no longer felt
};

}  // namespace afm::haptics
