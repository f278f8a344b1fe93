// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "core/result.h"
#include "haptics/device.h"
#include "physics/law_tables.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// One scale of length and one of force, on which several materials are felt side by side.
struct CommonScale {
  double hand_m_per_m = 0;
  double hand_n_per_n = 0;
};

// From nanometres and nanonewtons to a hand. Heights are the hand's above the device's contact point, along the
// sample's normal; Z and forces on the tip as in physics/contact.h.
//
// The map of Z is linear, so that events keep their places. What pulls fills a stroke: it reaches up to Z_joc, or to
// where the attraction before contact has fallen to kFaintShare of the strongest pull where that is higher. Without any
// pull (Hertz) a push of 20 mm is a tenth of the tip's radius, as deep as a contact law goes, on a stroke of 50 mm.
//
// - Fit: each material has a stroke of 50 mm, and its strongest pull is as strong as the device may be, at most 2.0 N.
//   For the paper's law that is one spring, 2.0 N / 50 mm = 40 N/m, whatever the material: what differs is where in the
//   stroke the tip snaps in, and how hard.
// - Compressed: Fit with a force of gain * asinh(F / F0), which leaves the strongest pull as it is and raises weak
//   forces. F0 is half the snap-in, or as much more as the limits below ask for: where a law pulls from afar, that is
//   nearly Fit.
// - Common: one scale for all materials, so that they can be compared. The longest stroke of all fills what the
//   workspace holds between 20 mm of push and 20 mm of recoil: Z = 0 lies lower than in the other two. The strongest
//   pull of all is as strong as the device may be. On an Omni, for the paper's materials, 0.8 mm/nm and 0.20 N/nN.
//
// - Atoms: Fit along the normal, and sideways so large that a lattice step is kAtomM wide in the hand. Sideways a
// hand's
//   metre is then fewer metres of the nanoworld than along z, and a surface as much flatter.
//
// In all of them the force map is odd up to three quarters of the cap; beyond, repulsion bends so that it stays below
// it. It keeps zero and is monotone: integrated over the height it is a potential, so that it adds no energy to a law
// that has one. Where the force rises more steeply against the hand than kMaxStiffnessNPerM or the device's own limit,
// on any branch and at any height that the device reaches, the force scale gives way. Falling forces (the pull that
// grows towards a fold) have no stiffness to limit.
class Scaling {
 public:
  static constexpr double kStrokeM = 0.050;
  static constexpr double kPushM = 0.020;
  static constexpr double kRecoilM = 0.020;            // above the highest release
  static constexpr double kMaxStiffnessNPerM = 400.0;  // stable on every device of this class at 1 kHz
  static constexpr double kFaintShare = 0.02;          // of 2.0 N: below what the governor arms at
  static constexpr double kFaintestPullN = 0.05;       // less is not felt by a hand that moves
  static constexpr double kAtomM = 0.0019;             // of hand: a lattice step
  static constexpr double kUsualPeriodM = 0.52e-9;     // mica's, for a material whose lattice is not known

  // Both fail if the device is too weak or too small, and if the pull of so stiff a contact would be too faint to feel.
  static core::Result<Scaling> fit(const physics::LawTables& tables, const DeviceSpec& device);
  static core::Result<Scaling> compressed(const physics::LawTables& tables, const DeviceSpec& device);

  // `period_m`: of the lattice, 0 for none.
  static core::Result<Scaling> atoms(const physics::LawTables& tables, const DeviceSpec& device, double period_m);

  // Metres of hand sideways for a metre of the nanoworld, on a scale that has so many along the normal.
  static double lateral_m_per_m(scene::ScaleMode mode, double hand_m_per_m, double period_m) noexcept;

  // `scale`, or less of it where this material alone would not suit the device: one that was changed since the scale
  // was made. Faint forces stay faint.
  static core::Result<Scaling> common(const physics::LawTables& tables, const DeviceSpec& device,
                                      const CommonScale& scale);

  // The common scale of all these; at least one. Takes a millisecond for each.
  static core::Result<CommonScale> common_scale(std::span<const std::shared_ptr<const physics::LawTables>> materials,
                                                const DeviceSpec& device);

  // Height of the hand where Z = 0 on the common scale; in the other modes that is 0.
  static double common_zero_m(const DeviceSpec& device) noexcept;

  scene::ScaleMode mode() const noexcept { return mode_; }
  double hand_m_per_m() const noexcept { return hand_m_per_m_; }
  double hand_n_per_n() const noexcept { return hand_n_per_n_; }  // of the strongest pull; constant but in Compressed

  double lateral_m_per_m() const noexcept { return lateral_m_per_m_; }             // of hand, sideways
  double flattening() const noexcept { return hand_m_per_m_ / lateral_m_per_m_; }  // of the slopes of a surface

  double z_m(double hand_height_m) const noexcept { return (hand_height_m - zero_m_) / hand_m_per_m_; }
  double hand_height_m(double z_m) const noexcept { return zero_m_ + z_m * hand_m_per_m_; }

  // At and above this height the tip is free, whatever it did before.
  double release_height_m() const noexcept { return release_m_; }
  double release_z_m() const noexcept { return z_m(release_m_); }

  // The force on the hand along the sample's normal for a force on the tip; both positive away from the sample.
  double hand_force_n(double tip_force_n) const noexcept;

 private:
  Scaling() = default;

  scene::ScaleMode mode_ = scene::ScaleMode::Fit;
  double hand_m_per_m_ = 0;
  double lateral_m_per_m_ = 0;
  double hand_n_per_n_ = 0;
  double zero_m_ = 0;
  double release_m_ = kStrokeM;
  double cap_n_ = 0;
  double bend_n_ = 0;       // F0, on the tip; 0: no compression
  double bend_gain_n_ = 0;  // on the hand
};

// Magnitude of the strongest attraction on either branch: at the jumps, or on the way to them where the lever is stiff.
double strongest_pull_n(const physics::LawTables& tables);

// Magnitude of the force that a scale makes as strong as the device may be: the strongest pull, or the deepest push of
// a material that hardly pulls.
double strongest_force_n(const physics::LawTables& tables);

// F0 of the compressed scale as it would be on a device without limits: half the snap-in; without one a tenth of the
// strongest force. Not above that force.
double compression_bend_n(const physics::LawTables& tables);

}  // namespace afm::haptics
