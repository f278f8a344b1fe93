// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

// Ports of this computer with haptic devices, found without any driver.
namespace afm::haptics {

enum class HapticBus { Serial, Hid, Usb };

// Port of a known device: a row of its kind (DeviceKind::ports).
struct KnownPort {
  HapticBus bus;
  unsigned vendor;                  // vendor's USB number
  std::optional<unsigned> product;  // any if empty
  const char* device;
  const char* udev_rule;  // row of assets/haptics/70-touchafm-haptics.rules
};

struct HapticPort {
  std::string path;    // in /dev
  std::string device;  // "Touch"; empty for a serial port of an unknown device
  HapticBus bus = HapticBus::Serial;
  bool accessible = false;  // read and write access of the current user
  std::string group;        // the file's, whose members may open it; empty: unknown, or root's
};

// Serial ports (/dev/ttyACM*), and the HID and USB nodes of known devices. Reads /dev and /sys below `root`. Any thread
// that may wait.
std::vector<HapticPort> find_haptic_ports(const std::string& root = "/");

// Message about the rights on these ports, for the first one that cannot be opened.
struct PortRights {
  bool open = true;       // all can be opened, or there are none
  std::string said;       // lower case, no full stop
  std::string group;      // to join; empty: the rule is needed
  std::string udev_rule;  // row of assets/haptics/70-touchafm-haptics.rules
};
PortRights judge_rights(const std::vector<HapticPort>& ports);

}  // namespace afm::haptics
