// SPDX-License-Identifier: Apache-2.0
#include "haptics/haptic_ports.h"

#include <fmt/core.h>
#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "haptics/device_registry.h"

namespace afm::haptics {

namespace {

namespace fs = std::filesystem;

struct UsbNumbers {
  unsigned vendor = 0;
  unsigned product = 0;
};

// First port of any kind of device for which `is_it` is true; null if there is none.
template <class Predicate>
const KnownPort* find_port(const Predicate& is_it) {
  for (const DeviceKind& kind : device_kinds()) {
    const auto found = std::find_if(kind.ports.begin(), kind.ports.end(), is_it);
    if (found != kind.ports.end()) return &*found;
  }
  return nullptr;
}

const KnownPort* find_known(HapticBus bus, const UsbNumbers& numbers) {
  return find_port([&](const KnownPort& known) {
    return known.bus == bus && known.vendor == numbers.vendor &&
           known.product.value_or(numbers.product) == numbers.product;
  });
}

std::string first_line(const fs::path& file) {
  std::string line;
  std::ifstream stream(file);
  std::getline(stream, line);
  return line;
}

// Number in a text; 0 for anything else.
unsigned number(std::string_view text, int base) {
  unsigned value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, base);
  return value;
}

UsbNumbers usb_numbers(const fs::path& device) {
  return {number(first_line(device / "idVendor"), 16), number(first_line(device / "idProduct"), 16)};
}

// USB numbers from a line of the HID core, HID_ID=0003:00002988:00000304.
UsbNumbers hid_numbers(const fs::path& uevent) {
  constexpr std::string_view kKey = "HID_ID=";
  std::ifstream stream(uevent);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(kKey)) continue;
    const std::size_t vendor = line.find(':');
    const std::size_t product = vendor == std::string::npos ? vendor : line.find(':', vendor + 1);
    if (product == std::string::npos) return {};
    return {number(std::string_view(line).substr(vendor + 1, product - vendor - 1), 16),
            number(std::string_view(line).substr(product + 1), 16)};
  }
  return {};
}

std::string group_of(const fs::path& file) {
  struct stat status{};
  if (::stat(file.c_str(), &status) != 0 || status.st_gid == 0) return {};
  std::array<char, 4096> buffer{};
  group entry{};
  group* found = nullptr;
  ::getgrgid_r(status.st_gid, &entry, buffer.data(), buffer.size(), &found);
  return found == nullptr ? std::string() : std::string(found->gr_name);
}

// Names in a folder that begin with `prefix`, sorted; none if there is no such folder.
std::vector<std::string> names_in(const fs::path& folder, std::string_view prefix) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    std::string name = entry.path().filename().string();
    if (name.starts_with(prefix)) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

HapticPort port_at(const fs::path& root, const std::string& path, HapticBus bus, const KnownPort* known) {
  const fs::path file = root / path.substr(1);
  return {.path = path,
          .device = known == nullptr ? "" : known->device,
          .bus = bus,
          .accessible = ::access(file.c_str(), R_OK | W_OK) == 0,
          .group = group_of(file)};
}

// Text of a port: "/dev/hidraw3 (Touch, a HID device)".
std::string text_of(const HapticPort& port) {
  if (port.device.empty()) return port.path;
  return fmt::format("{} ({}{})", port.path, port.device, port.bus == HapticBus::Hid ? ", a HID device" : "");
}

}  // namespace

std::vector<HapticPort> find_haptic_ports(const std::string& root) {
  const fs::path top(root);
  std::vector<HapticPort> ports;
  for (const std::string& name : names_in(top / "dev", "ttyACM")) {
    std::error_code none;
    // the tty's device is an interface of the USB device
    const fs::path interface = fs::canonical(top / "sys/class/tty" / name / "device", none);
    const KnownPort* known = none ? nullptr : find_known(HapticBus::Serial, usb_numbers(interface.parent_path()));
    ports.push_back(port_at(top, "/dev/" + name, HapticBus::Serial, known));
  }
  for (const std::string& name : names_in(top / "sys/class/hidraw", "hidraw")) {
    const KnownPort* known = find_known(HapticBus::Hid, hid_numbers(top / "sys/class/hidraw" / name / "device/uevent"));
    if (known != nullptr) ports.push_back(port_at(top, "/dev/" + name, HapticBus::Hid, known));
  }
  for (const std::string& name : names_in(top / "sys/bus/usb/devices", "")) {
    const fs::path device = top / "sys/bus/usb/devices" / name;
    const KnownPort* known = find_known(HapticBus::Usb, usb_numbers(device));
    if (known == nullptr) continue;
    const std::string path = fmt::format("/dev/bus/usb/{:03}/{:03}", number(first_line(device / "busnum"), 10),
                                         number(first_line(device / "devnum"), 10));
    ports.push_back(port_at(top, path, HapticBus::Usb, known));
  }
  return ports;
}

PortRights judge_rights(const std::vector<HapticPort>& ports) {
  if (ports.empty()) return {.open = true, .said = "no haptic device is plugged in", .group = {}, .udev_rule = {}};
  const auto closed = std::find_if(ports.begin(), ports.end(), [](const HapticPort& port) { return !port.accessible; });
  if (closed != ports.end()) {
    const KnownPort* known =
        find_port([&](const KnownPort& one) { return one.bus == closed->bus && closed->device == one.device; });
    // an unknown serial port has no row
    if (known == nullptr) known = find_port([](const KnownPort& one) { return one.bus == HapticBus::Serial; });
    return {.open = false,
            .said = text_of(*closed) + " cannot be opened",
            .group = closed->bus == HapticBus::Serial ? closed->group : std::string(),
            .udev_rule = known == nullptr ? "" : known->udev_rule};
  }
  std::string said;
  for (const HapticPort& port : ports) said += (said.empty() ? "" : ", ") + text_of(port);
  return {.open = true, .said = said + " can be opened", .group = {}, .udev_rule = {}};
}

}  // namespace afm::haptics
