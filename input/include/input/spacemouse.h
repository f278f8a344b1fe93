// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "input/hid_report.h"

namespace afm::input {

// Report of a 3Dconnexion cap. Report 1 contains the translation and report 2 the rotation, or report 1 all six
// (wireless models); report 3 contains the buttons. Raw axes of the device: x right, y towards the user, z down, about
// +-350 at the stop. Source: FreeSpacenav's spacenavd, src/dev.c.
struct SpaceMouseReport {
  std::optional<std::array<std::int16_t, 3>> translation;
  std::optional<std::array<std::int16_t, 3>> rotation;
  std::optional<std::uint32_t> buttons;
};

std::optional<SpaceMouseReport> parse_spacemouse(Bytes report);

// Left button: Select. Right button: Grab; together with the left one: Scale. Any further button: Home.
std::unique_ptr<HidDriver> spacemouse_driver();

}  // namespace afm::input
