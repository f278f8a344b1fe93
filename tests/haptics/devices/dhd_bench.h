// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "driver_bench.h"
#include "forcedimension/dhd_device.h"
#include "mock_dhd_control.h"
#include "support/places.h"

namespace afm::test {

// Driver with a thread that is replaced by the test, which runs one of its cycles in each tick.
struct DhdMock {
  using Device = haptics::DhdDevice;
  using Health = haptics::DhdHealth;
  static constexpr double kContactMm = -25;  // a third of an omega's 150 mm

  static auto open(const core::Clock& clock) {
    return Device::open(*haptics::load_dhd(support::mock_dhd()).functions, clock, "", Device::Supervision::Caller);
  }
  static void reset() { mock_dhd_reset(); }
  static void tick(Device& device, std::int64_t time_ns) {
    mock_dhd_set_time(time_ns);
    device.run_cycle();
  }
  static void set_position(double x_mm, double y_mm, double z_mm) {
    mock_dhd_set_position(1e-3 * z_mm, 1e-3 * x_mm, 1e-3 * y_mm);
  }
  static void set_button(bool pressed) { mock_dhd_set_buttons(pressed ? 1 : 0); }
  static std::array<double, 3> force() {
    std::array<double, 3> newtons;
    mock_dhd_force(newtons.data());
    return newtons;
  }
  static const char* violation() { return mock_dhd_violation(); }
};

using DhdBench = DriverBench<DhdMock>;

}  // namespace afm::test
