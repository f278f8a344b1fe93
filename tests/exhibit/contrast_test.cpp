// SPDX-License-Identifier: Apache-2.0
// Readability of the panels for people with low vision: contrast and size by WCAG 2.2 and XAUR.
// Invariant: every text of the panels has a contrast of 4.5 before the brightest scene, 7 in high contrast
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "panels/canvas.h"
#include "panels/panel_fonts.h"

namespace afm::render {
namespace contrast_test {

// Relative luminance of an sRGB colour, and the ratio of two (WCAG 2.2).
double luminance(const glm::dvec3& srgb) {
  const auto linear = [](double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(srgb.r) + 0.7152 * linear(srgb.g) + 0.0722 * linear(srgb.b);
}
double contrast(const glm::dvec3& a, const glm::dvec3& b) {
  const double first = luminance(a), second = luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}
glm::dvec3 hex(unsigned rgb) { return glm::dvec3(rgb >> 16U, rgb >> 8U & 0xFFU, rgb & 0xFFU) / 255.0; }

// The plate before the brightest scene that may shine through it.
glm::vec3 plate_before_white(PanelContrast contrast) {
  const Color plate = shown(palette::kPlate, contrast);
  return glm::mix(glm::vec3(1.0F), plate.srgb, plate.alpha);
}

constexpr Color kTexts[] = {palette::kInk, palette::kMuted, palette::kYellow, palette::kOrange, palette::kSkyBlue};

TEST(Contrast, IsTheRatioOfWcag) {  // D14
  EXPECT_NEAR(contrast(hex(0x767676), hex(0xFFFFFF)), 4.54222496, 1e-5);
  EXPECT_NEAR(contrast(hex(0x000000), hex(0xFFFFFF)), 21.0, 1e-5);
  EXPECT_NEAR(contrast(hex(0xFF9900), hex(0x101418)), 8.639684331, 1e-5);
  EXPECT_NEAR(contrast(hex(0x3399FF), hex(0x101418)), 6.290281758, 1e-5);
}

TEST(Contrast, OfEveryTextOfThePanelsIsEnoughBeforeTheBrightestScene) {  // WCAG 1.4.3
  for (const Color& text : kTexts)
    EXPECT_GE(contrast(glm::dvec3(text.srgb), glm::dvec3(plate_before_white(PanelContrast::Normal))), 4.5);
}

TEST(Contrast, InAHeadsetIsThatOfTheSamePlateWithNothingBehindIt) {
  EXPECT_EQ(plate_before_white(PanelContrast::Opaque), palette::kPlate.srgb);
  for (const Color& text : kTexts) {
    EXPECT_EQ(shown(text, PanelContrast::Opaque).srgb, text.srgb);
    EXPECT_GE(contrast(glm::dvec3(text.srgb), glm::dvec3(palette::kPlate.srgb)), 4.5);
  }
}

TEST(Contrast, WhereItIsHighIsEnhanced) {  // WCAG 1.4.6
  EXPECT_EQ(plate_before_white(PanelContrast::High), glm::vec3(0.0F));
  for (const Color& text : kTexts) {
    EXPECT_GE(contrast(glm::dvec3(shown(text, PanelContrast::High).srgb), glm::dvec3(0.0)), 7.0);
  }
  EXPECT_EQ(shown(palette::kMuted, PanelContrast::High).srgb, glm::vec3(1.0F));
  EXPECT_EQ(shown(palette::kOrange, PanelContrast::High).srgb, palette::kOrange.srgb) << "it says that a value changed";
  EXPECT_GT(shown(palette::kEdge, PanelContrast::High).alpha, 2.0F * palette::kEdge.alpha);
}

// Minutes of arc under which a height is seen.
double minutes(double height_m, double distance_m) {
  return std::atan(height_m / distance_m) * 60.0 * 180.0 / std::numbers::pi;
}

TEST(Letters, OfEveryStyleAreLargeEnoughFromTheSweetSpotOfThePapersWall) {  // D15
  constexpr double kSweetSpotM = 2.5, kCapShare = 0.727;                    // cap height in Inter's em square
  EXPECT_NEAR(minutes(0.020, kSweetSpotM), 27.50138748, 27.5e-6);
  EXPECT_NEAR(std::tan(20.0 / 60.0 * std::numbers::pi / 180.0) * kSweetSpotM, 0.01454457453, 1.5e-8);
  for (const TextStyle style :
       {TextStyle::Small, TextStyle::Body, TextStyle::Strong, TextStyle::Title, TextStyle::Guidance}) {
    const double cap_m = 1e-3 * kCapShare * static_cast<double>(text_height_mm(style));
    EXPECT_GE(minutes(cap_m, kSweetSpotM), 20.0) << static_cast<int>(style);
  }
}

}  // namespace contrast_test
}  // namespace afm::render
