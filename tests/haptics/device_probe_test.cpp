// SPDX-License-Identifier: Apache-2.0
#include "haptics/device_probe.h"

#include <gmock/gmock.h>

#include "mock_control.h"

namespace {

using namespace afm::haptics;
using afm::core::ErrorCategory;
using afm::core::MonotonicClock;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

auto line(const char* subject, bool usable, const char* said) {
  return AllOf(Field(&ProbeLine::subject, HasSubstr(subject)), Field(&ProbeLine::usable, usable),
               Field(&ProbeLine::said, HasSubstr(said)));
}

constexpr unsigned kNotConnected = 0x0303;

class DeviceProbe : public testing::Test {
 protected:
  DeviceProbe() {
    mock_hd_reset();
    mock_hd_use_thread();
  }

  // port 1 has no service
  const ProbeSettings mock{.hd_library = AFM_MOCK_HD, .hd_device = {}, .haply_port = 1};
  const ProbeSettings nowhere{.hd_library = "/nowhere/libHD.so", .hd_device = {}, .haply_port = 1};
  const MonotonicClock clock;
};

TEST_F(DeviceProbe, TakesARealDeviceBeforeTheSimulatedHand) {
  const auto opened = open_device(DeviceChoice::Auto, mock, clock);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened->device->spec().name, "Mock Touch, serial 0001");
  EXPECT_THAT(opened->lines,
              ElementsAre(line("libmock_hd.so", true, "loaded"), line("hdapi device", true, "Mock Touch")));
}

TEST_F(DeviceProbe, FallsBackToTheSimulatedHandAndSaysWhy) {
  const auto no_library = open_device(DeviceChoice::Auto, nowhere, clock);
  ASSERT_TRUE(no_library);
  EXPECT_EQ(no_library->device->spec().name, "simulated hand");
  EXPECT_THAT(
      no_library->lines,
      ElementsAre(line("hdapi library /nowhere/libHD.so", false, "No such file"), line("haply device", false, "port 1"),
                  line("gamepad", false, "none is plugged in"), line("simulated hand", true, "")));

  mock_hd_fail_init("*", kNotConnected, 100);
  const auto no_device = open_device(DeviceChoice::Auto, mock, clock);
  ASSERT_TRUE(no_device);
  EXPECT_THAT(
      no_device->lines,
      ElementsAre(line("libmock_hd.so", true, "loaded"), line("hdapi device", false, "mock: not connected"),
                  line("haply device", false, "port 1"), line("gamepad", false, ""), line("simulated hand", true, "")));
}

TEST_F(DeviceProbe, DoesNotReplaceADeviceThatWasNamed) {
  const auto no_library = open_device(DeviceChoice::Hdapi, nowhere, clock);
  ASSERT_FALSE(no_library);
  EXPECT_EQ(no_library.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(no_library.error().message, AllOf(HasSubstr("/nowhere/libHD.so"), HasSubstr("TOUCHAFM_HD_LIBRARY")));

  mock_hd_fail_init("*", kNotConnected, 100);
  const auto no_device = open_device(DeviceChoice::Hdapi, mock, clock);
  ASSERT_FALSE(no_device);
  EXPECT_EQ(no_device.error().category, ErrorCategory::DeviceMissing);

  const auto no_haply = open_device(DeviceChoice::Haply, mock, clock);
  ASSERT_FALSE(no_haply);
  EXPECT_EQ(no_haply.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(no_haply.error().message, HasSubstr("no haply inverse service at port 1"));

  const auto no_gamepad = open_device(DeviceChoice::Gamepad, mock, clock);
  ASSERT_FALSE(no_gamepad);
  EXPECT_EQ(no_gamepad.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(no_gamepad.error().message, HasSubstr("no gamepad: none is plugged in"));
}

TEST_F(DeviceProbe, OpensTheSimulatedHandWithoutLookingFurther) {
  const auto opened = open_device(DeviceChoice::Simulated, mock, clock);
  ASSERT_TRUE(opened);
  EXPECT_THAT(opened->lines, ElementsAre(line("simulated hand", true, "")));
  EXPECT_EQ(mock_hd_call(0), nullptr);
}

TEST_F(DeviceProbe, ListsWhatIsThereWithoutStartingIt) {
  EXPECT_THAT(probe_devices(mock),
              ElementsAre(line("libmock_hd.so", true, "loaded"),
                          line("hdapi device", true, "3.3 N at most, 0.88 N for ever, 160 x 120 x 70 mm"),
                          line("haply device", false, "port 1"), line("gamepad", false, "none is plugged in"),
                          line("simulated hand", true, "")));
  EXPECT_STREQ(mock_hd_call(0), "init");
  EXPECT_STREQ(mock_hd_call(1), "disable_device");
  EXPECT_EQ(mock_hd_call(2), nullptr);
}

}  // namespace
