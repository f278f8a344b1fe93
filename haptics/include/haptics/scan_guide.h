// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "haptics/device.h"
#include "haptics/energy_tank.h"
#include "haptics/workspace_stop.h"

namespace afm::haptics {

// Leads a resting hand along the path of a scan: a spring to an attractor that follows the path. What it asks for goes
// through SafetyGovernor like any force. Places are the hand's in the device frame, from the contact point.
//
// - It begins where the hand is, without force: the attractor is on a leash of the hand, which grows from nothing to
//   its length in kRiseS. So the spring, of kStiffnessNPerM at most, never pulls with more than kMostForceN, less on a
//   device that may give less. A hand that does not come along keeps the attractor near it.
// - The attractor follows its path with the lag kLagS, so that the steps between frames are not felt, no faster than
//   kFastestMPerS.
// - A spring alone gives back what the hand puts in. What the attractor's motion adds comes from an EnergyTank, counted
//   to the bit in Pull::given_j: where the tank is empty the attractor waits. A hand cannot get more than its content
//   and its refill.
// - It lets go at once when Turn-On is released, and when the path ends, jumps (faster than kJumpMPerS) or leaves the
//   place where the hand can be. After the latter it waits until Turn-On has been released.
//
// For the servo's thread; neither allocates nor throws.
class ScanGuide {
 public:
  static constexpr double kStiffnessNPerM = 100.0;
  static constexpr double kShareOfStiffness = 0.25;  // of what the device renders, at most
  static constexpr double kMostForceN = 0.6;         // of the spring; a hand that is held still feels it
  static constexpr double kDampingNSPerM = 2.0;      // of the hand, by the governor
  static constexpr double kRiseS = 1.0;
  static constexpr double kLagS = 0.05;
  static constexpr double kFastestMPerS = 0.15;
  static constexpr double kJumpMPerS = 0.25;  // of the path, between two places of it
  static constexpr double kJumpM = 0.002;     // that is no jump however soon it comes

  // The device as the operator limits it.
  explicit ScanGuide(const DeviceSpec& device);

  // A place of the path, in the hand's metres along the axes of the sample, and in the device frame.
  struct Target {
    std::int64_t time_ns = 0;  // of the frame that sent it
    glm::dvec3 in_sample_m{0.0};
    glm::dvec3 in_device_m{0.0};
  };

  struct Input {
    glm::dvec3 hand_m{0.0};
    std::optional<Target> target;
    bool force_on = false;  // the governor lets forces through
    bool turn_on = false;   // held
    double elapsed_s = 0;   // since the tick before
  };

  // The attractor's pull in this tick, and what PassivityObserver needs of it.
  struct Pull {
    bool leads = false;
    glm::dvec3 force_n{0.0};
    double stored_j = 0;
    double given_j = 0;  // of stored_j: by the attractor's motion in this tick
    double stiffness_n_per_m = 0;
  };
  Pull step(const Input& input) noexcept;

  // For another material or scale.
  void reset() noexcept;

  double stiffness_n_per_m() const noexcept { return stiffness_n_per_m_; }
  double most_force_n() const noexcept { return most_force_n_; }
  bool leads() const noexcept { return leads_; }

 private:
  bool is_reached_by(const Target& target) noexcept;
  double stored_j(const glm::dvec3& hand_m) const noexcept;
  void move_attractor(const glm::dvec3& target_m, const glm::dvec3& hand_m, double elapsed_s) noexcept;

  double stiffness_n_per_m_;
  double most_force_n_;
  WorkspaceStop stop_;
  EnergyTank tank_;
  std::optional<Target> target_;  // the newest
  glm::dvec3 attractor_m_{0.0};
  double led_s_ = 0;
  bool leads_ = false;
  bool lost_ = false;  // until Turn-On is released
};

}  // namespace afm::haptics
