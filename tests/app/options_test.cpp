// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>

#include "app/options/enum_option.h"
#include "app/options/pixel_size_option.h"
#include "app/options/quantity_option.h"

namespace afm::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class OptionsTest : public testing::Test {
 protected:
  // What is refused, or nothing.
  std::string refusal(const std::string& text) {
    try {
      command_.parse("--option " + text);
    } catch (const CLI::ParseError& wrong) {
      return wrong.what();
    }
    return {};
  }

  CLI::App command_;
};

TEST_F(OptionsTest, AQuantityIsReadInSiAndRefusedWithItsUnits) {
  double read_m = 0;
  quantity_option(
      command_, "--option", [&](physics::Length length) { read_m = length.si; }, physics::kLengthUnits, "a way");
  EXPECT_EQ(refusal("50nm"), "");
  EXPECT_DOUBLE_EQ(read_m, 50e-9);
  for (const char* wrong : {"50", "50N", "nm", "nan"}) {
    EXPECT_THAT(refusal(wrong), AllOf(HasSubstr("--option"), HasSubstr("um, nm, pm"))) << wrong;
  }
  EXPECT_THAT(command_.help(), HasSubstr("--option LENGTH in m, mm, um, nm, pm"));
}

TEST_F(OptionsTest, AQuantityOutsideItsRangeIsRefusedWithTheRange) {
  double read_m_per_s = 0;
  quantity_option(
      command_, "--option", [&](physics::Velocity speed) { read_m_per_s = speed.si; }, physics::kVelocityUnits, "haste",
      std::optional(QuantityRange<physics::Velocity>{physics::Velocity(0.005), physics::Velocity(0.2)}));
  for (const char* end : {"5mm/s", "0.2m/s"}) EXPECT_EQ(refusal(end), "");
  for (const char* wrong : {"4.9mm/s", "0.21m/s", "-1m/s"}) {
    EXPECT_THAT(refusal(wrong), HasSubstr("is outside 5mm/s to 200mm/s")) << wrong;
  }
  EXPECT_EQ(read_m_per_s, 0.2);
  EXPECT_THAT(command_.help(), HasSubstr("--option VELOCITY in 5mm/s to 200mm/s"));
}

TEST_F(OptionsTest, AChoiceIsARowOfItsTable) {
  struct Row {
    int value;
    const char* name;
  };
  static constexpr std::array kRows{Row{7, "seven"}, Row{9, "nine"}};
  std::optional<int> chosen;
  enum_option(command_, "--option", chosen, "a lucky number", kRows, &Row::name, &Row::value, "luck");
  EXPECT_EQ(refusal("nine"), "");
  EXPECT_EQ(chosen, 9);
  EXPECT_THAT(refusal("Nine"), HasSubstr("\"Nine\" is not a lucky number; there are seven, nine"));
  EXPECT_THAT(command_.help(), HasSubstr("--option {seven,nine}"));
}

TEST_F(OptionsTest, ASizeIsTwoNumbersWithinItsRange) {
  std::optional<glm::uvec2> size;
  pixel_size_option(command_, "--option", size, "a window", PixelRange{64, 16384});
  EXPECT_EQ(refusal("64x16384"), "");
  EXPECT_EQ(size, glm::uvec2(64, 16384));
  for (const char* wrong : {"63x64", "64x16385"}) {
    EXPECT_THAT(refusal(wrong), HasSubstr("is not WIDTHxHEIGHT in pixels of 64 to 16384 each")) << wrong;
  }
  EXPECT_THAT(command_.help(), HasSubstr("--option WIDTHxHEIGHT in 64 to 16384 each"));
}

TEST(PixelSize, IsWidthAndHeight) {
  EXPECT_EQ(parse_pixel_size("1920x1080"), glm::uvec2(1920, 1080));
  EXPECT_EQ(parse_pixel_size("0x1"), glm::uvec2(0, 1));
  for (const char* wrong : {"", "x", "1920", "1920x", "x1080", "1920x1080x2", "-1x5", "1920 x 1080", "1x99999999999"}) {
    EXPECT_EQ(parse_pixel_size(wrong), std::nullopt) << wrong;
  }
}

}  // namespace
}  // namespace afm::app
