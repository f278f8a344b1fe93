// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <linux/uhid.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/file_descriptor.h"

namespace afm::hid_guest {

// The report descriptor of a SpaceMouse Compact: reports 1 (translation) and 2 (rotation) of three signed 16-bit
// numbers each, report 3 of two buttons.
inline constexpr std::array<std::uint8_t, 82> kSpaceMouseDescriptor{
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01,                                            // desktop, multi-axis controller
    0xA1, 0x00, 0x85, 0x01, 0x16, 0xA2, 0xFE, 0x26, 0x5E, 0x01, 0x36, 0xA2, 0xFE,  // -350 to 350
    0x46, 0x5E, 0x01, 0x09, 0x30, 0x09, 0x31, 0x09, 0x32, 0x75, 0x10, 0x95, 0x03, 0x81, 0x06, 0xC0,  //
    0xA1, 0x00, 0x85, 0x02, 0x09, 0x33, 0x09, 0x34, 0x09, 0x35, 0x75, 0x10, 0x95, 0x03, 0x81, 0x06,
    0xC0, 0xA1, 0x02, 0x85, 0x03, 0x05, 0x09, 0x19, 0x01, 0x29, 0x02, 0x15, 0x00, 0x25, 0x01, 0x35,
    0x00, 0x45, 0x01, 0x75, 0x01, 0x95, 0x02, 0x81, 0x02, 0x95, 0x0E, 0x81, 0x03, 0xC0, 0xC0};

// A cap that the kernel treats as plugged in during the object's lifetime (drivers/hid/uhid.c).
class VirtualSpaceMouse {
 public:
  VirtualSpaceMouse(std::uint32_t vendor, std::uint32_t product, const std::string& name)
      : uhid_(::open("/dev/uhid", O_RDWR | O_CLOEXEC)) {
    if (!uhid_.is_open()) throw std::runtime_error("no /dev/uhid: is the module loaded?");
    uhid_event event{};
    event.type = UHID_CREATE2;
    auto& create = event.u.create2;
    std::memcpy(create.name, name.c_str(), std::min(name.size() + 1, sizeof create.name));
    std::memcpy(create.rd_data, kSpaceMouseDescriptor.data(), kSpaceMouseDescriptor.size());
    create.rd_size = static_cast<std::uint16_t>(kSpaceMouseDescriptor.size());
    create.bus = 3;  // bus number of USB
    create.vendor = vendor;
    create.product = product;
    send(event);
  }
  VirtualSpaceMouse(const VirtualSpaceMouse&) = delete;
  VirtualSpaceMouse& operator=(const VirtualSpaceMouse&) = delete;

  void push(int x, int y, int z) const { report(1, {x, y, z}); }

  void press(unsigned buttons) const { input({3, static_cast<std::uint8_t>(buttons), 0}); }

 private:
  void report(std::uint8_t number, const std::array<int, 3>& axes) const {
    std::vector<std::uint8_t> bytes{number};
    for (const int value : axes) {
      bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
      bytes.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
    }
    input(bytes);
  }

  void input(const std::vector<std::uint8_t>& bytes) const {
    uhid_event event{};
    event.type = UHID_INPUT2;
    event.u.input2.size = static_cast<std::uint16_t>(bytes.size());
    std::memcpy(event.u.input2.data, bytes.data(), bytes.size());
    send(event);
  }

  void send(const uhid_event& event) const {
    if (::write(uhid_.get(), &event, sizeof event) != static_cast<ssize_t>(sizeof event)) {
      throw std::runtime_error("the kernel refused an event of the virtual device");
    }
  }

  core::FileDescriptor uhid_;
};

}  // namespace afm::hid_guest
