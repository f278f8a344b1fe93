// SPDX-License-Identifier: Apache-2.0
#include "devices/gamepad_device.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

#include "devices/sdl_library.h"
#include "haptics/safety.h"
#include "support/no_alloc.h"

// Virtual joysticks of the real SDL2, and for force feedback, which those lack, its functions replaced by ours. SDL's
// thread runs in real time; how long anything takes decides nothing.
namespace gamepad_device_test {

using namespace afm::haptics;
using afm::core::ErrorCategory;
using afm::core::MonotonicClock;
using testing::HasSubstr;

// Commands to the motors; written by SDL's thread.
std::atomic<int> heaviest{0}, lightest{0}, rumbles{0};
int SDLCALL take_rumble(void* /*user*/, Uint16 heavy, Uint16 light) {
  heaviest = std::max<int>(heaviest, heavy);
  lightest = light;
  ++rumbles;
  return 0;
}

// Commands to the force-feedback effect.
std::atomic<int> level{0}, comes_from_x{0}, comes_from_y{0}, stops{0};
int SDLCALL is_haptic(SDL_Joystick*) { return 1; }
SDL_Haptic* SDLCALL open_haptic(SDL_Joystick* joystick) { return reinterpret_cast<SDL_Haptic*>(joystick); }
void SDLCALL close_haptic(SDL_Haptic*) {}
unsigned SDLCALL constant_force(SDL_Haptic*) { return SDL_HAPTIC_CONSTANT; }
unsigned SDLCALL rumble_only(SDL_Haptic*) { return SDL_HAPTIC_LEFTRIGHT; }
int SDLCALL new_effect(SDL_Haptic*, SDL_HapticEffect*) { return 0; }
int SDLCALL run_effect(SDL_Haptic*, int, Uint32) { return 0; }
int SDLCALL stop_effect(SDL_Haptic*, int) { return ++stops, 0; }
int SDLCALL update_effect(SDL_Haptic*, int, SDL_HapticEffect* effect) {
  level = effect->constant.level;
  comes_from_x = effect->constant.direction.dir[0];
  comes_from_y = effect->constant.direction.dir[1];
  return 0;
}

// Made by a governor, the only possible source, in simulated time and with a hand at rest.
ForceCommand force_of(const glm::dvec3& wanted_n) {
  SafetyGovernor governor({.workspace_min_m = glm::dvec3(-1.0), .workspace_max_m = glm::dvec3(1.0)});
  GovernorInput input{
      .hand_height_m = 0.06, .phase = afm::physics::Phase::Free, .renderer = RendererLink::Alive, .law_energy = {}};
  for (int tick = 0;; ++tick) {
    input.time_ns += 1'000'000;
    input.turn_on = tick > 10;
    if (tick > 700) input.wanted_force_n = wanted_n;
    const auto output = governor.step(input);
    if (tick < 1000) continue;
    EXPECT_EQ(output.command.force_n(), wanted_n);
    return output.command;
  }
}

class GamepadDeviceTest : public testing::Test {
 protected:
  GamepadDeviceTest() {
    heaviest = lightest = rumbles = level = comes_from_x = comes_from_y = stops = 0;
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    EXPECT_EQ(SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC), 0) << SDL_GetError();
  }
  ~GamepadDeviceTest() override {
    unplug();
    SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC);
  }

  void plug_in(SDL_JoystickType type) {
    SDL_VirtualJoystickDesc pad{};
    pad.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    pad.type = static_cast<Uint16>(type);
    pad.naxes = SDL_CONTROLLER_AXIS_MAX;
    pad.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
    pad.name = "Virtual Pad";
    pad.Rumble = &take_rumble;
    index_ = SDL_JoystickAttachVirtualEx(&pad);
    ASSERT_GE(index_, 0) << SDL_GetError();
    stick_ = SDL_JoystickOpen(index_);
    ASSERT_NE(stick_, nullptr) << SDL_GetError();
  }
  void unplug() {
    if (index_ >= 0) SDL_JoystickDetachVirtual(std::exchange(index_, -1));
    if (stick_ != nullptr) SDL_JoystickClose(std::exchange(stick_, nullptr));
  }
  void push(int axis, double share) {
    SDL_JoystickSetVirtualAxis(stick_, axis, static_cast<Sint16>(std::lround(32767.0 * share)));
  }
  void press(int button, bool down) { SDL_JoystickSetVirtualButton(stick_, button, down ? 1 : 0); }

  std::unique_ptr<GamepadDevice> open(GamepadDevice::Wanted wanted = GamepadDevice::Wanted::Any) {
    auto device = GamepadDevice::open(sdl, clock, wanted);
    EXPECT_TRUE(device) << device.error().message;
    return device ? std::move(*device) : nullptr;
  }

  // Ticks with this force until the condition holds; false after 20 s.
  template <class Condition>
  bool until(GamepadDevice& device, const ForceCommand& force, Condition&& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    do {
      hand = device.read(clock.now_ns());
      device.write(force);
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }

  SdlFunctions sdl = load_sdl().value();
  const MonotonicClock clock;
  const ForceCommand no_force = force_of(glm::dvec3(0.0));
  DeviceSample hand;

 private:
  int index_ = -1;
  SDL_Joystick* stick_ = nullptr;
};

TEST_F(GamepadDeviceTest, MovesTheHandUpAndSidewaysAtABoundedSpeed) {
  plug_in(SDL_JOYSTICK_TYPE_GAMECONTROLLER);
  const auto device = open();
  ASSERT_TRUE(device);
  EXPECT_EQ(device->spec().name, "Virtual Pad");
  ASSERT_TRUE(until(*device, no_force, [&] { return hand.healthy; }));
  const glm::dvec3 start = hand.position_m;

  push(SDL_CONTROLLER_AXIS_LEFTY, 1.0);  // down
  push(SDL_CONTROLLER_AXIS_RIGHTX, 1.0);
  const std::int64_t began_ns = clock.now_ns();
  ASSERT_TRUE(until(*device, no_force, [&] { return hand.position_m.y < start.y - 0.03; }));
  EXPECT_GT(hand.position_m.x, start.x + 0.01);
  const double seconds = 1e-9 * static_cast<double>(clock.now_ns() - began_ns);
  EXPECT_LT(start.y - hand.position_m.y, 0.1 * seconds + 0.002);  // 10 cm/s at most

  // at the end of its range it stays, and it can move back
  push(SDL_CONTROLLER_AXIS_LEFTY, 0.0);
  push(SDL_CONTROLLER_AXIS_RIGHTX, 0.0);
  push(SDL_CONTROLLER_AXIS_LEFTY, -1.0);
  ASSERT_TRUE(until(*device, no_force, [&] { return hand.position_m.y > 0.0745; }));
  EXPECT_LT(hand.position_m.y, 0.0755);
  EXPECT_FALSE(hand.turn_on);
  press(SDL_CONTROLLER_BUTTON_A, true);
  EXPECT_TRUE(until(*device, no_force, [&] { return hand.turn_on; }));
}

TEST_F(GamepadDeviceTest, LeavesTheHandWhereItIsWhenNobodyTouchesTheStick) {
  plug_in(SDL_JOYSTICK_TYPE_GAMECONTROLLER);
  const auto device = open();
  ASSERT_TRUE(device);
  push(SDL_CONTROLLER_AXIS_LEFTY, 0.10);
  int ticks = 0;
  ASSERT_TRUE(until(*device, no_force, [&] { return ++ticks > 200; }));
  EXPECT_NEAR(hand.position_m.y, 0.060, 1e-12);
}

TEST_F(GamepadDeviceTest, LetsTheForceMoveTheHandAndRumbles) {
  plug_in(SDL_JOYSTICK_TYPE_GAMECONTROLLER);
  const auto device = open();
  ASSERT_TRUE(device);
  int ticks = 0;
  ASSERT_TRUE(until(*device, no_force, [&] { return ++ticks > 50; }));
  EXPECT_EQ(heaviest, 0);
  const ForceCommand pull = force_of({0.0, -1.0, 0.0});
  ASSERT_TRUE(until(*device, pull, [&] { return heaviest == 65535 && lightest > 0; }));
  // 1 N on a grip of 200 N/m
  ASSERT_TRUE(until(*device, pull, [&] { return hand.position_m.y < 0.0555; }));
  EXPECT_TRUE(until(*device, no_force, [&] { return lightest == 0; }));
}

TEST_F(GamepadDeviceTest, IsSilentOnceTheServoHasStopped) {
  plug_in(SDL_JOYSTICK_TYPE_GAMECONTROLLER);
  const auto device = open();
  ASSERT_TRUE(device);
  ASSERT_TRUE(until(*device, force_of({0.0, -1.0, 0.0}), [] { return lightest > 0; }));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (lightest != 0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(lightest, 0);
}

TEST_F(GamepadDeviceTest, IsNotHealthyOnceItIsUnplugged) {
  plug_in(SDL_JOYSTICK_TYPE_GAMECONTROLLER);
  const auto device = open();
  ASSERT_TRUE(device);
  ASSERT_TRUE(until(*device, no_force, [&] { return hand.healthy; }));
  testing::internal::CaptureStderr();
  unplug();
  EXPECT_TRUE(until(*device, no_force, [&] { return !hand.healthy; }));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("Virtual Pad: unplugged"));
  const int orders = rumbles;
  int ticks = 0;
  EXPECT_FALSE(until(*device, force_of({0.0, -1.0, 0.0}), [&] { return hand.healthy || ++ticks > 100; }) &&
               hand.healthy);
  EXPECT_EQ(rumbles, orders);
}

TEST_F(GamepadDeviceTest, IsMissingWithoutAPadAndInAutoWithoutForceFeedback) {
  const auto none = GamepadDevice::open(sdl, clock, GamepadDevice::Wanted::Any);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(none.error().message, HasSubstr("none is plugged in"));

  plug_in(SDL_JOYSTICK_TYPE_GAMECONTROLLER);
  const auto weak = GamepadDevice::open(sdl, clock, GamepadDevice::Wanted::ForceFeedback);
  ASSERT_FALSE(weak);
  EXPECT_THAT(weak.error().message, HasSubstr("Virtual Pad has no force feedback"));
  const auto facts = GamepadDevice::list(sdl);
  ASSERT_TRUE(facts);
  ASSERT_EQ(facts->size(), 1U);
  EXPECT_TRUE(facts->front().rumble);
  EXPECT_FALSE(facts->front().force_feedback);
}

TEST_F(GamepadDeviceTest, PushesAForceFeedbackJoystickInTheDirectionOfTheForce) {
  sdl.is_haptic = &is_haptic;
  sdl.open_haptic = &open_haptic;
  sdl.close_haptic = &close_haptic;
  sdl.effects = &rumble_only;
  sdl.new_effect = &new_effect;
  sdl.run_effect = &run_effect;
  sdl.stop_effect = &stop_effect;
  sdl.update_effect = &update_effect;
  plug_in(SDL_JOYSTICK_TYPE_FLIGHT_STICK);
  EXPECT_FALSE(GamepadDevice::list(sdl)->front().force_feedback);
  sdl.effects = &constant_force;
  {
    const auto device = open(GamepadDevice::Wanted::ForceFeedback);
    ASSERT_TRUE(device);
    // a stick in the middle is a hand in the middle
    ASSERT_TRUE(until(*device, no_force, [&] { return std::abs(hand.position_m.y - 0.0225) < 0.001; }));
    push(1, -1.0);  // forward is up
    ASSERT_TRUE(until(*device, no_force, [&] { return hand.position_m.y > 0.07; }));

    // the direction is where it comes from: a pull down comes from the front
    ASSERT_TRUE(until(*device, force_of({0.0, -1.0, 0.0}), [] { return level > 0; }));
    EXPECT_EQ(level, 16384);  // half of the cap of 2 N
    EXPECT_EQ(comes_from_x, 0);
    EXPECT_LT(comes_from_y, 0);
    ASSERT_TRUE(until(*device, force_of({1.0, 0.0, 0.0}), [] { return comes_from_x < 0; }));
    EXPECT_EQ(comes_from_y, 0);
    ASSERT_TRUE(until(*device, no_force, [] { return level == 0; }));
  }
  EXPECT_EQ(stops, 1);
}

TEST_F(GamepadDeviceTest, DoesNotAllocateInATick) {
  plug_in(SDL_JOYSTICK_TYPE_GAMECONTROLLER);
  const auto device = open();
  ASSERT_TRUE(device);
  push(SDL_CONTROLLER_AXIS_LEFTY, 1.0);
  const ForceCommand pull = force_of({0.0, -1.0, 0.0});
  const afm::test::NoAllocation guard;
  for (int i = 0; i < 100; ++i) {
    hand = device->read(clock.now_ns());
    device->write(pull);
  }
}

}  // namespace gamepad_device_test
