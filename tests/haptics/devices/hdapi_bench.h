// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "devices/hdapi_device.h"
#include "driver_bench.h"
#include "mock_control.h"
#include "support/places.h"

namespace afm::test {

// Driver with a scheduler that is replaced by the mock, which calls the device once in each tick.
struct HdapiMock {
  using Device = haptics::HdapiDevice;
  using Health = haptics::HdapiHealth;
  static constexpr double kContactMm = -20;  // a third of the mock's workspace of 120 mm

  static auto open(const core::Clock& clock) {
    return Device::open(*haptics::load_hdapi(support::mock_hd()).functions, clock, "", Device::Supervision::Caller);
  }
  static void reset() { mock_hd_reset(); }
  static void tick(Device& /*device*/, std::int64_t /*time_ns*/) { mock_hd_tick(); }
  static void set_position(double x_mm, double y_mm, double z_mm) { mock_hd_set_position(x_mm, y_mm, z_mm); }
  static void set_button(bool pressed) { mock_hd_set_buttons(pressed ? 1 : 0); }
  static std::array<double, 3> force() {
    std::array<double, 3> newtons;
    mock_hd_force(newtons.data());
    return newtons;
  }
  static const char* violation() { return mock_hd_violation(); }
};

using HdapiBench = DriverBench<HdapiMock>;

}  // namespace afm::test
