// SPDX-License-Identifier: Apache-2.0
// Invariant: a driver's thread that stalls leaves no force on the hand
#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/clock.h"
#include "forcedimension/dhd_device.h"
#include "mock_dhd_control.h"
#include "support/places.h"

// The driver's thread and its supervisor as threads of their own, in real time.
namespace dhd_threads_test {

using namespace afm::haptics;

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
  for (int i = 0; const char* call = mock_dhd_call(i); ++i) all.emplace_back(call);
  return all;
}

class DhdThreads : public testing::Test {
 protected:
  DhdThreads() {
    mock_dhd_reset();
    mock_dhd_use_clock();
  }

  auto open() { return DhdDevice::open(*load_dhd(afm::support::mock_dhd()).functions, clock, ""); }

  const afm::core::MonotonicClock clock;
};

TEST_F(DhdThreads, HandThePlaceOver) {
  auto device = open();
  ASSERT_TRUE(device) << device.error().message;
  mock_dhd_set_position(0.003, 0.001, 0.002);
  EXPECT_TRUE(eventually([&] {
    const DeviceSample sample = (*device)->read(clock.now_ns());
    return sample.healthy && glm::distance(sample.position_m, glm::dvec3(0.001, 0.002, 0.003)) < 1e-6;
  }));
}

TEST_F(DhdThreads, AreLeftWithTheBrakesOn) {
  {
    auto device = open();
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_TRUE(eventually([&] { return (*device)->read(clock.now_ns()).healthy; }));
  }
  const auto all = calls();
  ASSERT_GE(all.size(), 4U);
  EXPECT_EQ(std::vector<std::string>(all.end() - 3, all.end()),
            (std::vector<std::string>{"force_off", "brakes_on", "close"}));
  EXPECT_EQ(mock_dhd_violation(), nullptr) << mock_dhd_violation();
}

TEST_F(DhdThreads, HaveTheForceCutByTheSupervisorWhileACallDoesNotComeBack) {
  auto device = open();
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_TRUE(eventually([&] { return (*device)->read(clock.now_ns()).healthy && mock_dhd_brakes() == 0; }));
  const std::size_t before = calls().size();
  mock_dhd_block(1);
  // the device's own watchdog acts, too, but makes no call
  EXPECT_TRUE(eventually([&] { return calls().size() > before && calls().back() == "brakes_on"; }));
  EXPECT_TRUE(eventually([&] { return !(*device)->read(clock.now_ns()).healthy; }));
  mock_dhd_block(0);
  EXPECT_TRUE(eventually([&] { return (*device)->read(clock.now_ns()).healthy; }));
  EXPECT_EQ(mock_dhd_violation(), nullptr) << mock_dhd_violation();
}

// The destructor waits for the caught thread, but not with the force on.
TEST_F(DhdThreads, AreLeftWithTheForceOffThoughACallDoesNotComeBack) {
  auto device = open();
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_TRUE(eventually([&] { return mock_dhd_brakes() == 0; }));
  mock_dhd_block(1);
  ASSERT_TRUE(eventually([] { return mock_dhd_caught() == 1; }));
  const std::size_t before = calls().size();
  std::thread end([&] { device->reset(); });
  EXPECT_TRUE(eventually([&] { return calls().size() > before && calls().back() == "brakes_on"; }));
  mock_dhd_block(0);
  end.join();
  EXPECT_EQ(calls().back(), "close");
}

TEST_F(DhdThreads, AreRefusedWhenTheFirstCallDoesNotComeBack) {
  mock_dhd_block(1);
  std::thread end([] {
    // the device is given up
    EXPECT_TRUE(eventually([] { return mock_dhd_caught() == 1; }));
    const std::size_t before = calls().size();
    EXPECT_TRUE(eventually([before] { return calls().size() > before && calls().back() == "brakes_on"; }));
    mock_dhd_block(0);
  });
  const auto device = open();
  end.join();
  ASSERT_FALSE(device);
  EXPECT_THAT(device.error().message, testing::HasSubstr("did not answer within 1 s"));
  EXPECT_EQ(calls().back(), "close");
}

}  // namespace dhd_threads_test
