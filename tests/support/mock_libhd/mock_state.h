// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "haptics/devices/person_script.h"

// State behind the mock's two interfaces, and the scheduler. Nothing here allocates once the scheduler runs.
namespace mock_hd {

// Numbers of the interface, repeated here so that a slip in the program's own does not go unnoticed.
enum : unsigned {
  kNoError = 0,
  kInvalidEnum = 0x0100,
  kExceededForce = 0x0201,
  kExceededImpulse = 0x0202,
  kExceededVelocity = 0x0203,
  kAlreadyInitiated = 0x0301,
  kNotConnected = 0x0303,
  kButtons = 0x2000,
  kPosition = 0x2050,
  kModel = 0x2501,
  kVendor = 0x2503,
  kSerial = 0x2504,
  kMaxWorkspace = 0x2550,
  kUsableWorkspace = 0x2551,
  kCalibrationStyle = 0x2555,
  kUpdateRate = 0x2600,
  kStiffness = 0x2602,
  kNominalForce = 0x2603,
  kContinuousForce = 0x2604,
  kMotorTemperature = 0x2605,
  kVelocityLimit = 0x2606,
  kImpulseLimit = 0x2607,
  kForce = 0x2700,
  kForceOutput = 0x4000,
  kCalibrated = 0x5000,
  kNeedsUpdate = 0x5001,
  kNeedsManualInput = 0x5002,
};

inline constexpr unsigned kInvalidHandle = 0xFFFFFFFF;
inline constexpr unsigned kDevice = 7;
inline constexpr int kAmplifiersOffTicks = 50;

using Callback = unsigned (*)(void*);
using Vector = std::array<double, 3>;

struct InitFailure {
  std::string name;  // name of the device; "*": any; empty: the default device
  unsigned error = 0;
  int times = 0;
};

class Mock {
 public:
  static Mock& instance();

  void reset();
  void follow_environment();

  void record(const char* call);
  void forbid(const char* violation);
  void push_error(unsigned code);
  unsigned pop_error();

  void start();
  void stop();
  void tick();
  Vector applied_force() const;
  bool in_scheduler_frame() const { return in_frame && std::this_thread::get_id() == ticking; }

  // set up while no scheduler runs
  std::vector<InitFailure> init_failures;
  afm::support::PersonScript script;
  bool threaded = false;
  bool hangs = false;  // true: hdInitDevice does not return
  double impulse_limit_n_per_ms = 2.0;
  double nominal_force_n = 3.3;
  double continuous_force_n = 0.88;
  double velocity_limit_mm_per_s = 1500.0;
  double stiffness_n_per_mm = 0.5;
  bool first_sensor_broken = false;  // true: NaN as the first motor's temperature
  double motor_temperature = 0.2;    // negative: no such measurement

  std::array<std::atomic<double>, 3> position_mm;
  std::atomic<bool> still{false};  // false: flickering positions, like those of encoders under a hand
  std::atomic<unsigned> reads{0};
  double tremor_mm() { return !still && ++reads % 2 == 0 ? 1e-4 : 0.0; }
  std::atomic<int> buttons{0};
  std::atomic<unsigned> calibration{kCalibrated};
  std::atomic<bool> stalled{false};
  std::atomic<bool> output{false};
  std::atomic<bool> running{false};
  std::atomic<bool> in_frame{false};
  std::array<std::atomic<double>, 3> set_force_n;

  std::mutex callbacks_mutex;  // held while the callbacks run
  Callback callback = nullptr;
  void* context = nullptr;

  std::array<std::atomic<const char*>, 256> calls{};
  std::atomic<unsigned> call_count{0};
  std::atomic<const char*> violation{nullptr};

 private:
  void play_script();
  void judge_tick();

  std::mutex errors_mutex_;
  std::array<unsigned, 32> errors_{};
  unsigned error_count_ = 0;

  std::thread::id ticking;
  Vector force_before_n_{};
  Vector position_before_mm_{};
  int amplifiers_off_ticks_ = 0;
  bool first_tick_ = true;
  std::uint64_t ticks_ = 0;
  std::thread scheduler_;
};

}  // namespace mock_hd
