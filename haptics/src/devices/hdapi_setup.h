// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "devices/hdapi_library.h"
#include "haptics/device.h"

// Set-up before the scheduler starts. Any thread that may wait.
namespace afm::haptics::hdapi {

// Returns the newest error and empties the error stack. Code 0: there was none.
HdapiError take_newest_error(const HdapiFunctions& hd);

// "warm motors (0x0200)", with the library's text.
std::string error_text(const HdapiFunctions& hd, std::uint32_t code);

// Makes the device of this name the current one; an empty name tries the three defaults. Retries at most ten times
// while another program is releasing the device.
core::Result<HdapiHandle> take_device(const HdapiFunctions& hd, const std::string& name);

// Model, limits and workspace of the current device. Fails if they are impossible.
core::Result<DeviceSpec> query_spec(const HdapiFunctions& hd);

// Calibration style: automatic if the device supports it, otherwise by the inkwell.
std::uint32_t calibration_style(const HdapiFunctions& hd);

}  // namespace afm::haptics::hdapi
