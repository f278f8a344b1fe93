// SPDX-License-Identifier: Apache-2.0
#include "input/hid_catalog.h"

#include <array>

#include "input/dualsense.h"
#include "input/joycon.h"
#include "input/psmove.h"
#include "input/spacemouse.h"
#include "input/wiimote.h"

namespace afm::input {

namespace {

enum class Family { SpaceMouse, NoWand, Wiimote, PsMove1, PsMove2, DualSense, JoyConLeft, JoyConRight, SwitchPro };

struct Entry {
  std::uint16_t vendor;
  std::uint16_t product;
  Family family;
  const char* name;
};

// 3Dconnexion's as in FreeSpacenav's spacenavd, src/dev.c, with its deny-list; the others from Linux' drivers.
constexpr std::array kEntries{
    Entry{0x046d, 0xc603, Family::SpaceMouse, "SpaceMouse Plus XT"},
    Entry{0x046d, 0xc605, Family::SpaceMouse, "CADman"},
    Entry{0x046d, 0xc606, Family::SpaceMouse, "SpaceMouse Classic"},
    Entry{0x046d, 0xc621, Family::SpaceMouse, "SpaceBall 5000"},
    Entry{0x046d, 0xc623, Family::SpaceMouse, "SpaceTraveler"},
    Entry{0x046d, 0xc625, Family::SpaceMouse, "SpacePilot"},
    Entry{0x046d, 0xc626, Family::SpaceMouse, "SpaceNavigator"},
    Entry{0x046d, 0xc627, Family::SpaceMouse, "SpaceExplorer"},
    Entry{0x046d, 0xc628, Family::SpaceMouse, "SpaceNavigator for Notebooks"},
    Entry{0x046d, 0xc629, Family::SpaceMouse, "SpacePilot Pro"},
    Entry{0x046d, 0xc62b, Family::SpaceMouse, "SpaceMouse Pro"},
    Entry{0x256f, 0xc62e, Family::SpaceMouse, "SpaceMouse Wireless (cable)"},
    Entry{0x256f, 0xc62f, Family::SpaceMouse, "SpaceMouse Wireless"},
    Entry{0x256f, 0xc631, Family::SpaceMouse, "SpaceMouse Pro Wireless (cable)"},
    Entry{0x256f, 0xc632, Family::SpaceMouse, "SpaceMouse Pro Wireless"},
    Entry{0x256f, 0xc633, Family::SpaceMouse, "SpaceMouse Enterprise"},
    Entry{0x256f, 0xc635, Family::SpaceMouse, "SpaceMouse Compact"},
    Entry{0x256f, 0xc636, Family::SpaceMouse, "SpaceMouse Module"},
    Entry{0x256f, 0xc638, Family::SpaceMouse, "SpaceMouse Pro Wireless"},
    Entry{0x256f, 0xc63a, Family::SpaceMouse, "SpaceMouse Wireless"},
    Entry{0x256f, 0xc652, Family::SpaceMouse, "3Dconnexion Universal Receiver"},
    Entry{0x256f, 0xc650, Family::NoWand, "CadMouse"},
    Entry{0x256f, 0xc651, Family::NoWand, "CadMouse Wireless"},
    Entry{0x256f, 0xc653, Family::NoWand, "CadMouse"},
    Entry{0x256f, 0xc654, Family::NoWand, "CadMouse Pro Wireless"},
    Entry{0x256f, 0xc655, Family::NoWand, "CadMouse Compact"},
    Entry{0x256f, 0xc656, Family::NoWand, "CadMouse Pro"},
    Entry{0x256f, 0xc657, Family::NoWand, "CadMouse Pro Wireless Left"},
    Entry{0x256f, 0xc658, Family::NoWand, "CadMouse Compact Wireless"},
    Entry{0x256f, 0xc664, Family::NoWand, "3Dconnexion Numpad"},
    Entry{0x256f, 0xc665, Family::NoWand, "3Dconnexion Numpad"},
    Entry{0x256f, 0xc668, Family::NoWand, "3Dconnexion Keyboard"},
    Entry{0x057e, 0x0306, Family::Wiimote, "Wii Remote"},
    Entry{0x057e, 0x0330, Family::Wiimote, "Wii Remote Plus"},
    Entry{0x057e, 0x2006, Family::JoyConLeft, "Joy-Con (left)"},
    Entry{0x057e, 0x2007, Family::JoyConRight, "Joy-Con (right)"},
    Entry{0x057e, 0x2009, Family::SwitchPro, "Switch Pro Controller"},
    Entry{0x054c, 0x03d5, Family::PsMove1, "PS Move"},
    Entry{0x054c, 0x0c5e, Family::PsMove2, "PS Move (ZCM2)"},
    Entry{0x054c, 0x0ce6, Family::DualSense, "DualSense"},
    Entry{0x054c, 0x0df2, Family::DualSense, "DualSense Edge"},
};

std::function<std::unique_ptr<HidDriver>()> maker(Family family) {
  switch (family) {
    case Family::SpaceMouse:
      return spacemouse_driver;
    case Family::Wiimote:
      return wiimote_driver;
    case Family::PsMove1:
      return [] { return psmove_driver(PsMoveModel::Zcm1); };
    case Family::PsMove2:
      return [] { return psmove_driver(PsMoveModel::Zcm2); };
    case Family::DualSense:
      return dualsense_driver;
    case Family::JoyConLeft:
      return [] { return joycon_driver(JoyConSide::Left); };
    case Family::JoyConRight:
      return [] { return joycon_driver(JoyConSide::Right); };
    case Family::SwitchPro:
      return [] { return joycon_driver(JoyConSide::Pro); };
    case Family::NoWand:
      break;
  }
  return nullptr;
}

constexpr std::uint16_t k3Dconnexion = 0x256f;
constexpr std::uint16_t kGenericDesktop = 1;
constexpr std::uint16_t kMultiAxisController = 8;

// A receiver shows itself as a keyboard and a mouse too.
bool beside_the_cap(const HidIdentity& device) {
  return device.vendor == k3Dconnexion && device.usage_page != 0 &&
         !(device.usage_page == kGenericDesktop && device.usage == kMultiAxisController);
}

}  // namespace

std::optional<KnownHid> identify(const HidIdentity& device, std::span<const HidMapping> mappings) {
  for (const HidMapping& mapping : mappings) {
    if (mapping.vendor != device.vendor || mapping.product != device.product) continue;
    return KnownHid{.name = mapping.name, .make = [mapping] { return mapped_driver(mapping); }};
  }
  for (const Entry& entry : kEntries) {
    if (entry.vendor != device.vendor || entry.product != device.product) continue;
    if (entry.family == Family::SpaceMouse && beside_the_cap(device)) {
      return KnownHid{.name = std::string(entry.name) + ", another interface", .make = nullptr};
    }
    return KnownHid{.name = entry.name, .make = maker(entry.family)};
  }
  // what 3Dconnexion builds next
  if (device.vendor == k3Dconnexion && device.usage_page == kGenericDesktop && device.usage == kMultiAxisController) {
    return KnownHid{.name = "SpaceMouse", .make = spacemouse_driver};
  }
  return std::nullopt;
}

}  // namespace afm::input
