// SPDX-License-Identifier: Apache-2.0
#include "devices/hdapi_library.h"

#include "drivers/function_binder.h"

namespace afm::haptics {

namespace {

// Names of the library: 3.4 drives the Touch (USB, Ethernet), 3.0 the Omni (FireWire).
constexpr const char* kLibraryNames[] = {"libHD.so.3.4", "libHD.so.3.0", "libHD.so"};

// Reason for a refusal; empty if all functions were found.
std::string bind_all(void* library, HdapiFunctions& hd) {
  FunctionBinder binder(library);
  binder.bind("hdInitDevice", hd.init_device);
  binder.bind("hdDisableDevice", hd.disable_device);
  binder.bind("hdMakeCurrentDevice", hd.make_current_device);
  binder.bind("hdBeginFrame", hd.begin_frame);
  binder.bind("hdEndFrame", hd.end_frame);
  binder.bind("hdGetError", hd.get_error);
  binder.bind("hdGetErrorString", hd.get_error_string);
  binder.bind("hdEnable", hd.enable);
  binder.bind("hdDisable", hd.disable);
  binder.bind("hdGetIntegerv", hd.get_integers);
  binder.bind("hdGetDoublev", hd.get_doubles);
  binder.bind("hdSetDoublev", hd.set_doubles);
  binder.bind("hdGetString", hd.get_string);
  binder.bind("hdCheckCalibration", hd.check_calibration);
  binder.bind("hdUpdateCalibration", hd.update_calibration);
  binder.bind("hdStartScheduler", hd.start_scheduler);
  binder.bind("hdStopScheduler", hd.stop_scheduler);
  binder.bind("hdSetSchedulerRate", hd.set_scheduler_rate);
  binder.bind("hdScheduleAsynchronous", hd.schedule_asynchronous);
  binder.bind("hdUnschedule", hd.unschedule);
  return binder.refusal();
}

}  // namespace

HdapiSearch load_hdapi(const std::string& configured) {
  return search_library<HdapiFunctions>(kLibraryNames, configured, bind_all);
}

}  // namespace afm::haptics
