// SPDX-License-Identifier: Apache-2.0
#include "haptics/haptic_ports.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "haptics/device_registry.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace haptic_ports_test {

using namespace afm::haptics;
using testing::HasSubstr;
using testing::SizeIs;
namespace fs = std::filesystem;

// /dev and /sys of a computer of our own.
class Computer {
 public:
  std::vector<HapticPort> ports() const { return find_haptic_ports(folder_.path()); }

  void write(const std::string& file, std::string_view text) const {
    fs::create_directories(fs::path(folder_.file(file)).parent_path());
    folder_.write(file, text);
  }
  void add_usb(const std::string& at, const char* vendor, const char* product, int number) const {
    const std::string device = "sys/devices/" + at;
    write(device + "/idVendor", std::string(vendor) + "\n");
    write(device + "/idProduct", std::string(product) + "\n");
    write(device + "/busnum", "1\n");
    write(device + "/devnum", std::to_string(number) + "\n");
    fs::create_directories(folder_.file("sys/bus/usb/devices"));
    fs::create_directory_symlink(folder_.file(device), folder_.file("sys/bus/usb/devices/" + at));
  }
  void add_serial(const std::string& name, const std::string& usb) const {
    fs::create_directories(folder_.file("sys/devices/" + usb + "/interface"));
    fs::create_directories(folder_.file("sys/class/tty/" + name));
    fs::create_directory_symlink(folder_.file("sys/devices/" + usb + "/interface"),
                                 folder_.file("sys/class/tty/" + name + "/device"));
    write("dev/" + name, "");
  }
  void add_hid(const std::string& name, const std::string& id) const {
    write("sys/class/hidraw/" + name + "/device/uevent", "DRIVER=hid-generic\nHID_ID=" + id + "\nHID_NAME=x\n");
    write("dev/" + name, "");
  }

 private:
  afm::support::ScratchFolder folder_;
};

TEST(HapticPorts, AreNoneOnAComputerWithoutADevice) {
  const Computer computer;
  EXPECT_THAT(computer.ports(), SizeIs(0));
  computer.add_hid("hidraw0", "0003:0000046D:0000C626");
  computer.add_usb("1-2", "0403", "6001", 4);
  EXPECT_THAT(computer.ports(), SizeIs(0));
  const PortRights none = judge_rights(computer.ports());
  EXPECT_TRUE(none.open);
  EXPECT_EQ(none.said, "no haptic device is plugged in");
}

TEST(HapticPorts, FindATouchThatIsAHidDevice) {
  const Computer computer;
  computer.add_hid("hidraw0", "0003:0000046D:0000C626");
  computer.add_hid("hidraw1", "0003:00002988:00000304");
  const auto ports = computer.ports();
  ASSERT_THAT(ports, SizeIs(1));
  EXPECT_EQ(ports[0].path, "/dev/hidraw1");
  EXPECT_EQ(ports[0].bus, HapticBus::Hid);
  EXPECT_TRUE(ports[0].accessible);
  EXPECT_EQ(judge_rights(ports).said, "/dev/hidraw1 (Touch, a HID device) can be opened");
}

TEST(HapticPorts, FindATouchWithASerialPortAndTheDevicesOfOtherMakers) {
  const Computer computer;
  computer.add_usb("1-1", "2988", "0302", 3);
  computer.add_serial("ttyACM0", "1-1");
  computer.add_usb("1-2", "2341", "0043", 4);
  computer.add_serial("ttyACM1", "1-2");
  computer.add_usb("1-3", "1451", "0402", 7);
  computer.write("dev/bus/usb/001/007", "");
  computer.add_usb("1-4", "0403", "cb48", 12);
  computer.write("dev/bus/usb/001/012", "");
  const auto ports = computer.ports();
  ASSERT_THAT(ports, SizeIs(4));
  EXPECT_EQ(judge_rights(ports).said,
            "/dev/ttyACM0 (Touch), /dev/ttyACM1, /dev/bus/usb/001/007 (Force Dimension device), /dev/bus/usb/001/012 "
            "(Novint Falcon) can be opened");
}

// The group is the file's own: dialout on Debian and Fedora, uucp on Arch.
TEST(HapticPorts, NameTheGroupOrTheRuleThatIsMissing) {
  HapticPort serial{
      .path = "/dev/ttyACM0", .device = "Touch", .bus = HapticBus::Serial, .accessible = false, .group = "uucp"};
  const HapticPort open{
      .path = "/dev/hidraw1", .device = "Touch", .bus = HapticBus::Hid, .accessible = true, .group = ""};
  PortRights rights = judge_rights({open, serial});
  EXPECT_FALSE(rights.open);
  EXPECT_EQ(rights.said, "/dev/ttyACM0 (Touch) cannot be opened");
  EXPECT_EQ(rights.group, "uucp");

  HapticPort hid = open;
  hid.accessible = false;
  hid.group = "input";
  rights = judge_rights({hid});
  EXPECT_EQ(rights.said, "/dev/hidraw1 (Touch, a HID device) cannot be opened");
  EXPECT_EQ(rights.group, "");
  EXPECT_THAT(rights.udev_rule, HasSubstr("hidraw"));
}

TEST(HapticPorts, HaveTheirRowInTheUdevRules) {
  std::ifstream file(afm::support::source("assets/haptics/70-touchafm-haptics.rules"));
  const std::string rules{std::istreambuf_iterator<char>(file), {}};
  const auto expect_rule = [&](HapticBus bus, const std::string& device) {
    const auto rights =
        judge_rights({{.path = "/dev/x", .device = device, .bus = bus, .accessible = false, .group = ""}});
    EXPECT_THAT(rules, HasSubstr("\n" + rights.udev_rule + "\n")) << device;
  };
  std::size_t ports = 0;
  for (const DeviceKind& kind : device_kinds()) {
    for (const KnownPort& port : kind.ports) {
      expect_rule(port.bus, port.device);
      EXPECT_THAT(rules, HasSubstr(std::string("\n") + port.udev_rule + "\n")) << port.device;
      ++ports;
    }
  }
  EXPECT_GE(ports, 5U);
  expect_rule(HapticBus::Serial, "");  // port of an unknown device
}

}  // namespace haptic_ports_test
