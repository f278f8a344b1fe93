// SPDX-License-Identifier: Apache-2.0
#include "app/haptic_choice.h"

#include <cstdlib>
#include <string>

namespace afm::app {

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

}  // namespace

haptics::ProbeSettings probe_settings() {
  return {.hd_library = variable(haptics::kHdLibraryVariable), .hd_device = variable(haptics::kHdDeviceVariable)};
}

}  // namespace afm::app
