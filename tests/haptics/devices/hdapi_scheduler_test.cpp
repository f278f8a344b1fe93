// SPDX-License-Identifier: Apache-2.0
// Invariant: a driver that stalls or stops calling leaves no force on the hand
#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/clock.h"
#include "devices/hdapi_device.h"
#include "hdapi_bench.h"
#include "mock_control.h"
#include "support/places.h"

// The mock's scheduler and the device's supervisor as threads of their own, in real time.
namespace hdapi_scheduler_test {

using namespace afm::haptics;
using afm::core::MonotonicClock;

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

std::vector<std::string> calls() {
  std::vector<std::string> all;
  for (int i = 0; const char* call = mock_hd_call(i); ++i) all.emplace_back(call);
  return all;
}

class HdapiScheduler : public testing::Test {
 protected:
  HdapiScheduler() {
    mock_hd_reset();
    mock_hd_use_thread();
  }

  auto open() { return HdapiDevice::open(*load_hdapi(afm::support::mock_hd()).functions, clock, ""); }

  const MonotonicClock clock;
};

TEST_F(HdapiScheduler, HandsThePlaceOver) {
  auto device = open();
  ASSERT_TRUE(device) << device.error().message;
  mock_hd_set_position(1, 2, 3);
  EXPECT_TRUE(eventually([&] {
    const DeviceSample sample = (*device)->read(clock.now_ns());
    return sample.healthy && sample.position_m == 1e-3 * glm::dvec3(1, 2, 3);
  }));
}

TEST_F(HdapiScheduler, IsLeftInTheRightOrder) {
  {
    auto device = open();
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_TRUE(eventually([&] { return (*device)->read(clock.now_ns()).healthy; }));
  }
  const auto all = calls();
  ASSERT_GE(all.size(), 6U);
  EXPECT_EQ(all[0], "init");
  EXPECT_EQ(all[1], "start");
  EXPECT_THAT(std::vector<std::string>(all.end() - 4, all.end()),
              testing::ElementsAre("output_off", "stop", "unschedule", "disable_device"));
  EXPECT_EQ(mock_hd_violation(), nullptr) << mock_hd_violation();
}

TEST_F(HdapiScheduler, HasItsOutputCutByTheSupervisorWhenItStalls) {
  auto device = open();
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_TRUE(eventually([&] { return (*device)->read(clock.now_ns()).healthy; }));
  const std::size_t before = calls().size();
  mock_hd_stall(1);
  EXPECT_TRUE(eventually([&] { return calls().size() > before && calls().back() == "output_off"; }));
  EXPECT_TRUE(eventually([&] { return !(*device)->read(clock.now_ns()).healthy; }));
  mock_hd_stall(0);
  EXPECT_TRUE(eventually([&] { return (*device)->read(clock.now_ns()).healthy; }));
  EXPECT_EQ(mock_hd_violation(), nullptr) << mock_hd_violation();
}

TEST_F(HdapiScheduler, IsRefusedWhenItNeverCalls) {
  mock_hd_stall(1);
  const auto device = open();
  ASSERT_FALSE(device);
  EXPECT_THAT(device.error().message, testing::HasSubstr("did not call within 1 s"));
  EXPECT_EQ(calls().back(), "disable_device");
}

// The frame that would set zero never comes, and stopping the scheduler may hang in the driver.
TEST(StalledHdapi, IsSwitchedOffBeforeItsSchedulerIsStopped) {
  afm::test::HdapiBench bench;
  bench.hold_attached();
  mock_hd_stall(1);
  const std::size_t before = calls().size();
  bench.device.reset();
  const auto all = calls();
  ASSERT_GT(all.size(), before);
  EXPECT_EQ(all[before], "output_off");
}

}  // namespace hdapi_scheduler_test
