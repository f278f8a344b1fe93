// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/geometric.hpp>

#include "haptics/safety.h"

namespace afm::haptics {

inline constexpr std::int64_t kPeriodNs = 1'000'000;
inline constexpr double kCapN = 2.0;
inline constexpr double kReleaseHeightM = 0.050;
inline constexpr double kRounding = 1e-12;

inline const SafetyLimits kLimits{.period_ns = kPeriodNs, .force_cap_n = kCapN, .release_height_m = kReleaseHeightM};

// Stiffness beyond every limit: a law of this stiffness may leak any energy, so that the passivity observer stays
// inactive.
inline constexpr double kBoundlessStiffness = 1e12;
inline const GovernorInput kStart{.time_ns = 1'000'000'000, .law_energy = {.stiffness_n_per_m = kBoundlessStiffness}};

// A governor and the input of its next tick, which tests change.
class Governor : public testing::Test {
 protected:
  double step(std::int64_t elapsed_ns = kPeriodNs) {
    input_.time_ns += elapsed_ns;
    const auto output = governor_.step(input_);
    dropped_ = output.dropped;
    force_n_ = output.command.force_n();
    return glm::length(force_n_);
  }

  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }

  // Makes the governor disarmed and ready for Turn-On.
  void lift() {
    input_.hand_height_m = 0.060;
    input_.hand_position_m = glm::dvec3(0.0, 0.060, 0.0);
    input_.phase = physics::Phase::Free;
    input_.renderer = RendererLink::Alive;
    steps(100);
  }

  void press() {
    input_.turn_on = true;
    step();
    input_.turn_on = false;
  }

  void arm() {
    lift();
    press();
    steps(500);
    ASSERT_EQ(governor_.state(), scene::ServoState::Running);
  }

  // Makes the governor Running, with `force_n` reached.
  void hold(double force_n) {
    arm();
    input_.phase = physics::Phase::Attached;
    input_.hand_height_m = 0.040;
    input_.wanted_force_n = glm::dvec3(0.0, -force_n, 0.0);
    steps(20);
    ASSERT_NEAR(step(), force_n, kRounding);
  }

  // Number of ticks until the command is exactly zero.
  int ticks_to_zero() {
    for (int i = 1; i < 10'000; ++i) {
      if (step() == 0.0) return i;
    }
    return -1;
  }

  void restart(const SafetyLimits& limits = kLimits) {
    governor_ = SafetyGovernor(limits);
    input_ = kStart;
  }

  SafetyGovernor governor_{kLimits};
  GovernorInput input_ = kStart;
  glm::dvec3 force_n_{0.0};
  bool dropped_ = false;
};

}  // namespace afm::haptics
