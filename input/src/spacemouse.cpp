// SPDX-License-Identifier: Apache-2.0
#include "input/spacemouse.h"

#include <algorithm>
#include <glm/common.hpp>

#include "input/wand.h"

namespace afm::input {

namespace {

constexpr double kFullDeflection = 350.0;  // counts at full deflection; some devices reach 500

// Transforms the device's axes (x right, y towards the user, z down) to the room's.
glm::dvec3 in_room(const std::array<std::int16_t, 3>& raw) {
  return glm::clamp(glm::dvec3(raw[0], -raw[2], raw[1]) / kFullDeflection, -1.0, 1.0);
}

class SpaceMouse final : public HidDriver {
 public:
  std::optional<HidInput> read(Bytes report) override {
    const auto parsed = parse_spacemouse(report);
    if (!parsed) return std::nullopt;
    HidInput input;
    if (parsed->translation) input.push = in_room(*parsed->translation);
    if (parsed->rotation) input.turn = in_room(*parsed->rotation);
    if (parsed->buttons) input.buttons = wand_buttons(*parsed->buttons);
    return input;
  }

  bool steered() const override { return true; }

 private:
  static std::uint32_t wand_buttons(std::uint32_t raw) {
    const bool left = (raw & 1U) != 0, right = (raw & 2U) != 0;
    std::uint32_t buttons = 0;
    if (right) buttons |= bit(left ? WandButton::Scale : WandButton::Grab);
    if (left && !right) buttons |= bit(WandButton::Select);
    if ((raw & ~3U) != 0) buttons |= bit(WandButton::Home);
    return buttons;
  }
};

}  // namespace

std::optional<SpaceMouseReport> parse_spacemouse(Bytes report) {
  if (report.empty()) return std::nullopt;
  SpaceMouseReport parsed;
  switch (report[0]) {
    case 1:
      if (report.size() != 7 && report.size() < 13) return std::nullopt;
      parsed.translation = signed16_triple(report, 1);
      if (report.size() > 7) parsed.rotation = signed16_triple(report, 7);
      return parsed;
    case 2:
      if (report.size() != 7) return std::nullopt;
      parsed.rotation = signed16_triple(report, 1);
      return parsed;
    case 3: {
      if (report.size() < 2) return std::nullopt;
      std::uint32_t buttons = 0;
      for (std::size_t i = 1; i < std::min<std::size_t>(report.size(), 5); ++i) {
        buttons |= static_cast<std::uint32_t>(report[i]) << (8 * (i - 1));
      }
      parsed.buttons = buttons;
      return parsed;
    }
    default:
      return std::nullopt;
  }
}

std::unique_ptr<HidDriver> spacemouse_driver() { return std::make_unique<SpaceMouse>(); }

}  // namespace afm::input
