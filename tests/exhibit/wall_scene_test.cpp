// SPDX-License-Identifier: Apache-2.0
// Invariant: the apex is drawn at its height however the lever bends; text is in the wall's plane
#include "exhibit/scenery/wall_scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string_view>
#include <utility>

#include "curves/live_parameters.h"
#include "curves/sample_model.h"
#include "exhibit/models/user_models.h"
#include "exhibit/scenery/wall_marks.h"
#include "physics/contact.h"
#include "scene/shared/felt_heights.h"
#include "support/paper_wall.h"

namespace afm::exhibit {
namespace wall_scene_test {

class WallSceneTest : public test::PaperWall {
 protected:
  const scene::Screen& screen_ = wall_.screens.front();
  const glm::dvec3 viewer_ = wall_.viewers.front().sweet_spot.position_m;
  const StagePlace stage_ = stage_place(wall_);

  render::FrameState frame(const WallState& pose) const {
    render::FrameState state;
    scene_.update(pose, state);
    return state;
  }

  const scene::SharedHeightField& surface_of(std::size_t material) const {
    scene::SharedContact parameters;
    scene_.lay_surface_on(parameters, material);
    return scene_.height_fields()[parameters.height_field];
  }

  glm::dvec3 origin_of(const render::FrameState& state, std::string_view node) const {
    return glm::dvec3(state.room_from_node[scene_.scene().find_node(node).value()][3]);
  }

  // Place of the apex according to the drawn transforms.
  glm::dvec3 apex(const WallState& pose) const { return origin_of(frame(pose), "probe/apex"); }

  glm::dvec3 contact() const { return origin_of(frame({}), "sample"); }
};

TEST_F(WallSceneTest, TheContactPointLiesInTheWallNoHigherThanTheEyesInItsMiddleThird) {
  EXPECT_NEAR(contact().z, 0.0, 1e-12);
  EXPECT_NEAR(contact().x, 0.0, 1e-12);
  EXPECT_LE(contact().y, viewer_.y);
  EXPECT_GT(contact().y, screen_.lower_left.y + screen_.height_m() / 3.0);
  EXPECT_LT(contact().y, screen_.lower_left.y + screen_.height_m() * 2.0 / 3.0);
}

TEST_F(WallSceneTest, TheApexIsAtItsHeightHoweverTheLeverBends) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const double z_joc = physics::approach_retract_events(materials_.materials[material].contact).z_joc.si;
    const double scale = scene_.drawn_scale(material).sample_m_per_m;
    for (const double z : {-0.3, 0.0, 0.5, 1.0}) {
      for (const double deflection : {-0.3, 0.0, 0.5, 1.0}) {
        const scene::Tip tip{.z_m = z * z_joc, .deflection_m = deflection * z_joc};
        const glm::dvec3 offset = apex({.material = material, .tip = tip}) - contact();
        EXPECT_NEAR(glm::dot(offset, scene_.sample_normal()), (tip.z_m - tip.deflection_m) / scale, 2e-3);
        EXPECT_NEAR(glm::length(offset - glm::dot(offset, scene_.sample_normal()) * scene_.sample_normal()), 0.0, 2e-3);
      }
    }
  }
}

TEST_F(WallSceneTest, TheApexIsOverTheDrawnSurfaceWhereverTheTipIs) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const double scale = scene_.drawn_scale(material).sample_m_per_m;
    const scene::SharedHeightField& field = surface_of(material);
    const auto surface = scene_.scene().find_node("sample-" + materials_.materials[material].name + "/surface").value();
    const auto& drawn = scene_.scene().meshes[*scene_.scene().nodes[surface].mesh].primitives.front().vertices;
    for (std::size_t vertex = 5; vertex < drawn.size(); vertex += 397) {
      const glm::dvec3 place(drawn[vertex].position);
      EXPECT_EQ(static_cast<double>(field.height_m[vertex]), place.z);
      for (const double gap : {0.0, 3e-9}) {
        const WallState pose{.material = material,
                             .tip = {.z_m = gap + 1e-9, .deflection_m = 1e-9},
                             .surface = {{place.x, place.y}, place.z}};
        const render::FrameState state = frame(pose);
        const glm::dvec3 vertex_m(state.room_from_node[surface] * glm::dvec4(place, 1.0));
        const glm::dvec3 above_m = vertex_m + gap / scale * scene_.sample_normal();
        // the tip's mesh and its apex are floats, some 1e-7 of the tip's length apart
        EXPECT_NEAR(glm::length(origin_of(state, "probe/apex") - above_m), 0.0, 1e-7);
        const glm::dvec3 at_origin_m = apex({.material = material, .tip = {.z_m = gap + 1e-9, .deflection_m = 1e-9}});
        const glm::dvec3 origin_m(state.room_from_node[surface][3]);
        EXPECT_NEAR(glm::length(origin_of(state, "probe/apex") - at_origin_m - (vertex_m - origin_m)), 0.0, 1e-9);
      }
    }
  }
}

TEST_F(WallSceneTest, TheBeamOfLightFollowsTheTip) {
  const glm::dvec2 there(4e-9, -3e-9);
  const auto lever_end = [&](const glm::dvec2& xy) {
    const render::FrameState state = frame({.material = 0, .surface = {{xy.x, xy.y}, 0.5e-9}});
    return glm::dvec3(state.room_from_node[scene_.scene().find_node("optics/beam-reflected").value()][3]);
  };
  const double scale = scene_.drawn_scale(0).sample_m_per_m;
  EXPECT_NEAR(glm::length(lever_end(there) - lever_end({})), glm::length(there) / scale, 1e-9);
  EXPECT_NEAR(glm::dot(lever_end(there) - lever_end({}), scene_.sample_right()), there.x / scale, 1e-9);
}

TEST_F(WallSceneTest, TheRulerEndsInATickAtItsFootAndOneAtItsTop) {
  const render::FrameState state = frame({.material = 0, .tip = {.z_m = 4e-9}});
  const auto bounds = [&](std::string_view node) {
    const scene::NodeIndex index = scene_.scene().find_node(node).value();
    std::pair<glm::dvec3, glm::dvec3> box{glm::dvec3(1e9), glm::dvec3(-1e9)};
    for (const scene::Primitive& primitive : scene_.scene().meshes[*scene_.scene().nodes[index].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        const glm::dvec3 place(state.room_from_node[index] * glm::dvec4(glm::dvec3(vertex.position), 1.0));
        box = {glm::min(box.first, place), glm::max(box.second, place)};
      }
    }
    return box;
  };
  const auto [line_low, line_high] = bounds("marks/line");
  const double thick = line_high.x - line_low.x;
  ASSERT_GT(line_high.y - line_low.y, 10.0 * thick);
  for (const auto& [tick, end_y] : {std::pair{"marks/low", line_low.y}, {"marks/high", line_high.y}}) {
    const auto [low, high] = bounds(tick);
    EXPECT_NEAR(0.5 * (low.y + high.y), end_y, thick) << tick;
    EXPECT_NEAR(0.5 * (low.x + high.x), 0.5 * (line_low.x + line_high.x), thick) << tick;
    EXPECT_GT(high.x - low.x, 3.0 * thick) << tick;
  }
}

TEST_F(WallSceneTest, AStrokeFillsThreeTenthsOfTheWallsHeight) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const double z_joc = physics::approach_retract_events(materials_.materials[material].contact).z_joc.si;
    const glm::dvec3 high = apex({.material = material, .tip = {.z_m = 1.40 * z_joc}});
    const glm::dvec3 low = apex({.material = material, .tip = {.z_m = -0.30 * z_joc}});
    EXPECT_NEAR(glm::length(high - low), 0.30 * screen_.height_m(), 0.002);
  }
}

TEST_F(WallSceneTest, ShowsOnlyTheSampleOfTheMaterial) {
  const auto visible = [&](const render::FrameState& state, const std::string& name) {
    bool any = false;
    for (std::size_t i = 0; i < scene_.scene().nodes.size(); ++i) {
      const bool below = scene_.scene().nodes[i].name.starts_with("sample-" + name);
      any = any || (below && scene_.scene().nodes[i].mesh && state.visible[i] != 0);
    }
    return any;
  };
  const render::FrameState none = frame({}), gold = frame({.material = 1});
  for (const char* name : {"mica", "gold", "si3n4"}) {
    EXPECT_FALSE(visible(none, name)) << name;
    EXPECT_EQ(visible(gold, name), std::string_view(name) == "gold") << name;
  }
}

TEST_F(WallSceneTest, WhatMustBeReadLiesInTheWallAndOnIt) {
  const render::FrameState state = frame({.material = 0});
  for (const render::PanelPlacement& panel :
       {state.panels.force.placement, state.panels.data.placement, state.panels.banner.placement}) {
    for (const glm::dvec3& corner : {panel.lower_left_m, panel.lower_left_m + panel.right_m + panel.up_m}) {
      EXPECT_NEAR(corner.z, 0.0, 1e-12);
      EXPECT_GE(corner.x, screen_.lower_left.x);
      EXPECT_LE(corner.x, screen_.lower_right.x);
      EXPECT_GE(corner.y, screen_.lower_left.y);
      EXPECT_LE(corner.y, screen_.upper_left.y);
    }
  }
}

TEST_F(WallSceneTest, TheSwatchesAreSoFarApartThatTheRayCannotConfuseThem) {
  const auto targets = scene_.swatch_targets();
  ASSERT_EQ(targets.size(), 3U);
  for (std::size_t aim = 0; aim < targets.size(); ++aim) {
    const glm::dvec3 grip = scene_.places().wand_grip_m();
    const input::Ray ray{.origin_m = grip, .direction = glm::normalize(targets[aim].center_m - grip)};
    EXPECT_EQ(input::pick(ray, input::kPickConeRad, targets), aim);
  }
}

// The floor, which rises in front of the wall, hid the lower half.
TEST_F(WallSceneTest, TheColourScaleOfHeightsIsSeenAboveTheFloor) {
  const render::FrameState shown = frame({});
  const glm::dvec3 foot = origin_of(shown, "height-bar");
  EXPECT_GT(foot.y, origin_of(shown, "room").y);
  const glm::dvec3 on_wall = viewer_ + (foot - viewer_) * viewer_.z / (viewer_.z - foot.z);
  const render::PanelPlacement zero = scene_.places().height_bar_text(0.0);
  EXPECT_NEAR(on_wall.y, zero.lower_left_m.y + 0.5 * zero.up_m.y, 1e-6) << "beside its number";
}

TEST_F(WallSceneTest, AMaterialWithoutModelsIsGreyAndNamedInTheLog) {
  scene::MaterialLibrary strange;
  strange.materials.push_back(materials_.materials[0]);
  strange.materials.back().name = strange.materials.back().look = "graphite";
  testing::internal::CaptureStderr();
  EXPECT_TRUE(WallScene::load(assets_, strange, stage_, test::english()));
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::AllOf(testing::HasSubstr("material graphite"), testing::HasSubstr("sample-graphite.glb")));
}

TEST_F(WallSceneTest, NineMaterialsStandApartAndAllCanBePicked) {
  scene::MaterialLibrary nine;
  for (std::size_t i = 0; i < 9; ++i) {
    nine.materials.push_back(materials_.materials[i % 3]);
    nine.materials.back().name += "-" + std::to_string(i);  // without a model: shows the look's, or the neutral one
    if (i < 6) nine.materials.back().look = materials_.materials[i % 3].name;
  }
  const WallScene many = WallScene::load(assets_, nine, stage_, test::english()).value();
  EXPECT_LE(many.scene().nodes.size(), scene::kMaxNodes) << "what the servo can be told of";
  const auto targets = many.swatch_targets();
  ASSERT_EQ(targets.size(), 9U);
  for (std::size_t aim = 0; aim < targets.size(); ++aim) {
    // rays from the eye, like the mouse's, and from the hand, like the wand's
    for (const glm::dvec3& from : {viewer_, many.places().wand_grip_m()}) {
      const input::Ray ray{.origin_m = from, .direction = glm::normalize(targets[aim].center_m - from)};
      EXPECT_EQ(input::pick(ray, input::kPickConeRad, targets), aim);
    }
  }

  // from the viewer's place, no label covers another on the wall
  render::FrameState state;
  many.update({.material = 0}, state);
  struct Box {
    glm::dvec2 low{1e9}, high{-1e9};
  };
  std::vector<Box> boxes;
  for (const render::Label& label : state.labels) {
    const auto& p = label.placement;
    Box box;
    for (const glm::dvec3& corner :
         {p.lower_left_m, p.lower_left_m + p.right_m, p.lower_left_m + p.up_m, p.lower_left_m + p.right_m + p.up_m}) {
      const glm::dvec2 seen(viewer_ + (corner - viewer_) * (viewer_.z / (viewer_.z - corner.z)));
      box.low = glm::min(box.low, seen);
      box.high = glm::max(box.high, seen);
    }
    EXPECT_GT(box.low.x, screen_.lower_left.x);
    EXPECT_LT(box.high.x, screen_.lower_right.x);
    EXPECT_GT(box.low.y, screen_.lower_left.y);
    for (const Box& other : boxes) {
      EXPECT_FALSE(box.low.x < other.high.x && other.low.x < box.high.x && box.low.y < other.high.y &&
                   other.low.y < box.high.y);
    }
    boxes.push_back(box);
  }
}

TEST_F(WallSceneTest, TheStrokeFillsTheSameRoomWithOtherParameters) {
  constexpr double kReleaseM = 50e-9;
  const glm::dvec3 high = apex({.material = 0, .tip = {.z_m = 70e-9}, .release_z_m = kReleaseM});
  const glm::dvec3 low = apex({.material = 0, .tip = {.z_m = -15e-9}, .release_z_m = kReleaseM});
  EXPECT_NEAR(glm::length(high - low), 0.30 * screen_.height_m(), 0.002);
}

// Size of a material's drawn sample, and the ruler beside it.
class SampleSize : public WallSceneTest {
 protected:
  curves::SampleModel laid(const WallScene& scene, std::size_t material, const scene::MaterialEntry& entry) const {
    curves::SampleModel model = curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value();
    scene.lay_surface_on(model.parameters, material);
    return model;
  }

  static glm::dvec3 size_of(const WallScene& scene, const std::string& node, const render::FrameState& state) {
    const scene::NodeIndex index = scene.scene().find_node(node).value();
    const glm::dmat3 axes(state.room_from_node[index]);
    glm::dvec3 low(1e9), high(-1e9);
    for (const scene::Primitive& primitive : scene.scene().meshes[*scene.scene().nodes[index].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        low = glm::min(low, glm::dvec3(vertex.position));
        high = glm::max(high, glm::dvec3(vertex.position));
      }
    }
    return {(high.x - low.x) * glm::length(axes[0]), (high.y - low.y) * glm::length(axes[1]),
            (high.z - low.z) * glm::length(axes[2])};
  }

  // Width of the sample, which is felt at the size at which it is drawn.
  double strokes(const WallScene& scene, std::size_t i, const scene::MaterialEntry& entry) const {
    render::FrameState state;
    scene.update({.material = i, .release_z_m = laid(scene, i, entry).scaling.release_z_m()}, state);
    return size_of(scene, "sample-" + entry.name + "/surface", state).x / (0.30 * screen_.height_m());
  }

  // With these parameters, sample and stroke keep their size, the ruler is right, and the tip is on the
  // surface that is felt.
  void expect_drawn_alike(const curves::SampleModel& model, std::size_t material, const std::string& what) {
    const std::string node = "sample-" + materials_.materials[material].name + "/surface";
    const double release_m = model.scaling.release_z_m();
    const glm::dvec3 loaded = size_of(scene_, node, frame({.material = material}));
    const render::FrameState now = frame({.material = material, .release_z_m = release_m});
    EXPECT_LT(glm::length(size_of(scene_, node, now) / loaded - 1.0), 1e-9) << what;
    const double per_m = scene_.drawn_scale(material, release_m).sample_m_per_m;
    EXPECT_NEAR(kStrokeOfZjoc * release_m / per_m, 0.30 * screen_.height_m(), 1e-6) << what;

    const double ruler_m = size_of(scene_, "marks/line", now).z;
    const ScaleBar bar = scale_bar(per_m * scene_.unit_m(), kRulerLongest);
    EXPECT_NEAR(ruler_m, bar.length_m / per_m, 0.05 * ruler_m) << what << ", " << bar.text;
    EXPECT_TRUE(std::any_of(now.labels.begin(), now.labels.end(), [&](const auto& l) { return l.text == bar.text; }));

    const scene::SharedHeightField& field = surface_of(material);
    const auto felt = scene::FeltHeights(field).scaled(scene::surface_scale(model.parameters, release_m));
    const auto surface = scene_.scene().find_node(node).value();
    const auto& drawn = scene_.scene().meshes[*scene_.scene().nodes[surface].mesh].primitives.front().vertices;
    for (std::size_t i = 5; i < drawn.size(); i += 3001) {
      const double x = (static_cast<double>(i % felt.columns) - 0.5 * (felt.columns - 1)) * felt.spacing_m;
      const double y = (static_cast<double>(i / felt.columns) - 0.5 * (felt.rows - 1)) * felt.spacing_m;
      const double z = felt.height_factor * static_cast<double>(felt.height_m[i]);
      const render::FrameState over =
          frame({.material = material, .tip = {}, .surface = {{x, y}, z}, .release_z_m = release_m});
      const glm::dvec3 vertex_m(over.room_from_node[surface] * glm::dvec4(glm::dvec3(drawn[i].position), 1.0));
      EXPECT_LT(glm::distance(origin_of(over, "probe/apex"), vertex_m), 1e-6) << what << ", vertex " << i;
    }
  }
};

TEST_F(SampleSize, IsTheSameForEveryValueOfEveryParameter) {
  using Row = curves::LiveParameters::Row;
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const curves::SampleModel loaded = laid(scene_, material, materials_.materials[material]);
    double least_m = loaded.scaling.release_z_m(), most_m = least_m;
    for (std::size_t row = 0; row < curves::LiveParameters::kRows; ++row) {
      for (const int direction : {1, -1}) {
        curves::LiveParameters now(loaded);
        // an octave a step, as far as the law and the hand allow, or 50 octaves
        for (int steps = 4; steps <= 200; steps += 4) {
          curves::LiveParameters::State state = now.state();
          state.steps[row] = static_cast<Row>(row) == Row::Law ? steps / 4 : direction * steps;
          if (!now.restore(state)) break;
          const double release_m = now.model().scaling.release_z_m();
          least_m = std::min(least_m, release_m);
          most_m = std::max(most_m, release_m);
          expect_drawn_alike(now.model(), material,
                             fmt::format("{}, row {}, {} steps", materials_.materials[material].name, row, steps));
        }
      }
    }
    EXPECT_GT(most_m, 30.0 * least_m) << "parameters that matter";
  }
}

TEST_F(SampleSize, IsTheSameForTheValuesOfASweepWhileADemoRuns) {
  const curves::SampleModel gold = laid(scene_, 1, materials_.materials[1]);
  for (const double stiffness : {0.025, 0.1, 0.4, 1.6}) {
    curves::ContactSetup changed{materials_.materials[1], {}, {}};
    changed.material.contact.spring_constant = physics::Stiffness(stiffness);
    const curves::SampleModel varied = curves::make_sample_model(gold, changed).value();
    EXPECT_EQ(varied.parameters.surface_release_m, gold.parameters.surface_release_m);
    expect_drawn_alike(varied, 1, fmt::format("{} N/m", stiffness));
  }
}

TEST_F(SampleSize, IsTheSameForEveryMaterialOfTheLibrary) {
  const scene::MaterialLibrary all = scene::load_materials(assets_ + "/materials.toml").value();
  const WallScene scene = WallScene::load(assets_, all, stage_, test::english()).value();
  ASSERT_GT(all.materials.size(), 10U);
  for (std::size_t i = 0; i < all.materials.size(); ++i) {
    EXPECT_GE(strokes(scene, i, all.materials[i]), kNarrowestSample - 1e-6) << all.materials[i].name;
    EXPECT_LE(strokes(scene, i, all.materials[i]), kWidestSample + 1e-6) << all.materials[i].name;
  }
}

TEST_F(SampleSize, OfAnOwnModelThatIsTooWideIsDrawnAndFeltSmaller) {
  const UserModels own = load_own_models("", assets_ + "/models/sample-gold.glb", {}).value();
  const WallScene scene = WallScene::load(assets_, materials_, stage_, test::english(), own).value();
  for (const std::size_t i : {0U, 2U}) EXPECT_NEAR(strokes(scene, i, materials_.materials[i]), kWidestSample, 1e-6);
  EXPECT_NEAR(strokes(scene, 1, materials_.materials[1]), 1.70, 0.01) << "with the model's dark line";
}

// Own parameters change nothing of what is drawn or felt.
TEST_F(SampleSize, IsItsOwnForThePapersSamples) {
  for (std::size_t i = 0; i < materials_.materials.size(); ++i) {
    const curves::SampleModel model = laid(scene_, i, materials_.materials[i]);
    EXPECT_NEAR(scene::surface_scale(model.parameters, model.scaling.release_z_m()), 1.0, 1e-9);
  }
}

TEST_F(WallSceneTest, FitsAWallOfAnySize) {
  const scene::Screen desk{"desk", {-0.3, 0.9, 0.0}, {0.3, 0.9, 0.0}, {-0.3, 1.25, 0.0}};
  const auto small = WallScene::load(assets_, materials_, {.main = desk, .viewer_m = {0.0, 1.2, 0.6}}, test::english());
  ASSERT_TRUE(small.has_value()) << small.error().message;
  EXPECT_NEAR(small->drawn_scale(0).sample_m_per_m / scene_.drawn_scale(0).sample_m_per_m,
              (kRoomBelow + kRoomAbove) / 0.35, 1e-6);
}

TEST_F(WallSceneTest, AMissingModelIsABadInputFileThatIsNamed) {
  const auto missing = WallScene::load("/nowhere", materials_, stage_, test::english());
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(missing.error().message, ::testing::HasSubstr("/nowhere/models/"));
}

}  // namespace wall_scene_test
}  // namespace afm::exhibit
