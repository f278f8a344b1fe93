// SPDX-License-Identifier: Apache-2.0
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "physics/manipulation/half_turn.h"
#include "render/renderer.h"
#include "servo/live_picture.h"
#include "support/particles/particle_sets.h"
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

// Gold spheres on the paper's wall, as a person sees them.
namespace afm::exhibit {
namespace particle_pictures_test {

class ParticlePictures : public test::VulkanTest {
 protected:
  void SetUp() override { use("gold-row"); }

  void use(const std::string& set) {
    ExhibitFiles files;
    files.assets_dir = support::source("assets");
    files.particles = set;
    felt_.clear();
    auto stage = load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    stage_.emplace(std::move(*stage));
    for (const scene::MaterialEntry& entry : stage_->materials.materials) {
      felt_.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
    }
    pages_ = test::start_pages(*stage_->particles);
  }

  render::FrameState frame(const scene::TipPush& push, const servo::PictureNow* picture = nullptr) const {
    const ParticlesNow now{.set = &*stage_->particles, .pages = pages_, .push = push, .picture = picture};
    Moment moment;
    moment.wall.material = 0;
    moment.wall.particles = &now;
    moment.servo_state = scene::ServoState::Running;
    moment.realtime = true;
    return FrameBuilder(stage_->wall_scene, felt_, stage_->eyes).build(moment);
  }

  // A frame each in which a sphere is measured, computed and stale.
  template <class Drawn>
  void draw_each_knowledge(render::Renderer& renderer, const Drawn& drawn) const {
    const scene::TipPush push = test::push_of(*stage_->particles, 1, physics::PushState::Free);
    for (const servo::Known known : {servo::Known::Measured, servo::Known::Computed, servo::Known::Stale}) {
      servo::PictureNow picture{.level = 2, .known = std::vector(stage_->particles->particles.size(), servo::Known{})};
      picture.known[2] = known;
      renderer.render(frame(push, &picture));
      drawn();
    }
  }

  std::optional<Stage> stage_;
  std::vector<curves::SampleModel> felt_;
  std::vector<scene::ParticlePage> pages_;
};

TEST_F(ParticlePictures, ShowWhichSphereIsTouchedAndHowItLies) {
  const scene::TipPush push = test::push_of(*stage_->particles, 1, physics::PushState::Slides);
  const auto options = stage_->renderer_options(1280);
  auto renderer = make_renderer(stage_->wall_scene.scene(), options);
  const auto eye = [&](const render::FrameState& shown) {
    renderer.render(shown);
    return renderer.read_eye(scene::Eye::Left);
  };
  const render::Image touched = eye(frame(push));
  scene::TipPush other = push;
  other.particle = 2;
  EXPECT_GT(test::difference(eye(frame(other)), touched, 24).share_beyond, 2e-4) << "another one is touched";
  const glm::dquat turn = glm::angleAxis(1.0, glm::dvec3(0.0, 1.0, 0.0));
  pages_[0].poses[1].orientation = {turn.w, turn.x, turn.y, turn.z};
  EXPECT_GT(test::difference(eye(frame(push)), touched, 24).share_beyond, 5e-5) << "it has rolled";
}

TEST_F(ParticlePictures, ShowHowAnIslandHasTurned) {
  use("islands");
  const scene::TipPush push = test::push_of(*stage_->particles, 1, physics::PushState::Slides);
  auto renderer = make_renderer(stage_->wall_scene.scene(), stage_->renderer_options(1280));
  renderer.render(frame(push));
  const render::Image before = renderer.read_eye(scene::Eye::Left);
  scene::set_turn(pages_[0].poses[1], physics::half_turn(1.0));
  renderer.render(frame(push));
  EXPECT_GT(test::difference(renderer.read_eye(scene::Eye::Left), before, 24).share_beyond, 5e-5);
}

TEST_F(ParticlePictures, AreRedrawnWhereASphereMovesAndAsIfAllWere) {
  auto options = stage_->renderer_options(960);
  auto changes = make_renderer(stage_->wall_scene.scene(), options);
  options.redraw = render::Redraw::Everything;
  auto everything = make_renderer(stage_->wall_scene.scene(), options);
  scene::TipPush push = test::push_of(*stage_->particles, 0, physics::PushState::Slides);
  double redrawn = 0.0;
  constexpr int kFrames = 8;
  for (int i = 0; i < kFrames; ++i) {
    pages_[0].poses[0].x_m += 4e-9;
    const glm::dquat turn = glm::angleAxis(0.2 * i, glm::dvec3(0.0, 1.0, 0.0));
    pages_[0].poses[0].orientation = {turn.w, turn.x, turn.y, turn.z};
    push.apex_m[0] += 4e-9;
    if (i == 5) push.met = 0;
    const render::FrameState shown = frame(push);
    changes.render(shown);
    everything.render(shown);
    if (i > 0) redrawn += changes.redrawn_share() / (kFrames - 1);
    for (const scene::Eye eye : scene::kEyes) {
      ASSERT_EQ(test::where_differ(changes.read_eye(eye), everything.read_eye(eye)), "") << "frame " << i;
    }
  }
  EXPECT_LT(redrawn, 0.7);
}

// Luminance in place of colour (Rec. 709, of the encoded values).
render::Image grey(render::Image image) {
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const double luminance = 0.2126 * image.rgba[i] + 0.7152 * image.rgba[i + 1] + 0.0722 * image.rgba[i + 2];
    image.rgba[i] = image.rgba[i + 1] = image.rgba[i + 2] = static_cast<std::uint8_t>(luminance);
  }
  return image;
}

// Pictures of one sphere, in grey, that is measured, computed and stale.
void expect_apart(const std::vector<render::Image>& shown, const std::string& text) {
  ASSERT_EQ(shown.size(), 3U) << text;
  for (const auto& [a, b] : {std::pair{0U, 1U}, {0U, 2U}, {1U, 2U}}) {
    const double pixels = static_cast<double>(shown[a].rgba.size()) / 4.0;
    EXPECT_GE(test::difference(shown[a], shown[b], 24).share_beyond * pixels, 4.0) << text << ": " << a << b;
  }
}

// Widths from a small window to the widest that the processor draws.
TEST_F(ParticlePictures, TellMeasuredComputedAndStaleApartWithoutColour) {
  for (const std::uint32_t width_px : {400U, 1280U, 3840U}) {
    auto renderer = make_renderer(stage_->wall_scene.scene(), stage_->renderer_options(width_px));
    std::vector<render::Image> shown;
    draw_each_knowledge(renderer, [&] { shown.push_back(grey(renderer.read_eye(scene::Eye::Left))); });
    expect_apart(shown, std::to_string(width_px));
  }
}

// Pictures of a small window, and of one 7680 pixels wide with both eyes side by side.
TEST_F(ParticlePictures, TellThemApartInEveryStereoMode) {
  for (const std::uint32_t width_px : {400U, 3840U}) {
    auto renderer = make_renderer(stage_->wall_scene.scene(), stage_->renderer_options(width_px));
    std::map<scene::StereoMode, std::vector<render::Image>> shown;
    draw_each_knowledge(renderer, [&] {
      for (const scene::StereoModeTraits& row : scene::kStereoModes) {
        const bool fits = width_px == 400U || row.mode == scene::StereoMode::SideBySide;
        if (!fits || scene::has_two_pictures(row.mode) || scene::frame_packing(row.mode)) continue;
        shown[row.mode].push_back(grey(renderer.read_composed({.mode = row.mode})));
      }
    });
    EXPECT_GE(shown.size(), width_px == 400U ? 12U : 1U);
    for (const auto& [mode, images] : shown) expect_apart(images, std::string(scene::name_of(mode)));
  }
}

}  // namespace particle_pictures_test
}  // namespace afm::exhibit
