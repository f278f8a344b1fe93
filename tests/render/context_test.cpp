// SPDX-License-Identifier: Apache-2.0
#include "render/context.h"

#include <gmock/gmock.h>

#include <cstdlib>

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

}  // namespace context_test
}  // namespace afm::test
