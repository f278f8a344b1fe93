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
  unsigned vendor;                  // USB number of the vendor
  std::optional<unsigned> product;  // USB number of the product; empty: any
  const char* device;
  const char* udev_rule;  // row of assets/haptics/70-touchafm-haptics.rules
};

struct HapticPort {
  std::string path;    // path in /dev
  std::string device;  // name of the device, "Touch"; empty for a serial port of an unknown device
  HapticBus bus = HapticBus::Serial;
  bool accessible = false;  // true: the current user may read and write it
  std::string group;        // group of the file, whose members may open it; empty: unknown, or root
};

// Serial ports (/dev/ttyACM*), and the HID and USB nodes of known devices. Reads /dev and /sys below `root`. Any thread
// that may wait.
std::vector<HapticPort> find_haptic_ports(const std::string& root = "/");

// Message about the rights on these ports, for the first one that cannot be opened.
struct PortRights {
  bool open = true;       // true: all ports can be opened, or there are none
  std::string said;       // description: lower case, no full stop
  std::string group;      // group to join; empty: the udev rule is needed
  std::string udev_rule;  // row of assets/haptics/70-touchafm-haptics.rules
};
PortRights judge_rights(const std::vector<HapticPort>& ports);

}  // namespace afm::haptics
