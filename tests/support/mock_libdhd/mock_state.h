// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <mutex>

#include "haptics/devices/person_script.h"

// Hidden visibility, so that each variant of the library has its own state.
#pragma GCC visibility push(hidden)

// State behind the mock's two interfaces.
namespace mock_dhd {

// Numbers of the interface, repeated here so that a slip in the program's own does not go unnoticed.
enum : int { kComError = 2, kNoDevice = 5, kExpertModeOff = 9 };
enum : int { kPower = 0, kConnected = 1, kStarted = 2, kReset = 3, kIdle = 4, kForce = 5, kBrake = 6, kError = 9 };
enum : int { kForceOffCause = 14, kStatusCount = 17, kOffByWatchdog = 3 };

inline constexpr int kMostDevices = 4;
inline constexpr char kFirstId = 3;  // id of the first device, different from its index
inline constexpr double kMostForceN = 2.0 + 1e-9;

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
  int reset_lasts = -1;  // number of forces; negative: until a test ends it
  bool connected = true;
  bool failed = false;
  bool unplugged = false;
  Mode mode = Mode::Brake;
  long long force_mode_delay_ns = 0;
  long long force_mode_at_ns = -1;  // time of the switch-on; negative: not requested
  int cause = 0;
  std::array<double, 3> force_n{};
  double max_force_n = -1;
  bool gravity = false;

  bool expert = false;
  long long watchdog_ns = 0;
  long long last_force_ns = 0;
  afm::support::PersonScript script;
  bool uses_clock = false;
  long long time_ns = 0;

  std::array<Rule, 16> rules{};
  std::array<const char*, 256> calls{};
  unsigned call_count = 0;
  const char* violation = nullptr;
};

extern Mock mock;
extern std::mutex mutex;  // held by every function
extern std::atomic<bool> blocked;
extern std::atomic<int> caught;  // number of calls that do not return

void forbid(const char* violation);

// Time of the device's watchdog.
long long now_ns();

// Performs the autonomous actions of the device's controller.
void run_controller();

}  // namespace mock_dhd

#pragma GCC visibility pop
