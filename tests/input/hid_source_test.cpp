// SPDX-License-Identifier: Apache-2.0
// The real libhidapi, udev's library and all, on devices that umockdev pretends to have. Run by umockdev-wrapper.
#include "input/hid_source.h"

#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <umockdev.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <memory>
#include <string>

#include "hid_guest/virtual_spacemouse.h"

namespace afm::input {
namespace {

constexpr const char* kCompact = "256F:0000C635";
constexpr const char* kCadMouse = "256F:0000C650";

struct Releaser {
  void operator()(gpointer object) const { g_object_unref(object); }
};

gboolean answer_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer) {
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

// A computer into which a device can be plugged.
class HidSourceTest : public ::testing::Test {
 protected:
  HidSourceTest() : testbed_(umockdev_testbed_new()), ioctls_(g_object_new(UMOCKDEV_TYPE_IOCTL_BASE, nullptr)) {
    g_signal_connect(ioctls_.get(), "handle-ioctl", G_CALLBACK(answer_ioctl), nullptr);
  }

  // Every time as another node, as a kernel does that still holds the old one.
  void plug(const std::string& ids, const std::string& name) {
    ++plugged_;
    const std::string text = "P: " + device_path() + "\nE: DRIVER=hid-generic\nE: SUBSYSTEM=hid\nE: HID_ID=0003:0000" +
                             ids + "\nE: HID_NAME=" + name +
                             "\nE: HID_PHYS=mock/0\nE: HID_UNIQ=SN0001\n\nP: " + device_path() + "/hidraw/" + node() +
                             "\nN: " + node() + "\nE: DEVNAME=/dev/" + node() +
                             "\nE: SUBSYSTEM=hidraw\nL: device=../../../" + device_name() + "\n\n";
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(testbed_.get(), text.c_str(), &error)) << error->message;
    const auto& descriptor = hid_guest::kSpaceMouseDescriptor;
    umockdev_testbed_set_attribute_binary(testbed_.get(), ("/sys" + device_path()).c_str(), "report_descriptor",
                                          const_cast<guint8*>(descriptor.data()), static_cast<gint>(descriptor.size()));
    ASSERT_TRUE(umockdev_testbed_attach_ioctl(testbed_.get(), ("/dev/" + node()).c_str(),
                                              reinterpret_cast<UMockdevIoctlBase*>(ioctls_.get()), &error))
        << error->message;
    device_ = umockdev_testbed_get_dev_fd(testbed_.get(), ("/dev/" + node()).c_str());
    ASSERT_GE(device_, 0);
  }

  void unplug() {
    ::close(device_);
    umockdev_testbed_remove_device(testbed_.get(), ("/sys" + device_path() + "/hidraw/" + node()).c_str());
    umockdev_testbed_remove_device(testbed_.get(), ("/sys" + device_path()).c_str());
  }

  std::string node() const { return "hidraw" + std::to_string(plugged_); }
  std::string device_name() const { return "0003:256F:C635.000" + std::to_string(plugged_); }
  std::string device_path() const { return "/devices/virtual/misc/uhid/" + device_name(); }

  template <std::size_t Size>
  void send(const std::array<std::uint8_t, Size>& report) const {
    ASSERT_EQ(::write(device_, report.data(), report.size()), static_cast<ssize_t>(report.size()));
  }

  // Polls as the wand's thread does until `done`, for a few seconds of this clock at most.
  template <class Done>
  WandState poll_until(HidSource& source, const Done& done) {
    WandState wand;
    for (int i = 0; i < 500; ++i) {
      clock_.now += 10'000'000;
      wand = source.poll();
      if (done(wand)) return wand;
    }
    ADD_FAILURE() << "in vain";
    return wand;
  }

  class HandClock final : public core::Clock {
   public:
    std::int64_t now_ns() const noexcept override { return now; }
    std::int64_t now = 1'000'000'000;
  };

  HandClock clock_;
  std::unique_ptr<UMockdevTestbed, Releaser> testbed_;
  std::unique_ptr<void, Releaser> ioctls_;
  int device_ = -1;
  int plugged_ = 0;
};

TEST_F(HidSourceTest, ListsAWandAndSaysThatItCanBeUsed) {
  plug(kCompact, "3Dconnexion SpaceMouse Compact");
  const auto found = find_hid_wands({});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ(found->front().name, "3Dconnexion SpaceMouse Compact (256f:c635)");
  EXPECT_TRUE(found->front().is_wand);
  EXPECT_TRUE(found->front().usable) << found->front().said;
  EXPECT_EQ(found->front().said, "SpaceMouse Compact at /dev/hidraw1");
}

TEST_F(HidSourceTest, ListsAMouseAsNoWand) {
  plug(kCadMouse, "CadMouse");
  const auto found = find_hid_wands({});
  ASSERT_TRUE(found && found->size() == 1U);
  EXPECT_FALSE(found->front().is_wand);
  EXPECT_EQ(found->front().said, "CadMouse: not a wand");
}

TEST_F(HidSourceTest, FollowsAWandThroughPluggingUnpluggingAndPluggingAgain) {
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_FALSE((*source)->poll().connected);

  plug(kCompact, "SpaceMouse Compact");
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  send(std::array<std::uint8_t, 3>{3, 2, 0});
  WandState wand = poll_until(**source, [](const WandState& w) { return w.buttons != 0; });
  EXPECT_TRUE(wand.pressed(WandButton::Grab));
  send(std::array<std::uint8_t, 7>{1, 0x5e, 0x01, 0, 0, 0, 0});
  wand = poll_until(**source, [](const WandState& w) { return w.push.x > 0.0; });
  EXPECT_EQ(wand.push.x, 1.0);

  unplug();
  wand = poll_until(**source, [](const WandState& w) { return !w.connected; });
  EXPECT_EQ(wand.buttons, 0U);
  EXPECT_FALSE(wand.orientation_valid);
  EXPECT_EQ(wand.push, glm::dvec3(0.0));

  plug(kCompact, "SpaceMouse Compact");
  wand = poll_until(**source, [](const WandState& w) { return w.connected; });
  EXPECT_EQ(wand.buttons, 0U);
}

TEST_F(HidSourceTest, CountsReportsOfTheWrongLengthAndGoesOn) {
  plug(kCompact, "SpaceMouse Compact");
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  send(std::array<std::uint8_t, 4>{1, 0x5e, 0x01, 0xa2});
  poll_until(**source, [&](const WandState&) { return (*source)->refused_reports() == 1; });
  send(std::array<std::uint8_t, 3>{3, 1, 0});
  poll_until(**source, [](const WandState& wand) { return wand.pressed(WandButton::Select); });
}

}  // namespace
}  // namespace afm::input
