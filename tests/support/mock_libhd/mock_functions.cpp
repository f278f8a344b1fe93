// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>
#include <utility>

#include "mock_control.h"
#include "mock_state.h"

// The 36 functions of the vendor's interface, and the functions of mock_control.h.

using mock_hd::Mock;

namespace {

struct Error {
  unsigned code;
  int internal_code;
  unsigned device;
};

Mock& mock() { return Mock::instance(); }

const char* words(unsigned error) {
  switch (error) {
    case mock_hd::kNoError:
      return "nothing";
    case mock_hd::kExceededForce:
      return "mock: too much force";
    case mock_hd::kExceededImpulse:
      return "mock: too sudden a force";
    case mock_hd::kExceededVelocity:
      return "mock: too fast";
    case mock_hd::kAlreadyInitiated:
      return "mock: in use";
    case mock_hd::kNotConnected:
      return "mock: not connected";
    default:
      return "mock: some error";
  }
}

void on_scheduler(const char* violation) {
  if (!mock().in_scheduler_frame()) mock().forbid(violation);
}

double one_value(unsigned property) {
  switch (property) {
    case mock_hd::kStiffness:
      return mock().stiffness_n_per_mm;
    case mock_hd::kNominalForce:
      return mock().nominal_force_n;
    case mock_hd::kContinuousForce:
      return mock().continuous_force_n;
    case mock_hd::kVelocityLimit:
      return mock().velocity_limit_mm_per_s;
    case mock_hd::kImpulseLimit:
      return mock().impulse_limit_n_per_ms;
    case mock_hd::kMotorTemperature:
      if (mock().motor_temperature >= 0.0) return mock().motor_temperature;
      [[fallthrough]];
    default:
      mock().push_error(mock_hd::kInvalidEnum);
      return 0.0;
  }
}

template <class T>
void invalid(unsigned, T*) {
  mock().push_error(mock_hd::kInvalidEnum);
}

}  // namespace

extern "C" {

unsigned hdInitDevice(const char* name) {
  mock().record("init");
  mock().follow_environment();
  while (mock().hangs) std::this_thread::sleep_for(std::chrono::seconds(1));
  const std::string asked = name == nullptr ? "" : name;
  for (mock_hd::InitFailure& failure : mock().init_failures) {
    if (failure.times <= 0 || (failure.name != "*" && failure.name != asked)) continue;
    --failure.times;
    mock().push_error(failure.error);
    return mock_hd::kInvalidHandle;
  }
  return mock_hd::kDevice;
}

void hdDisableDevice(unsigned) {
  if (mock().running) mock().forbid("the device was released while its scheduler runs");
  if (mock().callback != nullptr) mock().forbid("the device was released before its callback");
  mock().record("disable_device");
}

void hdMakeCurrentDevice(unsigned) {}
unsigned hdGetCurrentDevice(void) { return mock_hd::kDevice; }

void hdBeginFrame(unsigned) {
  if (mock().in_frame.exchange(true)) mock().forbid("a frame was begun twice");
}

void hdEndFrame(unsigned) {
  if (!mock().in_frame.exchange(false)) mock().forbid("a frame was ended twice");
}

Error hdGetError(void) {
  const unsigned code = mock().pop_error();
  return {code, code == 0 ? 0 : -1, mock_hd::kDevice};
}

const char* hdGetErrorString(unsigned error) { return words(error); }

void hdEnable(unsigned capability) {
  if (capability != mock_hd::kForceOutput) return;
  mock().record("output_on");
  mock().output = true;
}

void hdDisable(unsigned capability) {
  if (capability != mock_hd::kForceOutput) return;
  mock().record("output_off");
  mock().output = false;
}

unsigned char hdIsEnabled(unsigned capability) { return capability == mock_hd::kForceOutput && mock().output ? 1 : 0; }

void hdGetBooleanv(unsigned property, unsigned char* values) { invalid(property, values); }
void hdGetFloatv(unsigned property, float* values) { invalid(property, values); }
void hdGetLongv(unsigned property, long* values) { invalid(property, values); }

void hdGetIntegerv(unsigned property, int* values) {
  if (property == mock_hd::kButtons) {
    on_scheduler("buttons were read outside a frame");
    values[0] = mock().buttons;
  } else if (property == mock_hd::kCalibrationStyle) {
    values[0] = 4;
  } else if (property == mock_hd::kUpdateRate) {
    values[0] = 1000;
  } else {
    invalid(property, values);
  }
}

void hdGetDoublev(unsigned property, double* values) {
  if (property == mock_hd::kPosition) {
    on_scheduler("a place was read outside a frame");
    for (unsigned axis = 0; axis < 3; ++axis) values[axis] = mock().position_mm[axis];
    values[0] += mock().tremor_mm();
  } else if (property == mock_hd::kMaxWorkspace || property == mock_hd::kUsableWorkspace) {
    const double box[6] = {-80, -60, -35, 80, 60, 35};
    std::copy(std::begin(box), std::end(box), values);
  } else {
    values[0] = one_value(property);
    if (property == mock_hd::kMotorTemperature && mock().first_sensor_broken) {
      values[1] = std::exchange(values[0], std::nan(""));
    }
  }
}

void hdSetBooleanv(unsigned property, const unsigned char* values) { invalid(property, values); }
void hdSetIntegerv(unsigned property, const int* values) { invalid(property, values); }
void hdSetFloatv(unsigned property, const float* values) { invalid(property, values); }
void hdSetLongv(unsigned property, const long* values) { invalid(property, values); }

void hdSetDoublev(unsigned property, const double* values) {
  if (property != mock_hd::kForce) return invalid(property, values);
  on_scheduler("a force was set outside a frame");
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(values[axis])) mock().forbid("a force is no number");
    mock().set_force_n[axis] = values[axis];
  }
}

const char* hdGetString(unsigned property) {
  switch (property) {
    case mock_hd::kModel:
      return "Mock Touch";
    case mock_hd::kVendor:
      return "TouchAFM tests";
    case mock_hd::kSerial:
      return "0001";
    default:
      mock().push_error(mock_hd::kInvalidEnum);
      return nullptr;
  }
}

unsigned hdCheckCalibration(void) { return mock().calibration; }
unsigned hdCheckCalibrationStyle(void) { return mock().calibration; }

void hdUpdateCalibration(unsigned) {
  mock().record("update_calibration");
  if (mock().output) mock().forbid("a calibration was updated with the force on");
  if (mock().calibration == mock_hd::kNeedsUpdate) mock().calibration = mock_hd::kCalibrated;
}

void hdUpdateCalibrationMessage(unsigned style) { hdUpdateCalibration(style); }
void hdScaleGimbalAngles(double, double, double, double*) {}
unsigned char hdDeploymentLicense(const char*, const char*, const char*) { return 1; }

void hdStartScheduler(void) { mock().start(); }
void hdStopScheduler(void) { mock().stop(); }
void hdSetSchedulerRate(unsigned long) {}

void hdScheduleSynchronous(unsigned (*callback)(void*), void* context, unsigned short) { callback(context); }

unsigned long hdScheduleAsynchronous(unsigned (*callback)(void*), void* context, unsigned short) {
  const std::lock_guard lock(mock().callbacks_mutex);
  mock().callback = callback;
  mock().context = context;
  return 1;
}

#ifndef MOCK_HD_WITHOUT_UNSCHEDULE
void hdUnschedule(unsigned long) {
  mock().record("unschedule");
  const std::lock_guard lock(mock().callbacks_mutex);
  mock().callback = nullptr;
}
#endif

unsigned char hdWaitForCompletion(unsigned long, unsigned) { return 0; }
double hdGetSchedulerTimeStamp(void) { return 0.0; }

void mock_hd_reset(void) { mock().reset(); }
void mock_hd_use_thread(void) { mock().threaded = true; }
void mock_hd_tick(void) { mock().tick(); }

void mock_hd_set_position(double x_mm, double y_mm, double z_mm) {
  mock().position_mm[0] = x_mm;
  mock().position_mm[1] = y_mm;
  mock().position_mm[2] = z_mm;
}

void mock_hd_hold_still() { mock().still = true; }

void mock_hd_set_buttons(int buttons) { mock().buttons = buttons; }

void mock_hd_fail_init(const char* name, unsigned error, int times) {
  mock().init_failures.push_back({name == nullptr ? "" : name, error, times});
}

void mock_hd_push_error(unsigned error) { mock().push_error(error); }
void mock_hd_set_calibration(unsigned status) { mock().calibration = status; }

void mock_hd_set_limit(unsigned property, double value) {
  switch (property) {
    case mock_hd::kStiffness:
      mock().stiffness_n_per_mm = value;
      break;
    case mock_hd::kNominalForce:
      mock().nominal_force_n = value;
      break;
    case mock_hd::kContinuousForce:
      mock().continuous_force_n = value;
      break;
    case mock_hd::kVelocityLimit:
      mock().velocity_limit_mm_per_s = value;
      break;
    case mock_hd::kImpulseLimit:
      mock().impulse_limit_n_per_ms = value;
      break;
    case mock_hd::kMotorTemperature:
      mock().motor_temperature = value;
      break;
    default:
      mock().forbid("mock_hd_set_limit of an unknown property");
  }
}

void mock_hd_break_first_sensor(void) { mock().first_sensor_broken = true; }

void mock_hd_stall(int stalled) { mock().stalled = stalled != 0; }

void mock_hd_force(double newtons[3]) {
  const mock_hd::Vector force = mock().applied_force();
  std::copy(force.begin(), force.end(), newtons);
}

const char* mock_hd_call(int index) {
  const auto i = static_cast<std::size_t>(index);
  return i < std::min<std::size_t>(mock().call_count, mock().calls.size()) ? mock().calls[i].load() : nullptr;
}

const char* mock_hd_violation(void) { return mock().violation; }
}
