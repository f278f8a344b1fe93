// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "core/result.h"
#include "haptics/device.h"
#include "haptics/particle_scale.h"
#include "physics/law_tables.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// One scale of length and one of force, on which several materials are felt side by side; and that of the particles on
// them.
struct CommonScale {
  double hand_m_per_m = 0;
  double hand_n_per_n = 0;
  ParticleScale particles{};
};

// Scales from nanometres and nanonewtons to a hand. Heights are those of the hand above the device's contact point,
// along the sample's normal; Z and forces on the tip as in physics/contact.h.
//
// The map of Z is linear, so that events keep their relative positions. The attraction fills a stroke: up to Z_joc, or
// up to where the force before contact has fallen to kFaintShare of the strongest pull, if that is higher. Without
// any attraction (Hertz), a push of 20 mm corresponds to a tenth of the tip's radius, the depth to which a contact law
// is valid, on a stroke of 50 mm. For a lever that taps the stroke begins where its free swing clears the sample, and
// its push at an amplitude of zero is three quarters of the largest force.
//
// - Fit: each material has a stroke of 50 mm, and its strongest pull becomes the largest force allowed on the device,
//   at most 2.0 N. For the paper's law that is a single spring, 2.0 N / 50 mm = 40 N/m, for every material: only the
//   position and the strength of the snap-in differ.
// - Compressed: Fit with a force of gain * asinh(F / F0), which keeps the strongest pull and raises weak forces. F0 is
//   half the snap-in, or as much more as the limits below require: for a law with long-range attraction, this is nearly
//   Fit.
// - Common: one scale for all materials, so that they can be compared. The longest stroke fills the workspace between
//   20 mm of push and 20 mm of recoil; Z = 0 is lower than in the other two. The strongest pull of all materials
//   becomes the largest force allowed on the device. On an Omni, for the paper's materials: 0.8 mm/nm and 0.20 N/nN.
// - Particles: the lengths of ParticleScale, along and upwards. The sample's force is as strong as the device allows
//   beside that of the particles, which has its own scale.
// - Atoms: Fit along the normal, with a lateral scale so large that a lattice step is kAtomM wide in the hand.
//   Laterally, a metre of the hand is then fewer metres of the nanoworld than along z, and a surface is flatter by the
//   same factor.
//
// In all of them the force map is odd up to three quarters of the cap; beyond, repulsion bends so that it stays below
// the cap. The map keeps zero and is monotone: integrated over the height it is a potential, so that it adds no energy
// to a conservative law. Where the force rises more steeply against the hand than kMaxStiffnessNPerM or the device's
// own limit, on any branch and at any height within the device's reach, the force scale is reduced. Falling forces (a
// pull that grows towards a fold) have no stiffness to limit.
class Scaling {
 public:
  static constexpr double kStrokeM = 0.050;
  static constexpr double kPushM = 0.020;
  static constexpr double kRecoilM = 0.020;            // recoil above the highest release
  static constexpr double kMaxStiffnessNPerM = 400.0;  // limit of every device of this class at 1 kHz
  static constexpr double kFaintShare = 0.02;          // fraction of 2.0 N, below the force at which the governor arms
  static constexpr double kFaintestPullN = 0.05;       // weakest pull that a moving hand feels
  static constexpr double kAtomM = 0.0019;             // lattice step in the hand
  static constexpr double kUsualPeriodM = 0.52e-9;     // mica's period, for a material with an unknown lattice

  // Laws that are felt on one scale, of places on one sample (haptics/law_family.h); at least one. The longest stroke
  // and the strongest force of any determine it, and its stiffness is bounded for every one.
  using Laws = std::span<const std::shared_ptr<const physics::LawTables>>;

  // These functions fail if the device is too weak or too small, or if the pull of such a stiff contact would be too
  // faint to feel.
  static core::Result<Scaling> fit(Laws laws, const DeviceSpec& device);
  static core::Result<Scaling> fit(const physics::LawTables& tables, const DeviceSpec& device);
  static core::Result<Scaling> compressed(Laws laws, const DeviceSpec& device);

  // `period_m` is the period of the lattice, 0 for none.
  static core::Result<Scaling> atoms(Laws laws, const DeviceSpec& device, double period_m);

  // Lateral metres of the hand per metre of the nanoworld, for a scale with `hand_m_per_m` along the normal.
  static double lateral_m_per_m(scene::ScaleMode mode, double hand_m_per_m, double period_m) noexcept;

  // Uses `scale`, reduced if this material would not suit the device, after a change since the scale was
  // computed. Faint forces stay faint.
  static core::Result<Scaling> common(Laws laws, const DeviceSpec& device, const CommonScale& scale);
  static core::Result<Scaling> common(const physics::LawTables& tables, const DeviceSpec& device,
                                      const CommonScale& scale);

  // Scale of a material on which particles are pushed; `scale` has particles. Fails if the device is too small for its
  // pull at that scale.
  static core::Result<Scaling> particles(const physics::LawTables& tables, const DeviceSpec& device,
                                         const ParticleScale& scale);

  // Fails if the tip would be free of such particles only above the device.
  static core::Result<void> check_clear(const ParticleScale& scale, const DeviceSpec& device);

  // Common scale of all these materials; at least one. Takes a millisecond for each.
  static core::Result<CommonScale> common_scale(std::span<const std::shared_ptr<const physics::LawTables>> materials,
                                                const DeviceSpec& device);

  // Height of the hand at Z = 0 on the common scale; in the other modes it is 0.
  static double common_zero_m(const DeviceSpec& device) noexcept;

  scene::ScaleMode mode() const noexcept { return mode_; }
  double hand_m_per_m() const noexcept { return hand_m_per_m_; }
  double hand_n_per_n() const noexcept { return hand_n_per_n_; }  // at the strongest pull; varies only in Compressed

  double lateral_m_per_m() const noexcept { return lateral_m_per_m_; }             // lateral metres of the hand
  double flattening() const noexcept { return hand_m_per_m_ / lateral_m_per_m_; }  // divisor of a surface's slopes

  double z_m(double hand_height_m) const noexcept { return (hand_height_m - zero_m_) / hand_m_per_m_; }
  double hand_height_m(double z_m) const noexcept { return zero_m_ + z_m * hand_m_per_m_; }

  // Height at and above which the tip is free, whatever happened before.
  double release_height_m() const noexcept { return release_m_; }
  double release_z_m() const noexcept { return z_m(release_m_); }

  // Particles only: raises the height at which the tip is free to clear them with another tool than that of `scale`.
  void clear_particles(double clear_z_m) noexcept;

  // Force on the hand along the sample's normal for a force on the tip; both positive away from the sample.
  double hand_force_n(double tip_force_n) const noexcept;

 private:
  Scaling() = default;

  scene::ScaleMode mode_ = scene::ScaleMode::Fit;
  double hand_m_per_m_ = 0;
  double lateral_m_per_m_ = 0;
  double hand_n_per_n_ = 0;
  double zero_m_ = 0;
  double release_m_ = kStrokeM;
  double reach_m_ = 0;  // Particles: height above which the law is silent
  double cap_n_ = 0;
  double bend_n_ = 0;       // F0, force on the tip; 0: no compression
  double bend_gain_n_ = 0;  // gain of the compression, force on the hand
};

// Magnitude of the strongest attraction on either branch: at the jumps, or before them if the lever is stiff.
double strongest_pull_n(const physics::LawTables& tables);

// Magnitude of the force that a scale maps to the largest one on the device: the strongest pull, or the deepest push of
// a material with hardly any pull.
double strongest_force_n(const physics::LawTables& tables);

// F0 of the compressed scale on a device without limits: half the snap-in, or without one a tenth of the strongest
// force. Never above that force.
double compression_bend_n(const physics::LawTables& tables);

}  // namespace afm::haptics
