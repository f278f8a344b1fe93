// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.h"
#include "haptics/device.h"
#include "physics/law_tables.h"

namespace afm::haptics {

// From nanometres and nanonewtons to a hand, one material at a time ("fit").
//
// - The map of Z is linear, so that events keep their places. What pulls fills a stroke of 50 mm: it reaches up to
// Z_joc,
//   or to where the attraction before contact has fallen to kFaintShare of the strongest pull where that is higher.
//   Without any pull (Hertz) a push of 20 mm is a tenth of the tip's radius, as deep as a contact law goes.
// - The map of the force is linear for attraction and the first three quarters of repulsion, then bends so that it
// stays
//   below the cap: monotone and nowhere steeper than the linear part, so that it adds no energy and no stiffness. The
//   strongest pull is as strong as the device may be, at most 2.0 N; without any, the push at 20 mm is where it bends.
// - Where the force then rises more steeply against the hand than kMaxStiffnessNPerM, on any branch and at any depth
// the
//   device reaches, the force scale gives way: the pull is weaker than the cap.
//
// For the paper's law that is one spring, 2.0 N / 50 mm = 40 N/m, whatever the material: what differs is where in the
// stroke the tip snaps in, and how hard. Falling forces (the pull that grows towards a fold) have no stiffness to
// limit.
class FitScaling {
 public:
  static constexpr double kStrokeM = 0.050;
  static constexpr double kPushM = 0.020;
  static constexpr double kMaxStiffnessNPerM = 400.0;  // stable on every device of this class at 1 kHz
  static constexpr double kFaintShare = 0.02;          // of 2.0 N: below what the governor arms at
  static constexpr double kFaintestPullN = 0.05;       // less is not felt by a hand that moves

  // Fails if the device is too weak or too small, and if the pull of so stiff a contact would be too faint to feel.
  static core::Result<FitScaling> create(const physics::LawTables& tables, const DeviceSpec& device);

  double hand_m_per_m() const noexcept { return hand_m_per_m_; }
  double hand_n_per_n() const noexcept { return hand_n_per_n_; }

  // Z for a hand this high above the contact point along the sample's normal.
  double z_m(double hand_height_m) const noexcept { return hand_height_m / hand_m_per_m_; }

  // The force on the hand along the sample's normal for a force on the tip; both positive away from the sample.
  double hand_force_n(double tip_force_n) const noexcept;

 private:
  FitScaling(double hand_m_per_m, double hand_n_per_n, double cap_n)
      : hand_m_per_m_(hand_m_per_m), hand_n_per_n_(hand_n_per_n), cap_n_(cap_n) {}

  double hand_m_per_m_;
  double hand_n_per_n_;
  double cap_n_;
};

// Magnitude of the strongest attraction on either branch: at the jumps, or on the way to them where the lever is stiff.
double strongest_pull_n(const physics::LawTables& tables);

}  // namespace afm::haptics
