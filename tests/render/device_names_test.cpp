// SPDX-License-Identifier: Apache-2.0
#include "device/device_names.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace afm::render {
namespace device_names_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(DeviceNames, AreDistinct) {
  EXPECT_THAT(distinct_names({"A6000", "llvmpipe", "A6000", "A6000"}),
              ElementsAre("A6000", "llvmpipe", "A6000 #2", "A6000 #3"));
  EXPECT_THAT(distinct_names({}), ElementsAre());
}

TEST(DeviceNames, AreFoundByAPartThatNoOtherHas) {
  const std::vector<std::string> names{"NVIDIA RTX A6000", "NVIDIA RTX A6000 #2", "AMD Radeon", "AMD Radeon Pro"};
  EXPECT_EQ(find_device(names, "nvidia rtx a6000").value(), 0U);
  EXPECT_EQ(find_device(names, "#2").value(), 1U);
  EXPECT_EQ(find_device(names, "AMD Radeon").value(), 2U);
  EXPECT_EQ(find_device(names, "pro").value(), 3U);
}

TEST(DeviceNames, AreListedWhereNoneOrSeveralAreMeant) {
  const std::vector<std::string> names{"AMD Radeon", "AMD Radeon #2", "llvmpipe"};
  const auto none = find_device(names, "GeForce");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_EQ(none.error().message,
            "no graphics device is called 'GeForce': this machine has 'AMD Radeon', 'AMD Radeon #2', 'llvmpipe'");
  const auto several = find_device(names, "AMD");
  ASSERT_FALSE(several);
  EXPECT_EQ(several.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(several.error().message,
              ::testing::AllOf(HasSubstr("'AMD Radeon', 'AMD Radeon #2'"), ::testing::Not(HasSubstr("llvmpipe"))));
}

}  // namespace device_names_test
}  // namespace afm::render
