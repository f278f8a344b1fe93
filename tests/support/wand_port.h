// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <linux/hidraw.h>
#include <umockdev.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hid_guest/virtual_spacemouse.h"

namespace afm::support {

// A computer with ports for HID devices: umockdev shows the devices to libhidapi and to udev's library,
// in this process and in those that it starts. Run by umockdev-wrapper; throws where that does not work.
class WandPort {
 public:
  WandPort() : testbed_(umockdev_testbed_new()), ioctls_(g_object_new(UMOCKDEV_TYPE_IOCTL_BASE, nullptr)) {
    g_signal_connect(ioctls_.get(), "handle-ioctl", G_CALLBACK(answer_ioctl), nullptr);
  }
  WandPort(const WandPort&) = delete;
  WandPort& operator=(const WandPort&) = delete;
  ~WandPort() {
    while (plugged()) unplug();
  }

  // Plugs in a device; `ids`: "256F:0000C635". Each is another node, as if the old one were still held.
  // Whatever its ids, it describes its reports as a SpaceMouse Compact does.
  void plug(const std::string& ids, const std::string& name) {
    ++number_;
    const std::string text = "P: " + device_path() + "\nE: DRIVER=hid-generic\nE: SUBSYSTEM=hid\nE: HID_ID=0003:0000" +
                             ids + "\nE: HID_NAME=" + name +
                             "\nE: HID_PHYS=mock/0\nE: HID_UNIQ=SN0001\n\nP: " + device_path() + "/hidraw/" + node() +
                             "\nN: " + node() + "\nE: DEVNAME=/dev/" + node() +
                             "\nE: SUBSYSTEM=hidraw\nL: device=../../../" + device_name() + "\n\n";
    GError* error = nullptr;
    if (!umockdev_testbed_add_from_string(testbed_.get(), text.c_str(), &error)) throw refusal(error);
    const auto& descriptor = hid_guest::kSpaceMouseDescriptor;
    umockdev_testbed_set_attribute_binary(testbed_.get(), ("/sys" + device_path()).c_str(), "report_descriptor",
                                          const_cast<guint8*>(descriptor.data()), static_cast<gint>(descriptor.size()));
    if (!umockdev_testbed_attach_ioctl(testbed_.get(), ("/dev/" + node()).c_str(),
                                       reinterpret_cast<UMockdevIoctlBase*>(ioctls_.get()), &error)) {
      throw refusal(error);
    }
    const int end = umockdev_testbed_get_dev_fd(testbed_.get(), ("/dev/" + node()).c_str());
    if (end < 0 || ::fcntl(end, F_SETFL, O_NONBLOCK) != 0) {
      throw std::runtime_error("umockdev gives no end of /dev/" + node());
    }
    ends_.push_back({number_, end});
  }

  bool plugged() const { return !ends_.empty(); }

  // Unplugs the device that was plugged in last.
  void unplug() {
    const End last = ends_.back();
    ends_.pop_back();
    ::close(last.descriptor);
    const unsigned newest = std::exchange(number_, last.number);
    umockdev_testbed_remove_device(testbed_.get(), ("/sys" + device_path() + "/hidraw/" + node()).c_str());
    umockdev_testbed_remove_device(testbed_.get(), ("/sys" + device_path()).c_str());
    number_ = newest;
  }

  // Sends an input report of the device plugged in last, or of the one with that index in the order of plugging in.
  // Returns false if it is not read and there is no more room.
  bool send(std::span<const std::uint8_t> report) const { return send(ends_.size() - 1, report); }
  bool send(std::size_t device, std::span<const std::uint8_t> report) const {
    return ::write(ends_.at(device).descriptor, report.data(), report.size()) == static_cast<ssize_t>(report.size());
  }

 private:
  struct End {
    unsigned number;
    int descriptor;
  };
  struct Releaser {
    void operator()(gpointer object) const { g_object_unref(object); }
  };

  static std::runtime_error refusal(GError* error) {
    const std::string message = error->message;
    g_error_free(error);
    return std::runtime_error("umockdev: " + message);
  }

  static gboolean answer_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer) {
    const auto& descriptor = hid_guest::kSpaceMouseDescriptor;
    const auto request = umockdev_ioctl_client_get_request(client);
    UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
    if (request == HIDIOCGRDESCSIZE) {
      int size = static_cast<int>(descriptor.size());
      UMockdevIoctlData* const place = umockdev_ioctl_data_resolve(argument, 0, sizeof size, nullptr);
      umockdev_ioctl_data_update(place, 0, reinterpret_cast<guint8*>(&size), sizeof size);
      g_object_unref(place);
    } else if (request == HIDIOCGRDESC) {
      hidraw_report_descriptor answer{};
      answer.size = static_cast<__u32>(descriptor.size());
      std::memcpy(answer.value, descriptor.data(), descriptor.size());
      UMockdevIoctlData* const place = umockdev_ioctl_data_resolve(argument, 0, sizeof answer, nullptr);
      umockdev_ioctl_data_update(place, 0, reinterpret_cast<guint8*>(&answer), sizeof answer);
      g_object_unref(place);
    } else {
      return FALSE;
    }
    umockdev_ioctl_client_complete(client, 0, 0);
    return TRUE;
  }

  std::string node() const { return "hidraw" + std::to_string(number_); }
  std::string device_name() const {
    char name[32];
    std::snprintf(name, sizeof name, "0003:256F:C635.%04X", number_);
    return name;
  }
  std::string device_path() const { return "/devices/virtual/misc/uhid/" + device_name(); }

  std::unique_ptr<UMockdevTestbed, Releaser> testbed_;
  std::unique_ptr<void, Releaser> ioctls_;
  std::vector<End> ends_;
  unsigned number_ = 0;  // number of the device, in the order of plugging in
};

}  // namespace afm::support
