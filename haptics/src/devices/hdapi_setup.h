// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "devices/hdapi_library.h"
#include "haptics/device.h"

// Set-up before the scheduler starts. Any thread that may wait.
namespace afm::haptics::hdapi {

// The newest error, after which the stack of errors is empty. Code 0: there was none.
HdapiError take_newest_error(const HdapiFunctions& hd);

// "warm motors (0x0200)", in the library's words.
std::string error_text(const HdapiFunctions& hd, std::uint32_t code);

// Makes the device of this name the current one; an empty name tries the three defaults. A device that another program
// is just leaving is asked for again, at most ten times.
core::Result<HdapiHandle> take_device(const HdapiFunctions& hd, const std::string& name);

// Model, limits and workspace of the current device. Fails if they cannot be.
core::Result<DeviceSpec> query_spec(const HdapiFunctions& hd);

// The style to calibrate in: by itself where the device can, in the inkwell otherwise.
std::uint32_t calibration_style(const HdapiFunctions& hd);

}  // namespace afm::haptics::hdapi
