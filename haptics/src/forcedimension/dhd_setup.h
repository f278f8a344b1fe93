// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "forcedimension/dhd_library.h"
#include "haptics/device.h"

// Set-up before the driver's thread starts. Any thread that may wait.
namespace afm::haptics::dhd {

// Text of an error with the library's wording: "timeout (error 7)".
std::string error_text(const DhdFunctions& functions, int error);

// Opens the device that `wanted` names: a serial number, "#0" for the first device, "#1" for the second; empty: the
// first that can be opened. DeviceMissing: none; the message has the library's reasons. WrongUsage: `wanted` is
// neither.
core::Result<DhdId> take_device(const DhdFunctions& functions, const std::string& wanted);

// Profile of the open device: its name and serial number, the force and reach of its model.
core::Result<DeviceSpec> query_spec(const DhdFunctions& functions, DhdId device);

// Profile of a model by its type; an unknown type gets the weakest and smallest of all. `name` may be empty.
DeviceSpec model_spec(int type, const std::string& name);

}  // namespace afm::haptics::dhd
