// SPDX-License-Identifier: Apache-2.0
#include "haptics/recorded_device.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "scene/shared/shared_segment.h"
#include "support/paper_model.h"

namespace recorded_device_test {

using namespace afm::haptics;
using afm::scene::HandScript;
using afm::scene::RendererHeartbeat;
using afm::scene::Selection;
using afm::scene::SharedSegment;
using afm::scene::TipSample;
using testing::HasSubstr;

// Passes everything on and stores the actions of the hand.
class Recorder final : public HapticDevice {
 public:
  const DeviceSpec& spec() const noexcept override { return hand_.spec(); }
  DeviceSample read(std::int64_t now_ns) noexcept override {
    const DeviceSample sample = hand_.read(now_ns);
    recorded.push_back({sample.position_m - spec().contact_point_m, sample.turn_on});
    return sample;
  }
  void write(const ForceCommand& command) noexcept override { hand_.write(command); }
  void follow(const HandScript& script) noexcept override { hand_.follow(script); }

  std::vector<RecordedHand> recorded;

 private:
  SimulatedDevice hand_;
};

// Ticks that come irregularly, as on a busy machine, yet in the same way in every run.
std::vector<TipSample> run(HapticDevice& device, int ticks) {
  auto segment = std::move(*SharedSegment::create(afm::test::paper_model(), 0));
  auto renderer = segment.renderer_side();
  auto loop = std::move(*ServoLoop::create(segment, device, {}));
  renderer.store(Selection{.material = afm::test::kMica, .revision = 1});
  std::vector<TipSample> samples;
  std::int64_t now_ns = 1'000'000'000;
  for (int tick = 0; tick < ticks; ++tick) {
    renderer.store(RendererHeartbeat{.time_ns = now_ns, .frame = static_cast<std::uint64_t>(tick)});
    const auto script = [&](double height_m, double seconds, bool pressed, std::uint32_t revision) {
      renderer.store(HandScript{.target_m = {0.003, height_m, -0.002},
                                .duration_s = seconds,
                                .revision = revision,
                                .turn_on_pressed = pressed ? 1U : 0U});
    };
    if (tick == 300) script(0.060, 0.0, true, 1);
    if (tick == 400) script(0.060, 0.0, false, 2);
    if (tick == 1000) script(-0.015, 0.8, false, 3);
    if (tick == 2500) script(0.065, 0.8, false, 4);
    now_ns += 1'000'000 + 37'000 * (tick % 11) - (tick % 7) * 51'000;
    loop->tick(now_ns, 0);
    while (const auto sample = renderer.pop_sample()) samples.push_back(*sample);
  }
  return samples;
}

TEST(RecordedDevice, GivesTheSameForcesAgainBitForBit) {
  constexpr int kTicks = 4000;
  Recorder recorder;
  const auto first = run(recorder, kTicks);
  auto replay = RecordedDevice::create("cycle", recorder.recorded);
  ASSERT_TRUE(replay);
  const auto second = run(**replay, kTicks);

  ASSERT_EQ(first.size(), second.size());
  double strongest_n = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].tip.z_m, second[i].tip.z_m) << i;
    ASSERT_EQ(first[i].tip.force_n, second[i].tip.force_n) << i;
    ASSERT_EQ(first[i].hand_force_n, second[i].hand_force_n) << i;
    ASSERT_EQ(first[i].servo_state, second[i].servo_state) << i;
    strongest_n = std::max(strongest_n, std::abs(second[i].hand_force_n));
  }
  EXPECT_GT(strongest_n, 1.5);  // force of a whole cycle
  EXPECT_TRUE((*replay)->finished());
}

TEST(RecordedDevice, RestsAtItsEndWithTheButtonReleased) {
  auto replay = RecordedDevice::create("two ticks", {{glm::dvec3(0, 0.01, 0), false}, {glm::dvec3(0, 0.02, 0), true}});
  ASSERT_TRUE(replay);
  EXPECT_EQ((*replay)->read(0).position_m.y, 0.01);
  EXPECT_TRUE((*replay)->read(1).turn_on);
  for (int i = 0; i < 3; ++i) {
    const DeviceSample rest = (*replay)->read(2 + i);
    EXPECT_EQ(rest.position_m.y, 0.02);
    EXPECT_FALSE(rest.turn_on);
    EXPECT_TRUE(rest.healthy);
  }
}

TEST(RecordedDevice, RefusesNothingAndWhatCannotBe) {
  const auto empty = RecordedDevice::create("x.afms", {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().category, afm::core::ErrorCategory::BadInputFile);
  EXPECT_THAT(empty.error().message, HasSubstr("cannot replay x.afms: it contains no ticks"));
  for (const double y : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e4}) {
    const auto bad = RecordedDevice::create("x.afms", {{glm::dvec3(0), false}, {glm::dvec3(0, y, 0), false}});
    ASSERT_FALSE(bad);
    EXPECT_THAT(bad.error().message, HasSubstr("tick 1"));
  }
}

}  // namespace recorded_device_test
