// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "haptics/device.h"

namespace afm::haptics {

// Impedance of a hand that holds a pen, per axis: m x'' = -c x' + k (aim - x) + force.
struct HandImpedance {
  double mass_kg = 0.12;
  double damping_n_s_per_m = 2.0;
  double grip_stiffness_n_per_m = 200.0;
};

// Imperfections of a real device; none by default. An Omni's encoders have steps of 0.055 mm, and its joints a friction
// of up to 0.26 N (according to its data sheet).
struct DeviceFlaws {
  double quantum_m = 0;       // resolution of the reported position
  std::int64_t delay_ns = 0;  // delay of the reported position, 16 ms at most; motion between two ticks is not reported
  double friction_n = 0;      // Coulomb friction on each axis
};

inline constexpr DeviceFlaws kOmniFlaws{.quantum_m = 55e-6, .delay_ns = 1'000'000, .friction_n = 0.26};

// Person at an Omni: the grip is a spring between the hand and an aim that moves along minimum-jerk paths (Flash &
// Hogan 1985), and the force of the device moves the hand. Attraction thus really pulls the hand down, and pull-off
// lets it recoil.
//
// Between two reads the force is constant, the aim is assumed to move linearly, and the motion is solved in closed
// form: deterministic given the times of the ticks, exact at any tick length, bounded in cost. The workspace ends in
// inelastic stops. Friction opposes the motion at the beginning of a tick; a hand that it stops rests until the next
// tick.
//
// A person who pulls with 2 N must aim 10 mm above the height at which the tip detaches (2 N / 200 N/m).
class SimulatedDevice final : public HapticDevice {
 public:
  // The hand rests at `start_m`. The impedance must be oscillatory: c^2 < 4 m k.
  explicit SimulatedDevice(const glm::dvec3& start_m = glm::dvec3(0.0, 0.060, 0.0), const HandImpedance& hand = {},
                           const DeviceFlaws& flaws = {});

  const DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t now_ns) noexcept override;
  void write(const ForceCommand& command) noexcept override { force_n_ = command.force_n(); }
  void follow(const scene::HandScript& script) noexcept override { next_ = script; }

  const glm::dvec3& velocity_m_per_s() const noexcept { return velocity_m_per_s_; }

 private:
  glm::dvec3 aim_m(std::int64_t now_ns) const noexcept;
  void advance(int axis, double seconds, double aim_from_m, double aim_to_m) noexcept;
  double friction_n(int axis, double aim_m) const noexcept;
  glm::dvec3 reported_m(std::int64_t now_ns) noexcept;
  void begin_next_script() noexcept;

  DeviceSpec spec_;
  HandImpedance hand_;
  DeviceFlaws flaws_;
  scene::HandScript next_;  // newest script received, possibly the current one

  // current path, and the aim at the last read
  std::int64_t path_begin_ns_ = 0;
  double path_duration_s_ = 0;
  glm::dvec3 path_from_m_;
  glm::dvec3 path_to_m_;
  glm::dvec3 aim_m_;
  std::uint32_t script_ = 0;
  std::uint32_t finished_script_ = 0;

  glm::dvec3 position_m_;
  glm::dvec3 velocity_m_per_s_{0.0};
  glm::dvec3 force_n_{0.0};
  std::int64_t time_ns_ = 0;
  bool started_ = false;

  // positions of the last ticks, the newest at `newest_`
  struct Passed {
    std::int64_t time_ns = 0;
    glm::dvec3 position_m{0.0};
  };
  static constexpr std::size_t kPassed = 256;
  std::array<Passed, kPassed> passed_{};
  std::size_t newest_ = 0;
};

}  // namespace afm::haptics
