// SPDX-License-Identifier: Apache-2.0
#include "mock_state.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace mock_hd {

namespace {

constexpr double kPeriodMs = 1.0;

double length(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

double distance(const Vector& a, const Vector& b) { return length({a[0] - b[0], a[1] - b[1], a[2] - b[2]}); }

Vector load(const std::array<std::atomic<double>, 3>& v) { return {v[0].load(), v[1].load(), v[2].load()}; }

}  // namespace

Mock& Mock::instance() {
  static Mock mock;
  return mock;
}

void Mock::reset() {
  init_failures.clear();
  script.clear();
  threaded = hangs = false;
  impulse_limit_n_per_ms = 2.0;
  nominal_force_n = 3.3;
  continuous_force_n = 0.88;
  velocity_limit_mm_per_s = 1500.0;
  stiffness_n_per_mm = 0.5;
  first_sensor_broken = false;
  motor_temperature = 0.2;
  for (auto& value : position_mm) value = 0.0;
  still = false;
  for (auto& value : set_force_n) value = 0.0;
  buttons = 0;
  calibration = kCalibrated;
  stalled = false;
  output = false;
  in_frame = false;
  callback = nullptr;
  call_count = 0;
  violation = nullptr;
  error_count_ = 0;
  amplifiers_off_ticks_ = 0;
  first_tick_ = true;
  ticks_ = 0;
}

void Mock::follow_environment() {
  if (const char* fault = std::getenv("MOCK_HD_FAULT")) {
    const std::string_view name = fault;
    threaded = true;
    hangs = name == "hangs";
    if (name == "missing") init_failures.push_back({"*", kNotConnected, 1000});
    if (name == "busy") init_failures.push_back({"*", kAlreadyInitiated, 1000});
    if (name == "uncalibrated") calibration = kNeedsManualInput;
  }
  if (const char* file_name = std::getenv("MOCK_HD_SCRIPT")) {
    threaded = true;
    if (!script.load(file_name)) forbid("MOCK_HD_SCRIPT names no script");
  }
}

void Mock::record(const char* call) {
  const unsigned index = call_count.fetch_add(1);
  if (index < calls.size()) calls[index] = call;
}

void Mock::forbid(const char* text) {
  const char* none = nullptr;
  violation.compare_exchange_strong(none, text);
}

void Mock::push_error(unsigned code) {
  const std::lock_guard lock(errors_mutex_);
  if (error_count_ < errors_.size()) errors_[error_count_++] = code;
}

unsigned Mock::pop_error() {
  const std::lock_guard lock(errors_mutex_);
  return error_count_ == 0 ? +kNoError : errors_[--error_count_];
}

void Mock::start() {
  record("start");
  output = true;
  running = true;
  if (!threaded) return;
  scheduler_ = std::thread([this] {
    auto deadline = std::chrono::steady_clock::now();
    while (running) {
      tick();
      deadline = std::max(deadline + std::chrono::milliseconds(1), std::chrono::steady_clock::now());
      std::this_thread::sleep_until(deadline);
    }
  });
}

void Mock::stop() {
  record("stop");
  running = false;
  output = false;
  if (scheduler_.joinable()) scheduler_.join();
}

void Mock::tick() {
  if (!running || stalled) return;
  const std::lock_guard lock(callbacks_mutex);
  ticking = std::this_thread::get_id();
  play_script();
  if (callback != nullptr && callback(context) == 0) callback = nullptr;
  if (in_frame) forbid("a frame was not ended");
  in_frame = false;
  judge_tick();
  ++ticks_;
}

void Mock::play_script() {
  if (script.empty()) return;
  const auto moment = script.at(1e-3 * kPeriodMs * static_cast<double>(ticks_));
  for (unsigned axis = 0; axis < 3; ++axis) position_mm[axis] = moment.position_mm[axis];
  buttons = moment.buttons;
}

// Checks of the real driver after every tick: beyond a limit it reports an error and disables its amplifiers briefly.
void Mock::judge_tick() {
  const Vector force = applied_force();
  const Vector position = load(position_mm);
  const bool moved = !first_tick_;
  unsigned error = kNoError;
  if (!(length(force) <= nominal_force_n)) error = kExceededForce;
  if (moved && distance(force, force_before_n_) > impulse_limit_n_per_ms * kPeriodMs) error = kExceededImpulse;
  if (moved && distance(position, position_before_mm_) > velocity_limit_mm_per_s * 1e-3 * kPeriodMs) {
    error = kExceededVelocity;
  }
  if (amplifiers_off_ticks_ > 0) --amplifiers_off_ticks_;
  if (error != kNoError) {
    push_error(error);
    amplifiers_off_ticks_ = kAmplifiersOffTicks;
  }
  force_before_n_ = force;
  position_before_mm_ = position;
  first_tick_ = false;
}

Vector Mock::applied_force() const {
  if (!output || !running || amplifiers_off_ticks_ > 0) return {};
  return load(set_force_n);
}

}  // namespace mock_hd
