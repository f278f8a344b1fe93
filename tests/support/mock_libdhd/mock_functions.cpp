// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string_view>
#include <thread>

#include "mock_dhd_control.h"

// The functions of Force Dimension's interface, and those of mock_dhd_control.h. No call allocates.

namespace {

// Numbers of the interface, written down a second time so that a slip in the program's own does not hide here.
enum : int { kComError = 2, kNoDevice = 5, kExpertModeOff = 9 };
enum : int { kPower = 0, kConnected = 1, kStarted = 2, kReset = 3, kIdle = 4, kForce = 5, kBrake = 6, kError = 9 };
enum : int { kForceOffCause = 14, kStatusCount = 17, kOffByWatchdog = 3 };

constexpr int kMostDevices = 4;
constexpr char kFirstId = 3;  // no index
constexpr double kMostForceN = 2.0 + 1e-9;

enum class Mode { Brake, Idle, Force };

struct Rule {
  const char* function = nullptr;
  int value = 0;
  int error = 0;
  int times = 0;
};

struct Mock {
  int count = 1;
  int type = 33;
  const char* name = "omega.3";
  int major = 3;
  int minor = 17;
  bool hangs = false;

  std::array<bool, kMostDevices> open{};
  std::array<double, 3> position_m{};
  std::array<double, 3> told_m{};
  bool still = false;
  unsigned reads = 0;
  int buttons = 0;
  bool gripper = false;
  bool emulates_button = false;

  bool powered = true;
  bool reset = false;
  bool failed = false;
  bool unplugged = false;
  Mode mode = Mode::Brake;
  int cause = 0;
  std::array<double, 3> force_n{};
  double max_force_n = -1;
  bool gravity = false;

  bool expert = false;
  long long watchdog_ns = 0;
  long long last_force_ns = 0;
  bool uses_clock = false;
  long long time_ns = 0;

  std::array<Rule, 16> rules{};
  std::array<const char*, 256> calls{};
  unsigned call_count = 0;
  const char* violation = nullptr;
};

Mock mock;
std::mutex mutex;
std::atomic<bool> blocked{false};
thread_local int last_error = 0;

void record(const char* call) {
  if (mock.call_count < mock.calls.size()) mock.calls[mock.call_count++] = call;
}

void forbid(const char* text) {
  if (mock.violation == nullptr) mock.violation = text;
}

int fail(int error) {
  last_error = error;
  return -1;
}

long long now_ns() {
  if (!mock.uses_clock) return mock.time_ns;
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
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

// 0, or what a test wants of this call for a device.
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

// What the controller in the device does by itself.
void run_watchdog() {
  if (mock.mode != Mode::Force || mock.watchdog_ns == 0 || now_ns() - mock.last_force_ns <= mock.watchdog_ns) return;
  mock.mode = Mode::Brake;
  mock.cause = kOffByWatchdog;
}

void leave_reset() {
  if (mock.reset) forbid("a call ended the calibration");
}

void follow_environment() {
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
  run_watchdog();
  const bool passive = mock.reset || !mock.powered;
  std::fill(values, values + kStatusCount, 0);
  values[kPower] = mock.powered ? 1 : 0;
  values[kConnected] = 1;
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
  while (blocked) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::lock_guard lock(mutex);
  const int result = begin("dhdGetPosition", id);
  if (result < 0) return result;
  if (!mock.powered) return fail(kComError);
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
  run_watchdog();
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
  mock.mode = on != 0 ? Mode::Force : Mode::Brake;
  mock.last_force_ns = now_ns();
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

void mock_dhd_reset(void) {
  const std::lock_guard lock(mutex);
  mock = Mock{};
  blocked = false;
}

void mock_dhd_set_time(long long ns) {
  const std::lock_guard lock(mutex);
  mock.time_ns = ns;
}

void mock_dhd_use_clock(void) {
  const std::lock_guard lock(mutex);
  mock.uses_clock = true;
}

void mock_dhd_set_devices(int count, int type, const char* name) {
  const std::lock_guard lock(mutex);
  mock.count = std::min(count, kMostDevices);
  mock.type = type;
  mock.name = name;
}

void mock_dhd_set_version(int major, int minor) {
  const std::lock_guard lock(mutex);
  mock.major = major;
  mock.minor = minor;
}

void mock_dhd_set_position(double x_m, double y_m, double z_m) {
  const std::lock_guard lock(mutex);
  mock.position_m = {x_m, y_m, z_m};
}

void mock_dhd_set_buttons(int mask) {
  const std::lock_guard lock(mutex);
  mock.buttons = mask;
}

void mock_dhd_set_gripper(int has_gripper) {
  const std::lock_guard lock(mutex);
  mock.gripper = has_gripper != 0;
}

void mock_dhd_hold_still(void) {
  const std::lock_guard lock(mutex);
  mock.still = true;
}

namespace {

void add_rule(const Rule& rule) {
  const std::lock_guard lock(mutex);
  const auto free = std::find_if(mock.rules.begin(), mock.rules.end(), [](const Rule& old) { return old.times == 0; });
  if (free == mock.rules.end()) return forbid("too many rules of the mock");
  *free = rule;
}

}  // namespace

void mock_dhd_fail(const char* function, int error, int times) { add_rule({function, -1, error, times}); }
void mock_dhd_answer(const char* function, int value, int times) { add_rule({function, value, 0, times}); }

void mock_dhd_set_power(int on) {
  const std::lock_guard lock(mutex);
  mock.powered = on != 0;
  if (!mock.powered) mock.mode = Mode::Brake;
}

void mock_dhd_set_reset(int on) {
  const std::lock_guard lock(mutex);
  mock.reset = on != 0;
  if (mock.reset) mock.mode = Mode::Idle;
}

void mock_dhd_set_failed(int on) {
  const std::lock_guard lock(mutex);
  mock.failed = on != 0;
}

void mock_dhd_cut_force(int cause) {
  const std::lock_guard lock(mutex);
  mock.mode = Mode::Brake;
  mock.cause = cause;
}

void mock_dhd_press_force_button(void) {
  const std::lock_guard lock(mutex);
  mock.mode = Mode::Force;
  mock.force_n = {};
  mock.last_force_ns = now_ns();
}

void mock_dhd_unplug(void) {
  const std::lock_guard lock(mutex);
  mock.unplugged = true;
  mock.mode = Mode::Brake;
}

void mock_dhd_block(int on) { blocked = on != 0; }

void mock_dhd_force(double newtons[3]) {
  const std::lock_guard lock(mutex);
  run_watchdog();
  const bool felt = mock.mode == Mode::Force && mock.powered && !mock.reset && !mock.unplugged;
  for (std::size_t axis = 0; axis < 3; ++axis) newtons[axis] = felt ? mock.force_n[axis] : 0.0;
}

int mock_dhd_brakes(void) {
  const std::lock_guard lock(mutex);
  return mock.mode == Mode::Brake ? 1 : 0;
}

const char* mock_dhd_call(int index) {
  const std::lock_guard lock(mutex);
  const auto i = static_cast<unsigned>(index);
  return i < mock.call_count ? mock.calls[i] : nullptr;
}

double mock_dhd_max_force(void) {
  const std::lock_guard lock(mutex);
  return mock.max_force_n;
}

long long mock_dhd_watchdog_ns(void) {
  const std::lock_guard lock(mutex);
  return mock.watchdog_ns;
}

int mock_dhd_gravity(void) {
  const std::lock_guard lock(mutex);
  return mock.gravity ? 1 : 0;
}

const char* mock_dhd_violation(void) {
  const std::lock_guard lock(mutex);
  return mock.violation;
}
}
