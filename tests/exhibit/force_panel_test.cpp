// SPDX-License-Identifier: Apache-2.0
// Readability of the force panel: labels do not overlap, and colours can be distinguished with any colour vision.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>

#include "exhibit/frame/frame_builder.h"
#include "exhibit/scenery/stage_place.h"
#include "exhibit/scenery/wall_scene.h"
#include "panels/marker_layout.h"
#include "physics/cycle_figures.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/sweet_spot.h"

namespace afm::exhibit {
namespace force_panel_test {

using render::LabelBox;
using render::MarkerLabel;
using render::PlotMarker;

// Plot on the paper's wall, in millimetres, and a text size that is at least the drawn one.
const LabelBox kPlot{{150.0F, 270.0F}, {720.0F, 808.0F}};
const LabelBox kCaption{{158.0F, 268.0F}, {290.0F, 314.0F}};
constexpr float kWidestCharacter = 0.60F * 30.0F, kLine = 36.0F;

std::vector<MarkerLabel> labels_of(const render::ForcePanel& panel) {
  std::vector<MarkerLabel> labels;
  for (const PlotMarker& marker : panel.markers) {
    const bool vertical = marker.kind == PlotMarker::Kind::VerticalLine;
    const double low = vertical ? panel.place_min_nm : panel.force_min_nn;
    const double high = vertical ? panel.place_max_nm : panel.force_max_nn;
    const auto share = static_cast<float>((marker.value - low) / (high - low));
    const glm::vec2 size(kWidestCharacter * static_cast<float>(marker.label.size()) + 12.0F, kLine);
    labels.push_back({marker.kind,
                      vertical ? kPlot.from.x + share * (kPlot.to.x - kPlot.from.x)
                               : kPlot.to.y - share * (kPlot.to.y - kPlot.from.y),
                      size});
  }
  return labels;
}

// A pressed tip has its cursor in the upper left corner.
TEST(ForcePanel, HasItsCaptionBesideTheCursorAndNotBelowIt) {
  const auto cursor = [](float x, float y) { return LabelBox{{x - 19.0F, y - 19.0F}, {x + 19.0F, y + 19.0F}}; };
  for (float x = kPlot.from.x; x < kPlot.from.x + 200.0F; x += 10.0F) {
    const LabelBox pressed = cursor(x, kPlot.from.y);
    const LabelBox caption = render::moved_right_of(pressed, kCaption);
    EXPECT_FALSE(render::overlap(pressed, caption)) << x;
    EXPECT_FLOAT_EQ(caption.from.y, kCaption.from.y);
    EXPECT_LE(caption.to.x, kPlot.to.x);
  }
  EXPECT_EQ(render::moved_right_of(cursor(300.0F, 600.0F), kCaption).from, kCaption.from) << "a free tip's is far away";
}

TEST(ForcePanel, NoLabelCoversAnotherForAnyMaterialOfTheLibrary) {
  const std::string assets = support::source("assets");
  const scene::MaterialLibrary library = scene::load_materials(assets + "/materials.toml").value();
  const scene::Wall wall = scene::load_wall(assets + "/walls/powerwall.toml").value();
  std::size_t looked_at = 0;
  for (const scene::MaterialEntry& entry : library.materials) {
    const scene::MaterialLibrary one{{entry}};
    const WallScene scene = WallScene::load(assets, one, stage_place(wall), test::english()).value();
    const std::vector<curves::SampleModel> felt{curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value()};
    const FrameBuilder frames(scene, felt, support::eyes_at_sweet_spot(wall));
    Moment moment;
    moment.wall.material = 0;
    const render::ForcePanel panel = frames.build(moment).panels.force.content;
    if (felt.front().figures().hysteretic) {
      EXPECT_GE(panel.markers.size(), 4U) << entry.name;
    }
    std::vector<LabelBox> boxes{kCaption};
    render::place_labels(labels_of(panel), kPlot, boxes);
    boxes.erase(boxes.begin());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_GE(boxes[i].from.x, kPlot.from.x) << entry.name;
      EXPECT_LE(boxes[i].to.x, kPlot.to.x) << entry.name;
      EXPECT_FALSE(render::overlap(boxes[i], kCaption)) << entry.name << ": " << panel.markers[i].label;
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_FALSE(render::overlap(boxes[i], boxes[k]))
            << entry.name << ": " << panel.markers[i].label << " covers " << panel.markers[k].label;
      }
    }
    looked_at += boxes.size();
  }
  EXPECT_GT(looked_at, 40U);
}

// An earlier sample's forces need other axes: its curve would cross the plot from edge to edge.
TEST(ForcePanel, ThePresentSamplesCurveIsThereAlone) {
  const std::string assets = support::source("assets");
  const scene::MaterialLibrary library =
      scene::load_materials(assets + "/materials.toml").value().only(scene::kPaperMaterials).value();
  const scene::Wall wall = scene::load_wall(assets + "/walls/powerwall.toml").value();
  const WallScene scene = WallScene::load(assets, library, stage_place(wall), test::english()).value();
  std::vector<curves::SampleModel> felt;
  for (const scene::MaterialEntry& entry : library.materials)
    felt.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
  const std::vector<CycleCurve> curves(felt.size(), CycleCurve::from({{20.0, 0.0}, {-2.0, 0.3}, {20.0, 0.0}}));
  const FrameBuilder frames(scene, felt, support::eyes_at_sweet_spot(wall));
  Moment moment;
  moment.curves = curves;
  moment.wall.material = 1;
  const render::ForcePanel present = frames.build(moment).panels.force.content;
  ASSERT_EQ(present.curves.size(), 1U);
  EXPECT_EQ(present.curves.front().label, library.materials[1].title);
  moment.wall.centerpiece = Centerpiece::Plot;
  EXPECT_EQ(frames.build(moment).panels.force.content.curves.size(), felt.size());
}

// Where large letters leave no room, the last labels are left out.
TEST(ForcePanel, LabelsWithoutAPlaceAreLeftOut) {
  const LabelBox plot{{0.0F, 0.0F}, {400.0F, 120.0F}};
  const std::vector<MarkerLabel> same(8, {PlotMarker::Kind::VerticalLine, 200.0F, {180.0F, kLine}});
  std::vector<LabelBox> boxes;
  render::place_labels(same, plot, boxes);
  ASSERT_EQ(boxes.size(), same.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(boxes[i].empty(), i >= 6) << i;  // three rows on both sides
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(render::overlap(boxes[i], boxes[k])) << i << " and " << k;
  }
}

TEST(ForcePanel, LabelsOfOnePlaceMakeRoomForEachOther) {
  const std::vector<MarkerLabel> same(5, {PlotMarker::Kind::VerticalLine, 400.0F, {180.0F, kLine}});
  std::vector<LabelBox> boxes;
  render::place_labels(same, kPlot, boxes);
  ASSERT_EQ(boxes.size(), same.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(render::overlap(boxes[i], boxes[k]));
  }
}

// Dichromats' colours by G. Machado et al. (IEEE TVCG 15, 2009, table 1, severity 1.0), on linear sRGB.
constexpr std::array<std::array<double, 9>, 3> kDichromats{
    {{0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881},
     {0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998},
     {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900}}};

double linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// CIE 1976 L*a*b* (D65) of a linear sRGB colour.
glm::dvec3 lab(const glm::dvec3& c) {
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f((0.4124 * c.r + 0.3576 * c.g + 0.1805 * c.b) / 0.9505);
  const double y = f(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
  const double z = f((0.0193 * c.r + 0.1192 * c.g + 0.9505 * c.b) / 1.089);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

TEST(ForcePanel, CurvesDifferWithoutRedGreenOrBlueVision) {
  constexpr double kClearlyDifferent = 20.0;  // 2.3 is just noticeable side by side
  constexpr double kPapersThree = 40.0;       // difference without red or green vision
  for (const auto& matrix : kDichromats) {
    const double three = &matrix == &kDichromats.back() ? kClearlyDifferent : kPapersThree;
    const auto seen = [&](std::size_t i) {
      const glm::vec3 color = curve_color(i);
      const double rgb[] = {linear(static_cast<double>(color.r)), linear(static_cast<double>(color.g)),
                            linear(static_cast<double>(color.b))};
      glm::dvec3 result(0.0);
      for (glm::length_t row = 0; row < 3; ++row) {
        for (std::size_t k = 0; k < 3; ++k) result[row] += matrix[3 * static_cast<std::size_t>(row) + k] * rgb[k];
      }
      return lab(glm::max(result, glm::dvec3(0.0)));
    };
    for (std::size_t a = 0; a < 7; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_GT(glm::distance(seen(a), seen(b)), a < 3 ? three : kClearlyDifferent) << a << " and " << b;
      }
    }
  }
}

}  // namespace force_panel_test
}  // namespace afm::exhibit
