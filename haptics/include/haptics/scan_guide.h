// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "haptics/device.h"
#include "haptics/energy_tank.h"
#include "haptics/workspace_stop.h"

namespace afm::haptics {

// Leads a resting hand along the path of a scan, by a spring to an attractor that follows the path. Its force passes
// through SafetyGovernor like any other. Positions are those of the hand in the device frame, from the contact point.
//
// - It begins at the hand, without force. The attractor is on a leash from the hand, which grows from zero to its
//   length within kRiseS. The spring, of at most kStiffnessNPerM, therefore never pulls with more than kMostForceN, or
//   less on a weaker device. A hand that does not follow keeps the attractor near it.
// - The attractor follows its path with the lag kLagS, so that the steps between frames are not felt, and no faster
//   than kFastestMPerS.
// - A spring only gives back the energy that the hand puts in. The energy added by the attractor's motion comes from an
//   EnergyTank and is counted exactly in Pull::given_j; if the tank is empty, the attractor waits. A hand cannot get
//   more than the tank's contents and refill.
// - It releases the hand at once when Turn-On is released, and when the path ends, jumps (faster than kJumpMPerS) or
//   leaves the reach of the hand. After a jump or an exit it waits until Turn-On has been released.
//
// Servo's thread; neither allocates nor throws.
class ScanGuide {
 public:
  static constexpr double kStiffnessNPerM = 100.0;
  static constexpr double kShareOfStiffness = 0.25;  // largest share of the stiffness that the device can render
  static constexpr double kMostForceN = 0.6;         // largest force of the spring, felt by a hand held still
  static constexpr double kDampingNSPerM = 2.0;      // damping of the hand, applied by the governor
  static constexpr double kRiseS = 1.0;
  static constexpr double kLagS = 0.05;
  static constexpr double kFastestMPerS = 0.15;
  static constexpr double kJumpMPerS = 0.25;  // speed between two points of the path that counts as a jump
  static constexpr double kJumpM = 0.002;     // shortest jump; shorter steps are never jumps, however fast

  // `device` includes the operator's limits.
  explicit ScanGuide(const DeviceSpec& device);

  // Point of the path, in the hand's metres along the axes of the sample, and in the device frame.
  struct Target {
    std::int64_t time_ns = 0;  // time of the frame that sent it
    glm::dvec3 in_sample_m{0.0};
    glm::dvec3 in_device_m{0.0};
  };

  struct Input {
    glm::dvec3 hand_m{0.0};
    std::optional<Target> target;
    bool force_on = false;  // true: the governor lets forces through
    bool turn_on = false;   // true: Turn-On is held down
    double elapsed_s = 0;   // time since the previous tick
  };

  // Pull of the attractor in this tick, and the related input of PassivityObserver.
  struct Pull {
    bool leads = false;
    glm::dvec3 force_n{0.0};
    double stored_j = 0;
    double given_j = 0;  // part of stored_j added by the attractor's motion in this tick
    double stiffness_n_per_m = 0;
  };
  Pull step(const Input& input) noexcept;

  // Used for another material or scale.
  void reset() noexcept;

  double stiffness_n_per_m() const noexcept { return stiffness_n_per_m_; }
  double most_force_n() const noexcept { return most_force_n_; }
  bool leads() const noexcept { return leads_; }
  bool lost() const noexcept { return lost_; }  // true: Turn-On must be released before it leads again

 private:
  bool is_reached_by(const Target& target) noexcept;
  double stored_j(const glm::dvec3& hand_m) const noexcept;
  void move_attractor(const glm::dvec3& target_m, const glm::dvec3& hand_m, double elapsed_s) noexcept;

  double stiffness_n_per_m_;
  double most_force_n_;
  WorkspaceStop stop_;
  EnergyTank tank_;
  std::optional<Target> target_;  // newest point of the path
  glm::dvec3 attractor_m_{0.0};
  double led_s_ = 0;
  bool leads_ = false;
  bool lost_ = false;  // true: hand lost, until Turn-On is released
};

}  // namespace afm::haptics
