// SPDX-License-Identifier: Apache-2.0
#include "servo/replay.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "places.h"
#include "scene/shared/shared_segment.h"
#include "servo/session_friction.h"
#include "support/paper_model.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace {

using scene::FaultCode;
using scene::ServoState;
using scene::TipSample;
using testing::HasSubstr;

// The simulated hand on a device of another frame and other limits, which can fail.
class FaultyDevice final : public haptics::HapticDevice {
 public:
  FaultyDevice() : spec_(hand_.spec()) {
    spec_.name = "faulty device";
    spec_.contact_point_m = kContact;
    spec_.workspace_min_m += kContact;
    spec_.workspace_max_m += kContact;
    spec_.max_force_n = 2.0;
    spec_.max_slew_n_per_s = 400.0;
  }

  const haptics::DeviceSpec& spec() const noexcept override { return spec_; }
  haptics::DeviceSample read(std::int64_t now_ns) noexcept override {
    haptics::DeviceSample sample = hand_.read(now_ns);
    sample.position_m += kContact;
    sample.healthy = healthy;
    if (lost) sample.position_m.y = std::numeric_limits<double>::quiet_NaN();
    return sample;
  }
  void write(const haptics::ForceCommand& command) noexcept override { hand_.write(command); }
  void follow(const scene::HandScript& script) noexcept override { hand_.follow(script); }

  bool healthy = true;
  bool lost = false;

 private:
  static constexpr glm::dvec3 kContact{0.0123, -0.0207, 0.0031};
  haptics::SimulatedDevice hand_;
  haptics::DeviceSpec spec_;
};

// A servo in a time that comes irregularly, as on a busy machine, yet in the same way in every run. It records as
// touchafm does: a session for each material.
class Recording {
 public:
  explicit Recording(const scene::SharedModel& model = test::paper_model())
      : segment_(std::move(*scene::SharedSegment::create(model, 0))),
        renderer_(segment_.renderer_side()),
        loop_(std::move(*haptics::ServoLoop::create(segment_, device, {.rate_hz = 1000.0}))) {}

  void choose(int material) { renderer_.store(scene::Selection{.material = material, .revision = ++selection_}); }

  void aim(double height_m, double seconds, bool pressed = false, double sideways_m = 0.003) {
    renderer_.store(scene::HandScript{.target_m = {sideways_m, height_m, -0.002},
                                      .duration_s = seconds,
                                      .revision = ++script_,
                                      .turn_on_pressed = pressed ? 1U : 0U});
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick_) {
      if (heartbeats && tick_ % 16 == 0)
        renderer_.store(scene::RendererHeartbeat{.frame = ++frame_, .stop = stop ? 1U : 0U});
      now_ns += 1'000'000 + 37'000 * (tick_ % 11) - (tick_ % 7) * 51'000;
      loop_->tick(now_ns, 0);
      while (const auto sample = renderer_.pop_sample()) record(*sample);
      while (const auto event = renderer_.pop_event()) sessions.back().events.push_back(*event);
    }
  }

  void arm() {
    aim(0.062, 0.3);
    run(900);
    aim(0.062, 0.0, true);
    run(100);
    aim(0.062, 0.0);
    run(600);
  }

  void cycle() {
    arm();
    aim(-0.012, 0.7);
    run(1200);
    aim(0.065, 0.7);
    run(1300);
  }

  // As a frame of the wall does, about the room's x axis.
  void turn(double angle_rad) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), angle_rad, glm::dvec3(1.0, 0.2, 0.0)) *
                              scene::rest_room_from_node(segment_.model(), 1);
    scene::SceneTransforms transforms;
    transforms.count = segment_.model().node_count;
    for (auto& node : transforms.room_from_node) {
      std::copy_n(glm::value_ptr(turned), node.size(), node.begin());
    }
    renderer_.store(transforms);
    sessions.back().wall.push_back({.time_ns = now_ns, .room_from_sample = transforms.room_from_node[1]});
  }

  scene::TipState state() { return *renderer_.tip_state(); }

  FaultyDevice device;
  std::vector<RecordedSession> sessions;
  bool heartbeats = true;
  bool stop = false;
  std::int64_t now_ns = 7'000'000'000;

 private:
  void record(const TipSample& sample) {
    if (sessions.empty() || sessions.back().samples.back().material != sample.material) {
      RecordedSession& session = sessions.emplace_back();
      session.parameters = segment_.model().materials[static_cast<std::size_t>(sample.material)];
      session.material = session.parameters.name.data();
      session.device = *renderer_.device();
      session.rate_hz = 1000.0;
      session.room_from_sample = segment_.model().nodes[1].parent_from_node;
    }
    sessions.back().samples.push_back(sample);
  }

  scene::SharedSegment segment_;
  scene::RendererSide renderer_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  std::uint32_t selection_ = 0;
  std::uint32_t script_ = 0;
  std::uint64_t frame_ = 0;
  int tick_ = 0;
};

double strongest_n(const RecordedSession& session) {
  double strongest = 0;
  for (const TipSample& sample : session.samples) strongest = std::max(strongest, std::abs(sample.hand_force_n));
  return strongest;
}

void expect_same(const RecordedSession& session) {
  const auto replayed = replay(session);
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_EQ(replayed->ticks, session.samples.size());
  if (replayed->first) {
    ADD_FAILURE() << session.material << ": tick " << replayed->first->index << " of " << replayed->ticks << ", "
                  << replayed->first->quantity << " was " << replayed->first->recorded << ", is "
                  << replayed->first->replayed << "; " << replayed->different_ticks << " differ";
  }
  EXPECT_FALSE(replayed->first_event);
  EXPECT_EQ(replayed->largest_hand_n, 0.0);
}

TEST(Replay, GivesEveryBitOfEveryMaterialAgainWhateverWasFeltBefore) {
  Recording recording;
  for (const int material : {test::kMica, test::kGold, test::kMica}) {
    recording.choose(material);
    recording.cycle();
    recording.cycle();
  }
  ASSERT_EQ(recording.sessions.size(), 3U);
  for (const RecordedSession& session : recording.sessions) {
    EXPECT_GT(strongest_n(session), 1.0);
    EXPECT_GE(session.events.size(), 4U);
    expect_same(session);
  }
}

TEST(Replay, GivesTheFrictionAgain) {
  for (const auto law :
       {physics::FrictionLaw::Amontons, physics::FrictionLaw::ContactArea, physics::FrictionLaw::Lattice}) {
    auto model = test::paper_model();
    scene::SharedContact& mica = model.materials[test::kMica];
    mica.law = physics::Law::Dmt;
    mica.contact.reduced_modulus = physics::Pressure(5.15e10);
    mica.friction = {.law = law,
                     .lattice = physics::LatticeKind::Hexagonal,
                     .coefficient = 0.1,
                     .shear_strength = physics::Pressure(1e8),
                     .period = physics::Length(0.52e-9),
                     .corrugation = physics::Length(5e-12),
                     .lateral_stiffness = physics::Stiffness(1.0)};
    Recording recording(model);
    recording.choose(test::kMica);
    recording.arm();
    recording.aim(-0.006, 0.5);
    recording.run(800);
    recording.aim(-0.006, 0.4, false, 0.020);
    recording.run(600);
    recording.aim(0.065, 0.7);
    recording.run(900);
    const support::ScratchFolder folder;
    const std::string path = folder.file("friction.afms");
    ASSERT_TRUE(save_session(recording.sessions.front(), path));
    const auto loaded = load_session(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    double strongest = 0.0;
    for (const TipSample& sample : loaded->samples) {
      strongest = std::max(strongest, std::hypot(sample.lateral_force_n[0], sample.lateral_force_n[1]));
    }
    EXPECT_GT(strongest, 1e-11);
    expect_same(*loaded);
  }
}

// Half width, offset and slope of a loop that the hand drew, within 1 % of what the numbers of the material say.
TEST(SessionFriction, IsMeasuredFromARecording) {
  auto model = test::paper_model();
  scene::SharedContact& mica = model.materials[test::kMica];
  mica.law = physics::Law::Dmt;
  mica.contact.reduced_modulus = physics::Pressure(5.15e10);
  mica.friction.law = physics::FrictionLaw::Amontons;
  mica.friction.coefficient = 0.1;
  mica.friction.lateral_stiffness = physics::Stiffness(1.0);
  Recording recording(model);
  recording.choose(test::kMica);
  recording.arm();
  recording.aim(-0.006, 0.5);
  recording.run(1200);
  for (const double x : {0.020, -0.020, 0.020, -0.020}) {
    recording.aim(-0.006, 0.8, false, x);
    recording.run(1100);
  }
  const RecordedSession& session = recording.sessions.front();
  const auto loop = friction_loop(session);
  ASSERT_TRUE(loop);
  const double load_n = session.samples.back().tip.force_n + 4.0 * M_PI * 50e-9 * 2.228e-3;
  EXPECT_NEAR(loop->half_width.si, 0.1 * load_n, 0.01 * 0.1 * load_n);
  EXPECT_NEAR(loop->offset.si, 0.0, 0.01 * 0.1 * load_n);
  EXPECT_NEAR(loop->slope.si, 1.0, 0.01);

  RecordedSession without = session;
  for (TipSample& sample : without.samples) sample.lateral_force_n = {};
  EXPECT_FALSE(friction_loop(without));
  without.samples.clear();
  EXPECT_FALSE(friction_loop(without));
}

TEST(Replay, TurnsTheSampleAgainAsTheWandTurnedIt) {
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  for (const double angle_rad : {0.1, 0.35, -0.2}) {
    recording.turn(angle_rad);
    recording.cycle();
  }
  ASSERT_EQ(recording.sessions.size(), 1U);
  RecordedSession session = recording.sessions.front();
  EXPECT_NE(session.samples.front().sample_normal, session.samples.back().sample_normal);
  expect_same(session);
  session.wall.clear();  // so that the frames are what did it
  EXPECT_FALSE(replay(session)->identical());
}

TEST(Replay, ComparesThePartThatItIsTold) {
  Recording recording;
  recording.choose(test::kGold);
  recording.cycle();
  RecordedSession session = recording.sessions.front();
  const std::size_t wrong = session.samples.size() / 2;
  session.samples[wrong].hand_force_n += 1e-12;
  const double wrong_s = session.seconds_since_start(session.samples[wrong].time_ns);
  const Replay whole = replay(session).value();
  EXPECT_EQ(whole.different_ticks, 1U);
  const Replay before = replay(session, {.to_s = wrong_s - 0.01}).value();
  const Replay after = replay(session, {.from_s = wrong_s + 0.01}).value();
  EXPECT_TRUE(before.identical());
  EXPECT_TRUE(after.identical());
  EXPECT_EQ(before.events + after.events, session.events.size());
  EXPECT_LT(before.ticks + after.ticks, whole.ticks);
  EXPECT_FALSE(replay(session, {.from_s = wrong_s - 0.01, .to_s = wrong_s + 0.01})->identical());
}

// Recorded by 0.1.0 with g++ 12 on x86-64: the same bits from every later version.
TEST(Replay, OfASessionOf010IsTheSameBitForBit) {
  const auto session = load_session(AFM_SOURCE_DIR "/tests/formats/0.1.0/session-gold.afms");
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_GT(strongest_n(*session), 0.5);
  expect_same(*session);
}

TEST(Replay, GivesTheNoiseOfALeverAgain) {
  scene::SharedModel model = test::paper_model();
  scene::SharedContact& mica = model.materials[test::kMica];
  mica.law = physics::Law::Dmt;
  mica.contact.reduced_modulus = physics::Pressure(51.5e9);
  mica.dynamic = 1;
  mica.lever = {physics::Frequency(12e3), 2.5, physics::Temperature(298.0)};
  Recording recording(model);
  recording.choose(test::kMica);
  recording.cycle();
  recording.choose(test::kGold);
  recording.cycle();
  recording.choose(test::kMica);
  recording.cycle();
  ASSERT_EQ(recording.sessions.size(), 3U);
  EXPECT_GT(strongest_n(recording.sessions[2]), 0.3);
  expect_same(recording.sessions[0]);
  expect_same(recording.sessions[2]);
}

TEST(Replay, GivesFaultsHangsAndLateTicksAgain) {
  Recording recording;
  recording.choose(test::kGold);
  recording.cycle();

  recording.arm();
  recording.aim(0.020, 0.5);
  recording.run(400);
  recording.heartbeats = false;  // the picture hangs, and is back
  recording.run(700);
  EXPECT_EQ(recording.state().fault, FaultCode::RendererHung);
  recording.heartbeats = true;
  recording.run(100);

  recording.arm();
  recording.now_ns += 60'000'000;
  recording.run(200);
  EXPECT_EQ(recording.state().fault, FaultCode::LateTick);

  for (bool FaultyDevice::* member : {&FaultyDevice::healthy, &FaultyDevice::lost}) {
    recording.arm();
    recording.aim(0.010, 0.3);
    recording.run(400);
    std::exchange(recording.device.*member, !(recording.device.*member));
    recording.run(50);
    EXPECT_EQ(recording.state().servo_state, ServoState::Fault);
    recording.device.*member = !(recording.device.*member);
    recording.aim(0.062, 0.3, true);  // acknowledges
    recording.run(500);
  }
  recording.arm();
  recording.aim(0.010, 0.3);
  recording.run(400);
  recording.stop = true;
  recording.run(250);
  EXPECT_EQ(recording.state().fault, FaultCode::StopPressed);
  recording.stop = false;
  recording.run(50);
  recording.aim(0.062, 0.3, true);
  recording.run(500);
  // a material that is chosen in a fault
  recording.device.healthy = false;
  recording.run(10);
  recording.choose(test::kMica);
  recording.run(10);
  recording.device.healthy = true;
  recording.run(200);
  recording.aim(0.062, 0.1, true);
  recording.run(200);
  recording.cycle();

  ASSERT_EQ(recording.sessions.size(), 2U);
  for (const RecordedSession& session : recording.sessions) expect_same(session);
}

TEST(Replay, GivesForcesThatWerePutDownForHotMotorsAgain) {
  Recording recording;
  recording.choose(test::kMica);
  recording.arm();
  recording.aim(-0.030, 0.5);  // holds more than the motors stand for ever
  recording.run(60'000);
  EXPECT_LT(recording.state().safety.thermal_gain, 1.0);
  recording.aim(0.065, 0.7);
  recording.run(1500);
  recording.choose(test::kGold);
  recording.cycle();
  ASSERT_EQ(recording.sessions.size(), 2U);
  for (const RecordedSession& session : recording.sessions) expect_same(session);
}

TEST(Replay, FindsOneBitThatIsNotTheSame) {
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  RecordedSession session = recording.sessions.front();
  double& force_n = session.samples[2000].hand_force_n;
  force_n = std::nextafter(force_n, 1.0);
  const auto one_tick = replay(session);
  ASSERT_TRUE(one_tick);
  EXPECT_FALSE(one_tick->identical());
  EXPECT_EQ(one_tick->different_ticks, 1U);
  EXPECT_EQ(one_tick->first->index, 2000U);
  EXPECT_EQ(one_tick->first->quantity, "hand_force_N");

  session = recording.sessions.front();
  session.events.pop_back();
  EXPECT_EQ(replay(session)->first_event->quantity, "count");
}

// Where each number that the servo computed lies in a record.
template <class Record>
std::vector<std::pair<std::string, std::ptrdiff_t>> results_of(const Record& record) {
  std::vector<std::pair<std::string, std::ptrdiff_t>> results;
  const auto* begin = reinterpret_cast<const std::byte*>(&record);
  const auto add = [&](const char* name, const auto& value) {
    results.emplace_back(name, reinterpret_cast<const std::byte*>(&value) - begin);
  };
  for_each_result(
      [&]<class Value>(const char* name, const Value& value) {
        if constexpr (scene::Described<Value>) {
          for_each_leaf(add, value);
        } else {
          add(name, value);
        }
      },
      record);
  return results;
}

template <class Record>
void flip_bit(Record& record, std::ptrdiff_t offset) {
  reinterpret_cast<std::byte*>(&record)[offset] ^= std::byte{1};
}

TEST(Replay, ComparesEveryNumberThatTheServoComputed) {
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  const RecordedSession original = recording.sessions.front();
  std::vector<std::string> quantities;
  for (const auto& [name, offset] : results_of(original.samples[2000])) {
    RecordedSession session = original;
    flip_bit(session.samples[2000], offset);
    EXPECT_EQ(replay(session, {.from_s = 2.0})->first.value_or(Difference{}).quantity, name);
    quantities.push_back(name);
  }
  for (const auto& [name, offset] : results_of(original.events[1])) {
    RecordedSession session = original;
    flip_bit(session.events[1], offset);
    EXPECT_EQ(replay(session)->first_event.value_or(Difference{}).quantity, name);
    quantities.push_back(name);
  }
  EXPECT_THAT(quantities, testing::ElementsAre("z_m", "force_N", "tip_height_m", "deflection_m", "sample_deformation_m",
                                               "hand_height_m", "hand_force_N", "servo_state", "phase", "tip_x_m",
                                               "tip_y_m", "surface_height_m", "lateral_x_N", "lateral_y_N", "kind",
                                               "time_ns", "z_m", "force_before_N", "force_after_N"));
}

TEST(Replay, IsTheSameFromAFile) {
  const support::ScratchFolder folder;
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  ASSERT_TRUE(save_session(recording.sessions.front(), folder.file("s.afms")));
  const auto loaded = load_session(folder.file("s.afms"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  expect_same(*loaded);
}

}  // namespace
}  // namespace afm::servo
