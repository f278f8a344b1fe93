// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>

#include "mock_dhd_control.h"
#include "mock_state.h"

namespace mock_dhd {

Mock mock;
std::mutex mutex;
std::atomic<bool> blocked{false};
std::atomic<int> caught{0};

void forbid(const char* text) {
  if (mock.violation == nullptr) mock.violation = text;
}

long long now_ns() {
  if (!mock.uses_clock) return mock.time_ns;
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

void run_controller() {
  if (mock.force_mode_at_ns >= 0 && now_ns() >= mock.force_mode_at_ns) {
    mock.mode = Mode::Force;
    mock.force_mode_at_ns = -1;
    mock.last_force_ns = now_ns();
  }
  if (mock.mode != Mode::Force || mock.watchdog_ns == 0 || now_ns() - mock.last_force_ns <= mock.watchdog_ns) return;
  mock.mode = Mode::Brake;
  mock.cause = kOffByWatchdog;
}

}  // namespace mock_dhd

using namespace mock_dhd;

namespace {

void add_rule(const Rule& rule) {
  const std::lock_guard lock(mutex);
  const auto free = std::find_if(mock.rules.begin(), mock.rules.end(), [](const Rule& old) { return old.times == 0; });
  if (free == mock.rules.end()) return forbid("too many rules of the mock");
  *free = rule;
}

}  // namespace

extern "C" {

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

void mock_dhd_delay_force_mode(int ms) {
  const std::lock_guard lock(mutex);
  mock.force_mode_delay_ns = 1'000'000LL * ms;
}

void mock_dhd_set_connected(int on) {
  const std::lock_guard lock(mutex);
  mock.connected = on != 0;
}

void mock_dhd_end_reset_after(int forces) {
  const std::lock_guard lock(mutex);
  mock.reset_lasts = forces;
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
  mock.last_force_ns = now_ns();
}

void mock_dhd_unplug(void) {
  const std::lock_guard lock(mutex);
  mock.unplugged = true;
  mock.mode = Mode::Brake;
}

void mock_dhd_block(int on) { blocked = on != 0; }
int mock_dhd_caught(void) { return caught; }

void mock_dhd_force(double newtons[3]) {
  const std::lock_guard lock(mutex);
  run_controller();
  const bool felt = mock.mode == Mode::Force && mock.powered && !mock.reset && !mock.unplugged;
  for (std::size_t axis = 0; axis < 3; ++axis) newtons[axis] = felt ? mock.force_n[axis] : 0.0;
}

int mock_dhd_brakes(void) {
  const std::lock_guard lock(mutex);
  run_controller();
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
