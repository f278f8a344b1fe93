// SPDX-License-Identifier: Apache-2.0
// Invariant: on every wall each panel and label is wholly visible and covers no other
// Invariant: no preset demands more than one degree of disparity
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/vector_relational.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/bench/render_subjects.h"
#include "curves/sample_model.h"
#include "exhibit/frame/comfort_clamp.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/panels/depth_report.h"
#include "exhibit/scenery/stage_place.h"
#include "exhibit/scenery/wall_layout.h"
#include "render/depth_meter.h"
#include "support/pictures.h"
#include "support/places.h"
#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

namespace afm::exhibit {
namespace walls_test {

constexpr std::uint32_t kEyeWidth = 640;
constexpr std::size_t kFrame = 18;

core::Result<Stage> stage_on(const std::string& wall_file) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.wall = wall_file;
  return load_exhibit(files);
}

std::string wall_text(double width_m, double height_m, double bottom_m, double ipd_mm, const glm::dvec3& head_m) {
  return fmt::format(
      "[[screen]]\nname = \"wall\"\nlower_left = [{0}, {2}, 0.0]\nlower_right = [{1}, {2}, 0.0]\n"
      "upper_left = [{0}, {3}, 0.0]\n[[viewer]]\nname = \"one\"\nipd = \"{4} mm\"\nsweet_spot = [{5}, {6}, {7}]\n",
      -0.5 * width_m, 0.5 * width_m, bottom_m, bottom_m + height_m, ipd_mm, head_m.x, head_m.y, head_m.z);
}

// ---- a wall and its models ----

class ModelsOfAWall : public test::VulkanTest {
 protected:
  // The paper's wall times `scale`, with the viewer and his eyes.
  render::Image left_eye_before(double scale) {
    const std::string path = folder_.write(
        fmt::format("{}.toml", scale),
        wall_text(3.048 * scale, 2.286 * scale, 0.4 * scale, 63.0 * scale, scale * glm::dvec3(0, 1.65, 2.5)));
    const auto stage = stage_on(path);
    EXPECT_TRUE(stage) << stage.error().message;
    auto subject = app::wall_subject(*stage, kEyeWidth, app::WallMotion::Tip).value();
    render::FrameState& frame = subject.frames[kFrame];
    frame.panels.banner.content.scale.clear();  // scale text, which differs on other walls
    auto renderer = make_renderer(subject.scene, subject.drawing);
    renderer.render(frame);
    return renderer.read_eye(scene::Eye::Left);
  }

  support::ScratchFolder folder_;
};

TEST_F(ModelsOfAWall, ShowWhatItShowsTextsToo) {
  const render::Image large = left_eye_before(1.0);
  for (const double scale : {0.5, 1.4}) {
    const render::Image other = left_eye_before(scale);
    ASSERT_EQ(other.rgba.size(), large.rgba.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < large.rgba.size(); ++i) {
      differing += std::abs(int{large.rgba[i]} - int{other.rgba[i]}) > 8 ? 1U : 0U;
    }
    EXPECT_LE(static_cast<double>(differing), 0.001 * static_cast<double>(large.rgba.size())) << scale;
  }
}

// ---- everything has its place on every wall ----

struct Rectangle {
  glm::dvec2 low{1e300}, high{-1e300};

  void take(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bool overlaps(const Rectangle& other) const {
    return glm::all(glm::lessThan(low, other.high)) && glm::all(glm::lessThan(other.low, high));
  }
};

// Rectangle of a panel as seen on the screen, 0..1 each way.
Rectangle seen(const render::PanelPlacement& panel, const scene::EyeView& eye) {
  Rectangle rectangle;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      const glm::dvec3 corner = panel.lower_left_m + x * panel.right_m + y * panel.up_m;
      const glm::dvec4 clip = eye.projection * eye.view * glm::dvec4(corner, 1.0);
      rectangle.take(0.5 * (glm::dvec2(clip) / clip.w + 1.0));
    }
  }
  return rectangle;
}

// An object that must be readable, and the screen of the stage on which it is seen.
struct Place {
  std::string name, screen;
  Rectangle rectangle;
};

Place place_of(const std::string& name, const render::PanelPlacement& panel, const Stage& stage) {
  const StagePlace screens = stage_place(stage.wall);
  const scene::Viewer& viewer = stage.wall.viewers.front();
  const scene::Screen* on = &screens.main;
  for (const auto* side : {&screens.left, &screens.right}) {
    if (!*side) continue;
    const double before_m = glm::dot(panel.lower_left_m - (*side)->lower_left, (*side)->normal());
    if (std::abs(before_m) < 1e-9 && std::abs(glm::dot(panel.right_m, (*side)->normal())) < 1e-9) on = &**side;
  }
  const auto eyes = eyes_before(*on, viewer.sweet_spot, viewer.ipd_m).value();
  return {name, on->name, seen(panel, eyes[0])};
}

// The plate with the word of a jump is wholly seen, and no eye sees it over a panel.
void expect_word_off_the_panels(const Stage& stage, const std::string& what) {
  const StagePlace screens = stage_place(stage.wall);
  const scene::Viewer& viewer = stage.wall.viewers.front();
  const bool on_main = !screens.left;  // panels on other screens, or all on the main one
  for (const auto kind : {physics::EventKind::JumpToContact, physics::EventKind::JumpOffContact}) {
    render::FrameState frame;
    stage.wall_scene.update({.material = 0, .cue = JumpCue{.kind = kind, .force_n = -1e-9F, .age_s = 0.5}}, frame);
    const render::PanelPlacement& plate = frame.labels.back().placement;
    EXPECT_GT(glm::length(plate.right_m), 0.8 * kCueWidth * stage.wall_scene.places().unit_m()) << what;
    const auto eyes = eyes_before(screens.main, viewer.sweet_spot, viewer.ipd_m).value();
    for (const scene::EyeView& eye : eyes) {
      const Rectangle word = seen(plate, eye);
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(word.low, glm::dvec2(0.0)))) << what;
      EXPECT_TRUE(glm::all(glm::lessThanEqual(word.high, glm::dvec2(1.0)))) << what;
      const render::FramePanels& panels = frame.panels;
      for (const auto& panel : {panels.banner.placement, panels.force.placement, panels.data.placement}) {
        if (!on_main && panel != panels.banner.placement) continue;
        const Rectangle other = seen(panel, eye);
        EXPECT_FALSE(word.overlaps(other)) << what << ": plate from " << word.low.x << ", panel up to " << other.high.x;
      }
    }
  }
}

void expect_everything_in_its_place(const std::string& wall_file, const std::string& what) {
  const auto stage = stage_on(wall_file);
  ASSERT_TRUE(stage) << what << ": " << stage.error().message;
  const double height = glm::dot(stage->wall_scene.contact_m() - stage->screen.lower_left,
                                 glm::normalize(stage->screen.upper_left - stage->screen.lower_left)) /
                        stage->screen.height_m();
  EXPECT_GE(height, 1.0 / 3.0 - 1e-12) << what;
  EXPECT_LE(height, 2.0 / 3.0 + 1e-12) << what;
  const render::FrameState frame = app::wall_subject(*stage, kEyeWidth, app::WallMotion::Tip).value().frames[kFrame];
  std::vector<Place> places{place_of("banner", frame.panels.banner.placement, *stage),
                            place_of("force", frame.panels.force.placement, *stage),
                            place_of("data", frame.panels.data.placement, *stage),
                            place_of("tab", stage->wall_scene.places().parameter_tab(), *stage)};
  for (const render::Label& label : frame.labels) places.push_back(place_of(label.text, label.placement, *stage));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [name, screen, rectangle] = places[i];
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(rectangle.low, glm::dvec2(0.0)))) << what << ": " << name;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(rectangle.high, glm::dvec2(1.0)))) << what << ": " << name;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(screen == places[j].screen && rectangle.overlaps(places[j].rectangle))
          << what << ": " << name << " and " << places[j].name;
    }
  }
  for (const render::PanelPlacement& panel : {frame.panels.force.placement, frame.panels.data.placement}) {
    const double aspect = glm::length(panel.right_m) / glm::length(panel.up_m);
    EXPECT_LE(aspect, 1.6 + 1e-9) << what;
    EXPECT_GE(aspect, 0.5) << what;
  }
  expect_word_off_the_panels(*stage, what);
}

TEST(EveryWall, HasRoomForAllThatMustBeRead) {
  for (const char* preset : {"powerwall", "two-projectors", "3d-tv", "desk-red-cyan", "tiled-2x2", "blended", "curved",
                             "cave", "floor", "wide", "phone"}) {
    expect_everything_in_its_place(fmt::format("{}/assets/walls/{}.toml", support::source(), preset), preset);
  }
  const support::ScratchFolder folder;
  const auto expect = [&](const char* what, double width_m, double height_m, double bottom_m,
                          const glm::dvec3& head_m) {
    expect_everything_in_its_place(folder.write("wall.toml", wall_text(width_m, height_m, bottom_m, 63.0, head_m)),
                                   what);
  };
  expect("upright", 1.2, 2.1, 0.1, {0.0, 1.65, 2.0});
  expect("square", 2.0, 2.0, 0.5, {0.3, 1.6, 2.5});
  expect("very wide", 7.0, 2.0, 0.5, {0.0, 1.65, 4.0});
  expect("four metres high", 5.3, 4.0, 0.0, {0.0, 1.65, 4.0});
  expect("seen from below", 3.0, 1.7, 2.0, {0.0, 1.4, 4.0});
  expect("on a table", 0.6, 0.34, 0.0, {0.0, 0.5, 0.6});
}

// Layout z of all vertices of a node's mesh: the least and the largest.
std::pair<double, double> depth_of(const Stage& stage, const render::FrameState& frame, scene::NodeIndex node) {
  const scene::Scene& scene = stage.wall_scene.scene();
  const glm::dmat4 layout_from_node =
      glm::inverse(stage.wall_scene.places().room_from_layout()) * frame.room_from_node[node];
  double least = 1e9, largest = -1e9;
  for (const scene::Primitive& primitive : scene.meshes[scene.nodes[node].mesh.value()].primitives) {
    for (const scene::Vertex& vertex : primitive.vertices) {
      const double z = (layout_from_node * glm::dvec4(glm::dvec3(vertex.position), 1.0)).z;
      least = std::min(least, z);
      largest = std::max(largest, z);
    }
  }
  return {least, largest};
}

// The body fades towards the floor, so that it veils what is inside it.
TEST(EveryWall, ShowsTheWholeSwatchesInFrontOfTheStagesBody) {
  for (const char* preset : {"powerwall", "3d-tv", "desk-red-cyan", "cave", "wide", "phone"}) {
    const auto stage = stage_on(fmt::format("{}/assets/walls/{}.toml", support::source(), preset));
    ASSERT_TRUE(stage) << stage.error().message;
    const scene::Scene& scene = stage->wall_scene.scene();
    for (std::size_t material = 0; material < stage->materials.materials.size(); ++material) {
      render::FrameState frame;
      stage->wall_scene.update({.material = material}, frame);
      const double body_front = depth_of(*stage, frame, scene.find_node("stage/body").value()).second;
      for (const scene::MaterialEntry& each : stage->materials.materials) {
        const auto swatch = scene.find_node("swatch-" + each.name + "/swatch");
        ASSERT_TRUE(swatch) << each.name;
        EXPECT_LE(body_front, depth_of(*stage, frame, *swatch).first + 1e-6)
            << preset << ": swatch of " << each.name << ", sample of material " << material;
      }
    }
  }
}

// True if the swatch is seen in front of a part of that panel.
bool covers(const Stage& stage, const render::FrameState& frame, const std::string& swatch, const Rectangle& panel,
            const scene::EyeView& eye) {
  constexpr int kSteps = 6;
  const scene::Scene& scene = stage.wall_scene.scene();
  const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  for (scene::NodeIndex node = 0; node < scene.nodes.size(); ++node) {
    if (!scene.nodes[node].mesh || !scene.nodes[node].name.starts_with(swatch + "/")) continue;
    for (const scene::Primitive& primitive : scene.meshes[*scene.nodes[node].mesh].primitives) {
      for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::array<glm::dvec2, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec3 vertex(primitive.vertices[primitive.indices[i + k]].position);
          const glm::dvec4 clip = eye.projection * eye.view * frame.room_from_node[node] * glm::dvec4(vertex, 1.0);
          corners[k] = 0.5 * (glm::dvec2(clip) / clip.w + 1.0);
        }
        for (int step = 0; step < kSteps * kSteps; ++step) {
          const glm::dvec2 share = glm::dvec2(step % kSteps, step / kSteps) / (kSteps - 1.0);
          const glm::dvec2 point = glm::mix(panel.low, panel.high, share);
          int left = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            left += cross(corners[(k + 1) % 3] - corners[k], point - corners[k]) > 0.0 ? 1 : -1;
          }
          if (std::abs(left) == 3) return true;
        }
      }
    }
  }
  return false;
}

// The image of a scan is beside the curve, and no panel leaves the wall or covers another.
TEST(EveryWall, HasTwoMorePlacesIfItIsWide) {
  const auto stage = stage_on(support::source("assets/walls/wide.toml")).value();
  const WallPlaces& wall = stage.wall_scene.places();
  ASSERT_TRUE(wall.far());
  render::FrameState frame;
  wall.place_panels({.material = 0, .scan = true}, frame);
  EXPECT_EQ(frame.panels.image.placement, wall.far()->left);
  const std::array places{
      place_of("far left", wall.far()->left, stage), place_of("force", frame.panels.force.placement, stage),
      place_of("data", frame.panels.data.placement, stage), place_of("far right", wall.far()->right, stage)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_GE(places[i].rectangle.low.x, i == 0 ? 0.0 : places[i - 1].rectangle.high.x) << places[i].name;
    EXPECT_LE(places[i].rectangle.high.x, 1.0) << places[i].name;
  }
}

// On a floor, parts that lean towards the viewer are seen higher on the screen.
TEST(EveryWall, ShowsLaserAndPhotodiodeBelowTheBanner) {
  for (const char* preset : {"powerwall", "3d-tv", "desk-red-cyan", "floor", "wide"}) {
    const auto stage = stage_on(fmt::format("{}/assets/walls/{}.toml", support::source(), preset)).value();
    const render::FrameState frame = app::wall_subject(stage, kEyeWidth, app::WallMotion::Tip).value().frames[kFrame];
    const Rectangle banner = seen(frame.panels.banner.placement, frame.eyes[0]);
    for (const glm::dvec3& part : {kLaser, kPhotodiode}) {
      const glm::dvec4 clip = frame.eyes[0].projection * frame.eyes[0].view *
                              stage.wall_scene.places().room_from_layout() * glm::dvec4(part, 1.0);
      EXPECT_GT(0.5 * (clip.y / clip.w + 1.0), banner.high.y) << preset;  // y down
    }
  }
}

TEST(EveryWall, ShowsTheColourScaleBesideTheSwatches) {
  const std::vector<std::string> names{"mica", "gold", "si3n4", "silica-air", "mica-air"};
  for (const char* preset : {"powerwall", "two-projectors", "3d-tv", "desk-red-cyan", "wide"}) {
    for (const std::size_t count : {3U, 4U, 5U}) {
      ExhibitFiles files;
      files.assets_dir = support::source("assets");
      files.wall = fmt::format("{}/walls/{}.toml", files.assets_dir, preset);
      files.shown.assign(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count));
      const auto stage = load_exhibit(files);
      ASSERT_TRUE(stage) << stage.error().message;
      render::FrameState frame;
      stage->wall_scene.update({.material = 0}, frame);
      const WallPlaces& places = stage->wall_scene.places();
      const auto bar = places.in_wall(places.height_bar_x(), kHeightBarBottom, kHeightBarWidth, kHeightBarHeight);
      const scene::Viewer& viewer = stage->wall.viewers.front();
      const auto eyes = eyes_before(stage_place(stage->wall).main, viewer.sweet_spot, viewer.ipd_m).value();
      for (const scene::EyeView& eye : eyes) {
        std::vector<render::PanelPlacement> read{places.height_bar_text(0.0), places.height_bar_text(0.5),
                                                 places.height_bar_text(1.0)};
        // five swatches leave no room for all of the bar on the powerwall: its foot is behind one
        if (count < 5) read.push_back(bar);
        for (const render::PanelPlacement& panel : read) {
          const Rectangle rectangle = seen(panel, eye);
          EXPECT_TRUE(glm::all(glm::greaterThanEqual(rectangle.low, glm::dvec2(0.0)))) << preset << ", " << count;
          for (const std::string& name : files.shown) {
            EXPECT_FALSE(covers(*stage, frame, "swatch-" + name, rectangle, eye))
                << preset << ", " << count << " swatches: that of " << name << " covers x " << rectangle.low.x << " to "
                << rectangle.high.x;
          }
        }
      }
    }
  }
}

// ---- no default scene asks more of the eyes than one degree ----

class DepthOfAWall : public test::VulkanTest {
 protected:
  // The nearest and the farthest thing of every state that a session goes through without the scene being moved.
  render::DepthRange range_on(const Stage& stage) {
    std::vector<curves::SampleModel> materials;
    for (const scene::MaterialEntry& entry : stage.materials.materials) {
      materials.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
    }
    const FrameBuilder frames(stage.wall_scene, materials, stage.eyes);
    auto renderer = make_renderer(stage.wall_scene.scene(), stage.renderer_options(160));
    render::DepthMeter meter(context_, renderer);
    render::DepthRange whole{1e9, 0.0};
    for (const double lift : {-0.3, 1.4}) {
      const glm::dvec3 grip = stage.wall_scene.places().wand_grip_m();
      const glm::dvec3 target = stage.wall_scene.swatch_targets().front().center_m;
      Moment moment;
      input::WandState wand;
      wand.connected = wand.position_valid = wand.orientation_valid = true;
      wand.position_m = grip;
      wand.room_from_wand = glm::rotation(glm::dvec3(0.0, 0.0, -1.0), glm::normalize(target - grip));
      moment.wall = {.material = 1, .tip = {.z_m = lift * materials[1].scaling.release_z_m()}, .wand = wand};
      renderer.render(frames.build(moment));
      meter.measure();
      meter.wait();
      const render::DepthRange range = meter.newest().value();
      whole = {std::min(whole.nearest_m, range.nearest_m), std::max(whole.farthest_m, range.farthest_m)};
    }
    return whole;
  }
};

// Objects in front of the wall are placed within the limit. Those far behind a small screen are left to the comfort
// clamp of the live window, which must then never warn.
TEST_F(DepthOfAWall, StaysWithinOneDegreeOnEveryPreset) {
  for (const char* preset : {"powerwall", "3d-tv", "desk-red-cyan", "cave", "wide"}) {
    const auto stage = stage_on(fmt::format("{}/assets/walls/{}.toml", support::source(), preset));
    ASSERT_TRUE(stage) << stage.error().message;
    const scene::Viewer& viewer = stage->wall.viewers.front();
    const double distance_m = glm::dot(viewer.sweet_spot.position_m - stage->screen.lower_left, stage->screen.normal());
    const render::DepthRange range = range_on(*stage);
    const DepthReport as_it_is = report_depth(range, distance_m, viewer.ipd_m, Relief::NarrowEyes);
    const bool small = std::string_view(preset) == "desk-red-cyan" || std::string_view(preset) == "cave";
    EXPECT_EQ(as_it_is.hard, small) << preset << ": " << depth_text(as_it_is, stage->phrases());
    ComfortClamp clamp(scene::kComfortableDisparityRad);
    clamp.measured(range, distance_m, viewer.ipd_m);
    clamp.ipd_m(viewer.ipd_m, 1);
    const double ipd_m = clamp.ipd_m(viewer.ipd_m, 10'000'000'000);
    EXPECT_GT(ipd_m, 0.4 * viewer.ipd_m) << preset << ": hardly any depth is left";
    const DepthReport report = report_depth(range, distance_m, ipd_m, Relief::NarrowEyes);
    EXPECT_FALSE(report.hard) << preset << ": " << depth_text(report, stage->phrases());
  }
}

}  // namespace walls_test
}  // namespace afm::exhibit
