// SPDX-License-Identifier: Apache-2.0
#include "render/context.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace context_test {

class Context : public VulkanTest {};

TEST_F(Context, NamesItsDevice) { EXPECT_FALSE(context_.device_name().empty()); }

TEST_F(Context, IsAmongTheListedDevices) {
  const auto devices = render::list_devices();
  ASSERT_TRUE(devices);
  EXPECT_THAT(*devices,
              testing::Contains(testing::AllOf(testing::Field(&render::DeviceDescription::name, context_.device_name()),
                                               testing::Field(&render::DeviceDescription::usable, true))));
}

TEST_F(Context, RefusesPicturesThatTheDeviceCannotDraw) {
  const auto test = make_test_scene();
  auto options = small();
  options.eye_width = 1U << 30U;
  const auto too_wide = render::Renderer::create(context_, test.scene, options);
  ASSERT_FALSE(too_wide);
  EXPECT_THAT(too_wide.error().message, testing::HasSubstr("cannot draw eye images of 1073741824x192 pixels"));
  const auto samples = render::Renderer::create(context_, test.scene, small(3));
  ASSERT_FALSE(samples);
  EXPECT_THAT(samples.error().message, testing::HasSubstr("choose 1 or 4"));
}

// The loader reads these when an instance is made.
TEST(WithoutDriver, TheErrorSaysWhatToInstall) {
  ASSERT_EQ(setenv("VK_ICD_FILENAMES", "/nonexistent.json", 1), 0);
  ASSERT_EQ(setenv("VK_DRIVER_FILES", "/nonexistent.json", 1), 0);
  const auto context = render::Context::open();
  const auto devices = render::list_devices();
  unsetenv("VK_ICD_FILENAMES");
  unsetenv("VK_DRIVER_FILES");
  ASSERT_FALSE(context);
  EXPECT_EQ(context.error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_THAT(context.error().message, testing::HasSubstr("mesa-vulkan-drivers"));
  EXPECT_THAT(context.error().message, testing::Not(testing::HasSubstr("\n")));
  ASSERT_FALSE(devices);
  EXPECT_EQ(devices.error().category, core::ErrorCategory::DeviceMissing);
}

// A machine with two devices of one name: lavapipe, listed twice.
class TwoDevices : public ::testing::Test {
 protected:
  void SetUp() override {
    std::vector<std::filesystem::path> drivers;
    for (const auto& entry : std::filesystem::directory_iterator("/usr/share/vulkan/icd.d")) {
      if (entry.path().filename().string().starts_with("lvp_icd")) drivers.push_back(entry.path());
    }
    ASSERT_FALSE(drivers.empty()) << "install mesa-vulkan-drivers";
    const std::string copy = folder_.file("second.json");
    std::filesystem::copy_file(drivers.front(), copy);
    const std::string both = drivers.front().string() + ":" + copy;
    ASSERT_EQ(setenv("VK_DRIVER_FILES", both.c_str(), 1), 0);
    ASSERT_EQ(setenv("VK_ICD_FILENAMES", both.c_str(), 1), 0);
  }
  void TearDown() override {
    unsetenv("VK_ICD_FILENAMES");
    unsetenv("VK_DRIVER_FILES");
  }

 private:
  support::ScratchFolder folder_;
};

TEST_F(TwoDevices, DifferByNumber) {
  const auto devices = render::list_devices();
  ASSERT_TRUE(devices) << devices.error().message;
  ASSERT_EQ(devices->size(), 2U);
  EXPECT_EQ(devices->back().name, devices->front().name + " #2");
  for (const auto& device : *devices) {
    const auto context = render::Context::open({.gpu = device.name});
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_EQ(context->device_name(), device.name);
  }
  const auto second = render::Context::open({.gpu = "#2"});
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(second->device_name(), devices->back().name);
}

TEST_F(TwoDevices, AreBothNamedWhereThereIsNoneOrMoreThanOne) {
  const auto neither = render::Context::open({.gpu = "GeForce"});
  ASSERT_FALSE(neither);
  EXPECT_EQ(neither.error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_THAT(neither.error().message,
              testing::AllOf(testing::HasSubstr("no graphics device is called 'GeForce'"), testing::HasSubstr("#2'")));
  const auto either = render::Context::open({.gpu = "LLVMpipe"});
  ASSERT_FALSE(either);
  EXPECT_EQ(either.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(either.error().message, testing::HasSubstr("could be any of the graphics devices"));
}

}  // namespace context_test
}  // namespace afm::test
