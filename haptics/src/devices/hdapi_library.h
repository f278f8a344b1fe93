// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "drivers/vendor_library.h"

// Vendor's library of the PHANTOM Omni and Touch ("HDAPI"), installed by the lab and loaded at run time. Names, types
// and numbers are our own, based only on the facts of the interface (x86-64 SysV, plain C): no header, binary or text
// of the vendor is used, and none may enter this tree.
namespace afm::haptics {

using HdapiHandle = std::uint32_t;           // handle of a device
using HdapiSchedulerHandle = unsigned long;  // handle of a scheduled callback
using HdapiCallback = std::uint32_t (*)(void*);

// Newest entry of the library's error stack. Returned by value in two registers.
struct HdapiError {
  std::uint32_t code = 0;  // 0: the stack is empty
  std::int32_t internal_code = 0;
  HdapiHandle device = 0;
};
static_assert(sizeof(HdapiError) == 12);

// Functions of the library used by TouchAFM. Position and force belong to the scheduler's thread, between begin_frame()
// and end_frame(); properties may be read from any thread.
struct HdapiFunctions {
  HdapiHandle (*init_device)(const char* name) = nullptr;  // `name` null: the default device
  void (*disable_device)(HdapiHandle device) = nullptr;
  void (*make_current_device)(HdapiHandle device) = nullptr;
  void (*begin_frame)(HdapiHandle device) = nullptr;
  void (*end_frame)(HdapiHandle device) = nullptr;
  HdapiError (*get_error)() = nullptr;
  const char* (*get_error_string)(std::uint32_t code) = nullptr;
  void (*enable)(std::uint32_t capability) = nullptr;
  void (*disable)(std::uint32_t capability) = nullptr;
  void (*get_integers)(std::uint32_t property, std::int32_t* values) = nullptr;
  void (*get_doubles)(std::uint32_t property, double* values) = nullptr;
  void (*set_doubles)(std::uint32_t property, const double* values) = nullptr;
  const char* (*get_string)(std::uint32_t property) = nullptr;
  std::uint32_t (*check_calibration)() = nullptr;
  void (*update_calibration)(std::uint32_t style) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  void (*set_scheduler_rate)(unsigned long hz) = nullptr;
  HdapiSchedulerHandle (*schedule_asynchronous)(HdapiCallback, void* context, std::uint16_t priority) = nullptr;
  void (*unschedule)(HdapiSchedulerHandle callback) = nullptr;
};

using HdapiSearch = LibrarySearch<HdapiFunctions>;

// Loads only `configured` if it is not empty; otherwise the first of libHD.so.3.4, libHD.so.3.0 and libHD.so that can
// be loaded and has every function of HdapiFunctions. Libraries stay loaded for the lifetime of the process: the driver
// does not survive unloading and reloading (CHAI3D, CPhantomDevices). Any thread, not a servo tick.
HdapiSearch load_hdapi(const std::string& configured);

}  // namespace afm::haptics
