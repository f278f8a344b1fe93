// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/data_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "curves/sample_model.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace data_panel_test {

using physics::Law;

render::DataPanel panel_of(Law law, const scene::Tip& tip = {}) {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  curves::ContactSetup setup{*library.find("mica"), {}, {}};
  setup.model.law = law;
  return data_panel(curves::make_sample_model(setup).value(), tip, test::english());
}

bool shows(const render::DataPanel& panel, std::string_view begin) {
  return std::any_of(panel.rows.begin(), panel.rows.end(),
                     [&](const render::DataRow& row) { return std::string_view(row.name).starts_with(begin); });
}

TEST(DataPanel, ShowsTheNumbersThatActInTheLawAndNoOthers) {
  const auto laws = physics::laws_with(&physics::LawTraits::computed);
  ASSERT_GE(laws.size(), 7U);
  for (const Law law : laws) {
    const render::DataPanel panel = panel_of(law);
    const physics::LawTraits& traits = physics::traits_of(law);
    EXPECT_EQ(shows(panel, "Hamaker constant"), traits.van_der_waals) << traits.name;
    EXPECT_EQ(shows(panel, "Surface energy"), traits.adhesion) << traits.name;
    EXPECT_EQ(shows(panel, "Reduced modulus"), traits.modulus != physics::ModulusUse::Unused) << traits.name;
    EXPECT_EQ(shows(panel, "Atomic distance"), traits.atomic_distance) << traits.name;
  }
}

TEST(DataPanel, GivesLennardJonesItsAtomicDistanceAndNoHamakerConstant) {
  const render::DataPanel panel = panel_of(Law::LennardJones);
  EXPECT_FALSE(shows(panel, "Hamaker constant"));
  const auto row = std::find_if(panel.rows.begin(), panel.rows.end(),
                                [](const render::DataRow& each) { return each.name == "Atomic distance z0"; });
  ASSERT_NE(row, panel.rows.end());
  EXPECT_EQ(row->value, "300 pm");
  EXPECT_THAT(row->source, ::testing::HasSubstr("estimated: "));
}

TEST(DataPanel, LeavesSourcesAndReasonsToTheDetails) {
  const render::DataPanel panel = panel_of(Law::Paper);
  EXPECT_FALSE(panel.details);
  for (const render::DataRow& row : panel.rows) EXPECT_TRUE(row.detail) << row.name;
  EXPECT_FALSE(panel.rows.front().source.empty());
}

TEST(DataPanel, SaysWhichWayTheLeverIsBent) {
  scene::Tip pulled{};
  pulled.deflection_m = 0.8e-9;
  scene::Tip pressed{};
  pressed.deflection_m = -7e-9;
  EXPECT_EQ(panel_of(Law::Paper, pulled).rows.back().source, "lever bent down by 0.80 nm");
  EXPECT_EQ(panel_of(Law::Paper, pressed).rows.back().source, "lever bent up by 7.00 nm");
  for (const double unseen_m : {0.0, -0.0, 4e-12, -4e-12}) {
    scene::Tip free{};
    free.deflection_m = unseen_m;
    free.force_n = -unseen_m * 0.1;
    EXPECT_EQ(panel_of(Law::Paper, free).rows.back().source, "lever not bent") << unseen_m;
    EXPECT_EQ(panel_of(Law::Paper, free).rows.back().value, "0.000 nN") << unseen_m;
  }
}

}  // namespace data_panel_test
}  // namespace afm::exhibit
