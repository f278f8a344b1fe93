// SPDX-License-Identifier: Apache-2.0
#include "curves/adhesion_map_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/samples/material_library.h"
#include "support/places.h"

namespace afm::curves {
namespace adhesion_map_plot_test {

using testing::HasSubstr;

SvgPlot map_of(const char* material) {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const physics::ContactParameters& contact = library.find(material)->contact;
  return adhesion_map_plot(material, physics::choose_law(contact), contact, physics::Force(-1e-9));
}

TEST(AdhesionMapPlot, MarksTheContactAtItsTaborParameterAndLoad) {
  const SvgPlot plot = map_of("mica");
  const SvgMark& here = plot.marks.back();
  EXPECT_NEAR(here.at.x, 0.0240, 1e-4);
  // 1 nN over pi W R = pi 4.456 mJ/m2 50 nm
  EXPECT_NEAR(here.at.y, 1.4287, 1e-3);
  EXPECT_THAT(svg(plot), HasSubstr("this contact: \u03bc = 0.024"));
}

TEST(AdhesionMapPlot, NamesEveryRegion) {
  const std::string text = svg(map_of("pdms-air"));
  for (const char* region : {"Hertz", "Bradley", "DMT", "Maugis-Dugdale", "JKR"}) EXPECT_THAT(text, HasSubstr(region));
  EXPECT_THAT(text, testing::Not(HasSubstr("nan")));
}

// Adhesion adds 5 % to the load of a stiff contact where 2 pi W R is 5 % of it: at 40 pi W R.
TEST(AdhesionMapPlot, PutsHertzAboveWhereAdhesionIsNegligible) {
  const SvgPlot plot = map_of("gold");
  const std::vector<SvgPoint>& hertz = plot.lines.front().points;
  EXPECT_NEAR(hertz.front().y, 40.0, 1.0);
  EXPECT_GT(hertz.back().y, 1000.0);
  EXPECT_TRUE(
      std::is_sorted(hertz.begin(), hertz.end(), [](SvgPoint a, SvgPoint b) { return a.y < b.y * (1 - 1e-6); }));
}

TEST(AdhesionMapPlot, PutsTheBordersOfTheLawsWhereTheChoiceChanges) {
  const SvgPlot plot = map_of("gold");
  ASSERT_GE(plot.lines.size(), 4U);
  ASSERT_GE(plot.lines[2].points.size(), 2U);
  ASSERT_GE(plot.lines[3].points.size(), 2U);
  for (const SvgPoint& point : plot.lines[2].points) EXPECT_NEAR(point.x, 0.1, 1e-6);
  for (const SvgPoint& point : plot.lines[3].points) EXPECT_NEAR(point.x, 5.0, 1e-6);
}

}  // namespace adhesion_map_plot_test
}  // namespace afm::curves
