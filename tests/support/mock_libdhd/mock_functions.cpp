// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

#include "mock_state.h"

// The functions of Force Dimension's interface. No call allocates.

using namespace mock_dhd;

namespace {

thread_local int last_error = 0;

void record(const char* call) {
  if (mock.call_count < mock.calls.size()) mock.calls[mock.call_count++] = call;
}

int fail(int error) {
  last_error = error;
  return -1;
}

// The rule of a test for this call, used up; null: none.
const Rule* rule_for(const char* function) {
  for (Rule& rule : mock.rules) {
    if (rule.function == nullptr || rule.times == 0 || std::strcmp(rule.function, function) != 0) continue;
    if (rule.times > 0) --rule.times;
    return &rule;
  }
  return nullptr;
}

// 0, or the error of this call for a device, as prescribed by a test.
int begin(const char* function, char id) {
  if (id < kFirstId || id >= kFirstId + kMostDevices || !mock.open[static_cast<std::size_t>(id - kFirstId)]) {
    forbid("a device that is not open was called");
    return fail(kNoDevice);
  }
  if (mock.unplugged) return fail(kComError);
  const Rule* rule = rule_for(function);
  if (rule == nullptr) return 0;
  return rule->value < 0 ? fail(rule->error) : rule->value;
}

void leave_reset() {
  if (mock.reset) forbid("a call ended the calibration");
}

// The script plays with the machine's clock.
void play_script() {
  if (mock.script.empty()) return;
  const auto moment = mock.script.at(1e-9 * static_cast<double>(now_ns()));
  for (unsigned axis = 0; axis < 3; ++axis) mock.position_m[axis] = 1e-3 * moment.position_mm[(axis + 2) % 3];
  mock.buttons = moment.buttons;
}

void follow_environment() {
  if (const char* file_name = std::getenv("MOCK_DHD_SCRIPT")) {
    mock.uses_clock = true;
    if (mock.script.empty() && !mock.script.load(file_name)) forbid("MOCK_DHD_SCRIPT names no script");
  }
  const char* fault = std::getenv("MOCK_DHD_FAULT");
  if (fault == nullptr) return;
  mock.uses_clock = true;
  const std::string_view name = fault;
  if (name == "missing") mock.count = 0;
  if (name == "hangs") mock.hangs = true;
  if (name == "reset") mock.reset = true;
}

}  // namespace

extern "C" {

void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  const std::lock_guard lock(mutex);
  *major = mock.major;
  *minor = mock.minor;
  *release = 1;
  *revision = 0;
}

int dhdGetDeviceCount(void) {
  const std::lock_guard lock(mutex);
  follow_environment();
  if (const Rule* rule = rule_for("dhdGetDeviceCount")) return rule->value < 0 ? fail(rule->error) : rule->value;
  return mock.count;
}

int dhdOpenID(char index) {
  while (mock.hangs) std::this_thread::sleep_for(std::chrono::seconds(1));
  const std::lock_guard lock(mutex);
  if (const Rule* rule = rule_for("dhdOpenID")) return fail(rule->error);
  if (index < 0 || index >= mock.count) return fail(kNoDevice);
  record("open");
  mock.open[static_cast<std::size_t>(index)] = true;
  return kFirstId + index;
}

int dhdClose(char id) {
  const std::lock_guard lock(mutex);
  const bool away = mock.unplugged || !mock.powered || mock.reset;
  if (mock.mode != Mode::Brake && !away) forbid("a device was closed with its force on or its brakes off");
  record("close");
  const int result = begin("dhdClose", id);
  if (id >= kFirstId && id < kFirstId + kMostDevices) mock.open[static_cast<std::size_t>(id - kFirstId)] = false;
  return result;
}

int dhdErrorGetLast(void) { return last_error; }

const char* dhdErrorGetStr(int error) {
  switch (error) {
    case kComError:
      return "mock: communication failed";
    case kNoDevice:
      return "mock: no device";
    case 20:
      return "mock: in use";
    default:
      return "mock: some error";
  }
}

int dhdGetSystemType(char id) {
  const std::lock_guard lock(mutex);
  return begin("dhdGetSystemType", id) < 0 ? -1 : mock.type;
}

const char* dhdGetSystemName(char id) {
  const std::lock_guard lock(mutex);
  return begin("dhdGetSystemName", id) < 0 ? nullptr : mock.name;
}

int dhdGetSerialNumber(unsigned short* number, char id) {
  const std::lock_guard lock(mutex);
  const int result = begin("dhdGetSerialNumber", id);
  // every Falcon has the same
  *number = mock.type == 60 ? 0xFFFF : static_cast<unsigned short>(1234 + id - kFirstId);
  return result;
}

bool dhdHasGripper(char id) {
  const std::lock_guard lock(mutex);
  return begin("dhdHasGripper", id) >= 0 && mock.gripper;
}

int dhdGetEffectorMass(double* kilograms, char id) {
  const std::lock_guard lock(mutex);
  *kilograms = 0.187;
  return begin("dhdGetEffectorMass", id);
}

int dhdGetStatus(int* values, char id) {
  const std::lock_guard lock(mutex);
  const int result = begin("dhdGetStatus", id);
  if (result < 0) return result;
  run_controller();
  const bool passive = mock.reset || !mock.powered;
  std::fill(values, values + kStatusCount, 0);
  values[kPower] = mock.powered ? 1 : 0;
  values[kConnected] = mock.connected ? 1 : 0;
  values[kStarted] = 1;
  values[kReset] = mock.reset ? 1 : 0;
  values[kIdle] = !passive && mock.mode == Mode::Idle ? 1 : 0;
  values[kForce] = !passive && mock.mode == Mode::Force ? 1 : 0;
  values[kBrake] = !passive && mock.mode == Mode::Brake ? 1 : 0;
  values[kError] = mock.failed ? 1 : 0;
  values[kForceOffCause] = mock.cause;
  return result;
}

int dhdGetPosition(double* x, double* y, double* z, char id) {
  if (blocked) {
    ++caught;
    while (blocked) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --caught;
  }
  const std::lock_guard lock(mutex);
  const int result = begin("dhdGetPosition", id);
  if (result < 0) return result;
  if (!mock.powered) return fail(kComError);
  play_script();
  if (result == 0) {
    mock.told_m = mock.position_m;
    if (!mock.still && ++mock.reads % 2 == 0) mock.told_m[1] += 1e-7;
  }
  *x = mock.told_m[0];
  *y = mock.told_m[1];
  *z = mock.told_m[2];
  return result;
}

int dhdGetButton(int index, char id) {
  const std::lock_guard lock(mutex);
  const int result = begin("dhdGetButton", id);
  if (result < 0) return result;
  if (mock.gripper && !mock.emulates_button) return 0;
  return (mock.buttons >> index) & 1;
}

int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty, double tz, double grip,
                                        char id) {
  const std::lock_guard lock(mutex);
  if (tx != 0.0 || ty != 0.0 || tz != 0.0 || grip != 0.0) forbid("a torque or the gripper's force is not zero");
  // NaN compares false
  if (!(std::hypot(fx, fy, fz) <= kMostForceN)) forbid("a force is no number or too large");
  const int result = begin("dhdSetForceAndTorqueAndGripperForce", id);
  if (result < 0) return result;
  run_controller();
  if (mock.reset && std::hypot(fx, fy, fz) > 0.0) forbid("a force was set in reset mode");
  if (mock.reset && mock.reset_lasts > 0 && --mock.reset_lasts == 0) mock.reset = false;
  mock.force_n = {fx, fy, fz};
  mock.last_force_ns = now_ns();
  return result;
}

int dhdEnableForce(unsigned char on, char id) {
  const std::lock_guard lock(mutex);
  leave_reset();
  record(on != 0 ? "force_on" : "force_off");
  const int result = begin("dhdEnableForce", id);
  if (result < 0) return result;
  mock.mode = Mode::Brake;
  mock.force_mode_at_ns = on != 0 ? now_ns() + mock.force_mode_delay_ns : -1;
  run_controller();
  return result;
}

#ifndef MOCK_DHD_WITHOUT_BRAKES
int dhdSetBrakes(int on, char id) {
  const std::lock_guard lock(mutex);
  leave_reset();
  record(on != 0 ? "brakes_on" : "brakes_off");
  const int result = begin("dhdSetBrakes", id);
  if (result < 0) return result;
  mock.mode = on != 0 ? Mode::Brake : Mode::Idle;
  mock.force_mode_at_ns = -1;
  return result;
}
#endif

int dhdSetGravityCompensation(int on, char id) {
  const std::lock_guard lock(mutex);
  const int result = begin("dhdSetGravityCompensation", id);
  if (result >= 0) mock.gravity = on != 0;
  return result;
}

int dhdEmulateButton(unsigned char on, char id) {
  const std::lock_guard lock(mutex);
  if (!mock.gripper) forbid("a device without a gripper was asked for its button");
  mock.emulates_button = on != 0;
  return begin("dhdEmulateButton", id);
}

int dhdEnableExpertMode(void) {
  const std::lock_guard lock(mutex);
  mock.expert = true;
  return 0;
}

int dhdDisableExpertMode(void) {
  const std::lock_guard lock(mutex);
  mock.expert = false;
  return 0;
}

int dhdSetWatchdog(unsigned char eighths, char id) {
  const std::lock_guard lock(mutex);
  if (!mock.expert) {
    forbid("the watchdog was set outside expert mode");
    return fail(kExpertModeOff);
  }
  const int result = begin("dhdSetWatchdog", id);
  if (result >= 0) mock.watchdog_ns = 125'000LL * eighths;
  return result;
}

#ifndef MOCK_DHD_OF_OLD
int dhdSetMaxForce(double newtons, char id) {
  const std::lock_guard lock(mutex);
  const int result = begin("dhdSetMaxForce", id);
  if (result >= 0) mock.max_force_n = newtons;
  return result;
}
#endif
}
