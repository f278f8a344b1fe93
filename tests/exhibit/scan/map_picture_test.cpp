// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/map_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/live_parameters.h"
#include "exhibit/models/height_colours.h"
#include "exhibit/panels/parameter_panel.h"
#include "render/control_layout.h"
#include "scene/samples/material_library.h"
#include "scene/shared/tip_blocks.h"
#include "support/archives/sticky_map.h"
#include "support/archives/stored_zip.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace map_picture_test {

using Target = render::ControlTarget;
using testing::ElementsAre;

class MapPictureTest : public testing::Test {
 protected:
  const support::ScratchFolder folder_;
  const curves::CurveMap map_ =
      curves::CurveMap::load(folder_.write("gel.jpk-force-map", test::stored_zip(test::holed_map())), [](std::size_t,
                                                                                                         std::size_t) {
        return true;
      }).value();
  const render::MapPicture picture_ = map_picture(map_, {1, 0}, test::english());

  // Colour in the middle of a pixel.
  static Srgb color(const render::MapPicture& picture, std::size_t column, std::size_t row_from_top) {
    const std::size_t across = picture.grid.columns / 3, down = picture.grid.rows / 2;
    const auto& c =
        picture.grid.colors[(row_from_top * down + down / 2) * picture.grid.columns + column * across + across / 2];
    return {c[0], c[1], c[2]};
  }
  Srgb color(std::size_t column, std::size_t row_from_top) const { return color(picture_, column, row_from_top); }
};

TEST_F(MapPictureTest, HasTheHighestPixelAtTheTopLeftAndAHoleAtTheBottomRight) {
  EXPECT_EQ(picture_.columns, 3U);
  EXPECT_EQ(picture_.rows, 2U);
  EXPECT_DOUBLE_EQ(picture_.aspect, 1.5);
  EXPECT_EQ(color(0, 0), height_colour(1.0));
  EXPECT_EQ(color(0, 1), height_colour(0.0));
  EXPECT_EQ(color(2, 1), kNoHeightColour);
  EXPECT_EQ(color(1, 0), height_colour(0.8));
  EXPECT_EQ(picture_.highest, "50 nm");
  EXPECT_EQ(picture_.marked, 4U);
}

// A map with made-up fits, whose modulus is 1 kPa more with each curve.
TEST_F(MapPictureTest, ShowsTheModulusOfTheFitsThatMeanSomething) {
  std::atomic<int> calls = 0;
  const auto fit = [&calls](const curves::RecordedCurve& curve) {
    ++calls;
    const auto index = static_cast<double>(curve.metadata.pixel->column + 3 * curve.metadata.pixel->row);
    return curves::PixelFit{.modulus_pa = 1e3 * (1.0 + index),
                            .adhesion_n = 1e-9 * (6.0 - index),
                            .trust = index == 4.0 ? fits::Trust::No : fits::Trust::Doubtful};
  };
  const auto map = curves::CurveMap::load(map_.path(), [](std::size_t, std::size_t) { return true; }, {}, fit);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(first_quantity(*map), MapQuantity::Modulus);
  EXPECT_EQ(next_quantity(*map, MapQuantity::Modulus), MapQuantity::Adhesion);
  EXPECT_EQ(next_quantity(*map, MapQuantity::Adhesion), MapQuantity::Height);
  EXPECT_EQ(next_quantity(map_, first_quantity(map_)), MapQuantity::Height) << "without fits there is no other";

  const render::MapPicture modulus = map_picture(*map, {1, 0}, test::english(), MapQuantity::Modulus);
  EXPECT_EQ(modulus.lowest, "1 kPa");
  EXPECT_EQ(modulus.highest, "6 kPa");
  EXPECT_EQ(modulus.marked, 4U);
  EXPECT_EQ(color(modulus, 0, 1), height_colour(0.0));
  EXPECT_EQ(color(modulus, 2, 0), height_colour(1.0));
  EXPECT_EQ(color(modulus, 1, 0), kNoHeightColour) << "its fit means nothing";
  EXPECT_EQ(color(modulus, 2, 1), kNoHeightColour) << "a hole";
  const render::MapPicture pull = map_picture(*map, {1, 0}, test::english(), MapQuantity::Adhesion);
  EXPECT_EQ(pull.lowest, "1 nN");
  EXPECT_EQ(pull.highest, "6 nN");
  EXPECT_EQ(color(pull, 0, 1), height_colour(1.0));
}

TEST_F(MapPictureTest, ShowsEachOfAFewCurvesOnALargeGrid) {
  const auto entries = test::on_finer_grid(test::jpk_map(test::sticky_curve), 129);
  const auto map = curves::CurveMap::load(folder_.write("few.jpk-force-map", test::stored_zip(entries)),
                                          [](std::size_t, std::size_t) { return true; });
  ASSERT_TRUE(map) << map.error().message;
  const auto cells = map_picture(*map, map->middle(), test::english()).grid;
  EXPECT_EQ(cells.colors.size(), 128U * 128U);
  const auto& none = kNoHeightColour;
  EXPECT_EQ(std::count_if(cells.colors.begin(), cells.colors.end(),
                          [&](const auto& c) { return Srgb{c[0], c[1], c[2]} != none; }),
            6);
}

TEST_F(MapPictureTest, IsPointedAtPixelByPixel) {
  constexpr glm::dvec2 kSize{600.0, 920.0};
  const render::ControlPanel panel{.title = "gel (1,0)",
                                   .buttons = {"Reset", "Close"},
                                   .rows = {{.name = "column", .value = "1"}, {.name = "row", .value = "0"}},
                                   .notes = {"Snap-in", "Pull-off", "Loop", "doubtful"},
                                   .status = "felt",
                                   .pointed = {},
                                   .marked = {},
                                   .picture = picture_};
  for (std::size_t i = 0; i < 6; ++i) {
    const Target target{Target::Kind::Pixel, i};
    const auto box = render::control_box(panel, kSize, target);
    EXPECT_GT(box.to_mm.x - box.from_mm.x, 70.0);
    EXPECT_LT(box.to_mm.x, kSize.x - 150.0) << "no room for the bar";
    EXPECT_LT(box.to_mm.y, kSize.y);
    EXPECT_EQ(render::control_at(panel, kSize, 0.5 * (box.from_mm + box.to_mm)), target);
    const curves::MapPlace place = place_of(target, map_);
    EXPECT_EQ(target_index(place, map_), i);
    EXPECT_TRUE(map_.holds(place));
  }
  EXPECT_FALSE(map_.holds(place_of({Target::Kind::Pixel, 6}, map_)));
  for (const auto kind : {Target::Kind::Less, Target::Kind::More}) {
    const auto box = render::control_box(panel, kSize, {kind, 1});
    EXPECT_EQ(render::control_at(panel, kSize, 0.5 * (box.from_mm + box.to_mm)), (Target{kind, 1}));
  }
}

TEST_F(MapPictureTest, LiesBesideTheRowsOfThePixelAlone) {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const auto map = std::make_shared<const curves::CurveMap>(map_);
  const auto model = curves::make_sample_model(map, {1, 0}, library.materials.front());
  ASSERT_TRUE(model) << model.error().message;
  curves::LiveParameters pixel(*model);
  const render::ControlPanel panel = parameter_panel(pixel, "gel", ChangeState::Held, test::english());
  ASSERT_EQ(panel.rows.size(), 2U);
  EXPECT_EQ(panel.rows[0].value, "1");
  EXPECT_EQ(panel.rows[1].value, "0");
  EXPECT_EQ(panel.status, "lift the tip to choose another pixel");
  for (const std::string& note : panel.notes) {
    EXPECT_THAT(note, testing::Not(testing::HasSubstr("Tabor"))) << "of a law that is not felt";
  }
  ASSERT_FALSE(pixel.step(curves::LiveParameters::Row::PixelColumn, 1));
  EXPECT_EQ(parameter_panel(pixel, "gel", ChangeState::AsLoaded, test::english()).status,
            "not changed: no curve there that can be felt");
}

TEST_F(MapPictureTest, SaysWhatIsFeltOfAWholeMapBelowTheTip) {
  curves::FeltMap felt;
  felt.law = physics::Law::Jkr;
  felt.poisson = 0.5;
  felt.grid = map_.grid();
  felt.is_filled.assign(6, false);
  felt.is_filled[5] = true;  // right end of the lower row
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const auto fit = [](const curves::RecordedCurve& curve) {
    const bool doubtful = curve.metadata.pixel->column == 1 && curve.metadata.pixel->row == 0;
    return curves::PixelFit{.modulus_pa = 2e6, .trust = doubtful ? fits::Trust::Doubtful : fits::Trust::Trusted};
  };
  auto map = curves::CurveMap::load(map_.path(), [](std::size_t, std::size_t) { return true; }, {}, fit);
  ASSERT_TRUE(map) << map.error().message;
  auto model = curves::make_sample_model(std::make_shared<const curves::CurveMap>(std::move(*map)), {1, 0},
                                         library.materials.front());
  ASSERT_TRUE(model) << model.error().message;
  model->felt_map = std::make_shared<const curves::FeltMap>(felt);
  scene::TipState tip;
  EXPECT_TRUE(felt_map_notes(*model, tip, test::english()).empty()) << "before the first tick";
  tip.here = {.reduced_modulus_pa = 2.3e6 / 0.75, .adhesion_j_per_m2 = 40e-3};
  const auto at = [&](double x, double y) {
    tip.surface.xy_m = {x * felt.grid.width_m, y * felt.grid.height_m};
    return felt_map_notes(*model, tip, test::english());
  };
  const std::string here = "map: E 2.3 MPa, W 40 mJ/m\u00b2 here";
  EXPECT_THAT(at(0.4, -0.2), ElementsAre(here, "filled from its neighbours: no fit to trust"));
  EXPECT_THAT(at(-0.4, 0.2), ElementsAre(here));
  EXPECT_THAT(at(0.0, -0.2), ElementsAre(here, "the fit of this pixel is doubtful"));
  EXPECT_THAT(at(0.6, 0.0), ElementsAre(here, "beside the map: as at its edge"));
  felt.law = physics::Law::Hertz;
  model->felt_map = std::make_shared<const curves::FeltMap>(felt);
  EXPECT_THAT(at(-0.4, 0.2), ElementsAre("map: E 2.3 MPa here"));
}

}  // namespace map_picture_test
}  // namespace afm::exhibit
