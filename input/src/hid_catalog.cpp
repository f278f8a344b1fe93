// SPDX-License-Identifier: Apache-2.0
#include "input/hid_catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "input/dualsense.h"
#include "input/joycon.h"
#include "input/psmove.h"
#include "input/spacemouse.h"
#include "input/wiimote.h"

namespace afm::input {

namespace {

// 3Dconnexion's devices from FreeSpacenav's spacenavd, src/dev.c, with its deny-list; the others from Linux' drivers.
constexpr std::array kModels{
    HidModel{0x046d, 0xc603, "SpaceMouse Plus XT", spacemouse_driver},
    HidModel{0x046d, 0xc605, "CADman", spacemouse_driver},
    HidModel{0x046d, 0xc606, "SpaceMouse Classic", spacemouse_driver},
    HidModel{0x046d, 0xc621, "SpaceBall 5000", spacemouse_driver},
    HidModel{0x046d, 0xc623, "SpaceTraveler", spacemouse_driver},
    HidModel{0x046d, 0xc625, "SpacePilot", spacemouse_driver},
    HidModel{0x046d, 0xc626, "SpaceNavigator", spacemouse_driver},
    HidModel{0x046d, 0xc627, "SpaceExplorer", spacemouse_driver},
    HidModel{0x046d, 0xc628, "SpaceNavigator for Notebooks", spacemouse_driver},
    HidModel{0x046d, 0xc629, "SpacePilot Pro", spacemouse_driver},
    HidModel{0x046d, 0xc62b, "SpaceMouse Pro", spacemouse_driver},
    HidModel{0x256f, 0xc62e, "SpaceMouse Wireless (cable)", spacemouse_driver},
    HidModel{0x256f, 0xc62f, "SpaceMouse Wireless", spacemouse_driver},
    HidModel{0x256f, 0xc631, "SpaceMouse Pro Wireless (cable)", spacemouse_driver},
    HidModel{0x256f, 0xc632, "SpaceMouse Pro Wireless", spacemouse_driver},
    HidModel{0x256f, 0xc633, "SpaceMouse Enterprise", spacemouse_driver},
    HidModel{0x256f, 0xc635, "SpaceMouse Compact", spacemouse_driver},
    HidModel{0x256f, 0xc636, "SpaceMouse Module", spacemouse_driver},
    HidModel{0x256f, 0xc638, "SpaceMouse Pro Wireless", spacemouse_driver},
    HidModel{0x256f, 0xc63a, "SpaceMouse Wireless", spacemouse_driver},
    HidModel{0x256f, 0xc652, "3Dconnexion Universal Receiver", spacemouse_driver},
    HidModel{0x256f, 0xc650, "CadMouse", nullptr},
    HidModel{0x256f, 0xc651, "CadMouse Wireless", nullptr},
    HidModel{0x256f, 0xc653, "CadMouse", nullptr},
    HidModel{0x256f, 0xc654, "CadMouse Pro Wireless", nullptr},
    HidModel{0x256f, 0xc655, "CadMouse Compact", nullptr},
    HidModel{0x256f, 0xc656, "CadMouse Pro", nullptr},
    HidModel{0x256f, 0xc657, "CadMouse Pro Wireless Left", nullptr},
    HidModel{0x256f, 0xc658, "CadMouse Compact Wireless", nullptr},
    HidModel{0x256f, 0xc664, "3Dconnexion Numpad", nullptr},
    HidModel{0x256f, 0xc665, "3Dconnexion Numpad", nullptr},
    HidModel{0x256f, 0xc668, "3Dconnexion Keyboard", nullptr},
    HidModel{0x057e, 0x0306, "Wii Remote", wiimote_driver},
    HidModel{0x057e, 0x0330, "Wii Remote Plus", wiimote_driver},
    HidModel{0x057e, 0x2006, "Joy-Con (left)", [] { return joycon_driver(JoyConSide::Left); }},
    HidModel{0x057e, 0x2007, "Joy-Con (right)", [] { return joycon_driver(JoyConSide::Right); }},
    HidModel{0x057e, 0x2009, "Switch Pro Controller", [] { return joycon_driver(JoyConSide::Pro); }},
    HidModel{0x054c, 0x03d5, "PS Move", [] { return psmove_driver(PsMoveModel::Zcm1); }},
    HidModel{0x054c, 0x0c5e, "PS Move (ZCM2)", [] { return psmove_driver(PsMoveModel::Zcm2); }},
    HidModel{0x054c, 0x0ce6, "DualSense", dualsense_driver},
    HidModel{0x054c, 0x0df2, "DualSense Edge", dualsense_driver},
};

constexpr std::uint16_t k3Dconnexion = 0x256f;
constexpr std::uint16_t kGenericDesktop = 1;
constexpr std::uint16_t kMultiAxisController = 8;

// True for the keyboard or mouse interface of a receiver.
bool beside_the_cap(const HidIdentity& device) {
  return device.vendor == k3Dconnexion && device.usage_page != 0 &&
         !(device.usage_page == kGenericDesktop && device.usage == kMultiAxisController);
}

}  // namespace

std::span<const HidModel> hid_models() { return kModels; }

std::optional<KnownHid> identify(const HidIdentity& device, std::span<const HidMapping> mappings) {
  for (const HidMapping& mapping : mappings) {
    if (mapping.vendor != device.vendor || mapping.product != device.product) continue;
    const bool only_stops =
        mapping.axes.empty() && std::all_of(mapping.buttons.begin(), mapping.buttons.end(),
                                            [](const auto& b) { return b.button == WandButton::Stop; });
    return KnownHid{
        .name = mapping.name, .make = [mapping] { return mapped_driver(mapping); }, .only_stops = only_stops};
  }
  for (const HidModel& model : kModels) {
    if (model.vendor != device.vendor || model.product != device.product) continue;
    if (model.make != nullptr && beside_the_cap(device)) {
      return KnownHid{.name = fmt::format("{}, another interface", model.name), .make = nullptr};
    }
    return KnownHid{.name = std::string(model.name), .make = model.make};
  }
  // future 3Dconnexion devices
  if (device.vendor == k3Dconnexion && device.usage_page == kGenericDesktop && device.usage == kMultiAxisController) {
    return KnownHid{.name = "SpaceMouse", .make = spacemouse_driver};
  }
  return std::nullopt;
}

}  // namespace afm::input
