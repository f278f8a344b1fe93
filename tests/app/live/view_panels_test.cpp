// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_panels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/live/view_keys.h"
#include "cluster/frame_message.h"
#include "core/enumerators.h"
#include "curves/sample_model.h"
#include "exhibit/frame/calibration.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/friction/friction_history.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"
#include "support/particles/particle_sets.h"
#include "support/places.h"

namespace afm::app {
namespace view_panels_test {

class PanelsOfTheView : public ::testing::Test {
 protected:
  void SetUp() override { load(""); }

  void load(const std::string& wall) {
    exhibit::ExhibitFiles files;
    files.assets_dir = support::source("assets");
    files.wall = wall;
    models_.clear();
    auto stage = exhibit::load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    stage_.emplace(std::move(*stage));
    for (const scene::MaterialEntry& entry : stage_->materials.materials) {
      models_.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
    }
    panels_.emplace(stage_->wall_scene, models_, key_list);
    panels_->set_friction(&friction_);
  }

  // A frame with a sample under the tip, and with all panels.
  render::FrameState frame(const std::string& caption) {
    const exhibit::FrameBuilder frames(stage_->wall_scene, models_, stage_->eyes);
    exhibit::Moment moment;
    moment.wall.material = 0;
    scene::TipState tip;
    tip.material = 0;
    render::FrameState frame = frames.build(moment);
    add_panels(*stage_, *panels_, moment, {.pointed = {}, .hand = HandSource::Mouse, .tip = tip}, caption, frame);
    return frame;
  }
  bool shows(const render::FrameState& frame, const std::string& text) const {
    return std::any_of(frame.labels.begin(), frame.labels.end(),
                       [&](const render::Label& label) { return label.text.find(text) != std::string::npos; });
  }
  // The ray of a viewer who points at the middle of a panel.
  Pointed pointed_at(const render::PanelPlacement& place) {
    const glm::dvec3 middle_m = place.lower_left_m + 0.5 * (place.right_m + place.up_m);
    const glm::dvec3 eye_m = stage_->wall.viewers.front().sweet_spot.position_m;
    return panels_->pointed_at({.origin_m = eye_m, .direction = glm::normalize(middle_m - eye_m)}, middle_m, 0);
  }

  // Expects a record with one changed field to be followed.
  void expect_followed(std::string_view name, std::uint32_t value) {
    cluster::ShownPanels sent{.flags = cluster::ShownPanels::kControl};
    for_each_field(
        [&](std::string_view part, std::uint32_t& field) {
          if (part == name) field = value;
        },
        sent);
    const ViewPanels::Told told = panels_->follow(sent);
    const cluster::ShownPanels came = panels_->told(told.pointed, told.hand);
    for_each_field(
        [&](std::string_view part, auto is, auto was) { EXPECT_EQ(is, was) << part << ", after a change of " << name; },
        came, sent);
  }

  std::optional<exhibit::Stage> stage_;
  std::vector<curves::SampleModel> models_;
  exhibit::FrictionHistory friction_;
  std::optional<ViewPanels> panels_;
};

TEST_F(PanelsOfTheView, FollowWhatAnotherMachineHasSent) {
  const cluster::ShownPanels panels;
  for_each_field([&](const char* name, std::uint32_t) { expect_followed(name, 1); }, panels);
  for (std::uint32_t flag = 1; flag <= cluster::ShownPanels::kAllFlags; flag *= 2) {
    expect_followed("flags", flag | cluster::ShownPanels::kControl);
  }
}

TEST_F(PanelsOfTheView, ShowTheDataInThePlaceOfAnUnknownPanel) {
  panels_->follow({.right = cluster::ShownPanels::kMostRight - 1});
  EXPECT_EQ(panels_->shown(), "samples");
}

TEST_F(PanelsOfTheView, ComeBackByTheWordOfASession) {
  for (const char* const word : {"samples", "parameters", "friction-loop", "sources", "keys", "none"}) {
    panels_->show(word);
    EXPECT_EQ(panels_->shown(), word);
  }
}

TEST_F(PanelsOfTheView, AreHiddenWithTheirButtonsAndTheNote) {
  const exhibit::Phrases& phrases = stage_->phrases();
  const std::string tab = phrases[exhibit::Phrase::ChangeParameters], note = phrases[exhibit::Phrase::AllKeys];
  for (const std::string& caption : {std::string(), std::string("Snap-in")}) {
    panels_->show("samples");
    EXPECT_TRUE(shows(frame(caption), tab));
    EXPECT_TRUE(shows(frame(caption), caption.empty() ? note : caption));
    EXPECT_TRUE(pointed_at(stage_->wall_scene.places().parameter_tab()).tab);
    panels_->toggle_all();
    const render::FrameState hidden = frame(caption);
    EXPECT_FALSE(shows(hidden, tab));
    EXPECT_FALSE(shows(hidden, caption.empty() ? note : caption));
    EXPECT_EQ(hidden.labels.size(), stage_->materials.materials.size() + 1)
        << "the swatches' names, the ruler's number";
    EXPECT_EQ(hidden.panels.force.placement, render::kNoPlacement);
    EXPECT_NE(hidden.panels.banner.placement, render::kNoPlacement) << "whether a force is on is always to be seen";
    EXPECT_FALSE(pointed_at(stage_->wall_scene.places().parameter_tab()).tab) << "nobody clicks what is hidden";
  }
}

// A panel that replaces the data elsewhere is beside them, in the place of their sources.
TEST_F(PanelsOfTheView, UseTheFarEndOfAWideWall) {
  EXPECT_FALSE(stage_->wall_scene.places().far());
  load(support::source("assets/walls/wide.toml"));
  ASSERT_TRUE(stage_->wall_scene.places().far());
  const render::PanelPlacement far = stage_->wall_scene.places().far()->right;
  const render::FrameState idle = frame("");
  const render::PanelPlacement data = idle.panels.data.placement;
  EXPECT_NE(data, render::kNoPlacement);
  EXPECT_EQ(idle.panels.particles.placement, far);
  EXPECT_TRUE(idle.panels.particles.content.details);
  EXPECT_EQ(idle.panels.particles.content.title, idle.panels.data.content.title);
  panels_->show("parameters");
  const render::FrameState open = frame("");
  EXPECT_EQ(open.panels.data.placement, data);
  EXPECT_EQ(open.panels.control.placement, far);
  EXPECT_EQ(open.panels.particles.placement, render::kNoPlacement);
  panels_->toggle_all();
  EXPECT_EQ(frame("").panels.control.placement, render::kNoPlacement);
}

TEST_F(PanelsOfTheView, ShowThePushInThePlaceOfTheData) {
  const scene::ParticleSet set = test::particle_set("gold-row");
  const exhibit::ParticlesNow particles{.set = &set};
  const exhibit::FrameBuilder frames(stage_->wall_scene, models_, stage_->eyes);
  exhibit::Moment moment;
  moment.wall.material = 0;
  const render::PanelPlacement place = frames.build(moment).panels.data.placement;
  moment.wall.particles = &particles;
  scene::TipState tip;
  tip.material = 0;
  for (const bool parameters : {false, true}) {
    if (parameters) panels_->toggle_parameters();
    render::FrameState shown = frames.build(moment);
    add_panels(*stage_, *panels_, moment, {.pointed = {}, .hand = HandSource::Mouse, .tip = tip}, "", shown);
    EXPECT_EQ(shown.panels.particles.placement, parameters ? render::kNoPlacement : place);
    EXPECT_EQ(shown.panels.data.placement, render::kNoPlacement);
    EXPECT_EQ(shown.panels.particles.content.title, "Five gold spheres on mica");
  }
}

// Sources of the sample's data, and of the particles, on request; a lesson, which could be about them, never shows
// them.
TEST_F(PanelsOfTheView, ShowTheSourcesOnRequest) {
  const auto shown = [&] {
    const render::FramePanels panels = frame("").panels;
    EXPECT_NE(panels.data.placement, render::kNoPlacement);
    EXPECT_EQ(panels.data.content.details, panels.particles.content.details);
    return panels.data.content.details;
  };
  EXPECT_FALSE(frame("").panels.data.content.details);
  panels_->toggle_sources();
  EXPECT_TRUE(shown());
  panels_->use_for(WallUse::Lesson);
  EXPECT_FALSE(frame("").panels.data.content.details);
  panels_->use_for(WallUse::Free);
  panels_->toggle_parameters();
  panels_->toggle_sources();
  EXPECT_TRUE(shown());
  panels_->toggle_sources();
  EXPECT_FALSE(frame("").panels.data.content.details);
}

TEST_F(PanelsOfTheView, MakeRoomForTheListOfKeys) {
  panels_->toggle_keys();
  const render::FrameState listed = frame("");
  EXPECT_GT(listed.panels.keys.content.list.rows.size(), 20U);
  EXPECT_EQ(listed.panels.keys.placement, stage_->wall_scene.places().keys());
  for (const auto& placement :
       {listed.panels.force.placement, listed.panels.data.placement, listed.panels.control.placement}) {
    EXPECT_EQ(placement, render::kNoPlacement);
  }
  EXPECT_NE(listed.panels.banner.placement, render::kNoPlacement);
  for (const input::Target& swatch : stage_->wall_scene.swatch_targets()) {
    const glm::dvec3 eye_m = stage_->wall.viewers.front().sweet_spot.position_m;
    EXPECT_FALSE(
        panels_->pointed_at({.origin_m = eye_m, .direction = glm::normalize(swatch.center_m - eye_m)}, {}, 0).swatch);
  }
  EXPECT_TRUE(panels_->close_keys());
  EXPECT_FALSE(panels_->close_keys());
  EXPECT_EQ(frame("").panels.keys.placement, render::kNoPlacement);
}

// A slot that is never filled or placed is listed here.
TEST_F(PanelsOfTheView, FillEverySlotOfAFrameSomewhere) {
  const exhibit::FrameBuilder frames(stage_->wall_scene, models_, stage_->eyes);
  const exhibit::LiveScan scan(exhibit::scan_subject(stage_->wall_scene, 0, models_.front()));
  std::array<bool, core::kMembers<render::FramePanels>> seen{};
  const auto look = [&](const render::FrameState& frame) {
    std::size_t slot_number = 0;
    core::for_each_member(
        [&](const auto& slot) {
          const bool filled = !(slot.content == std::remove_cvref_t<decltype(slot.content)>());
          seen[slot_number++] |= filled && slot.placement != render::kNoPlacement;
        },
        frame.panels);
  };
  const scene::ParticleSet set = test::particle_set("gold-row");
  const exhibit::ParticlesNow particles{.set = &set};
  for (const bool scanning : {false, true}) {
    for (const RightPanel right : core::kEnumerators<RightPanel>) {
      exhibit::Moment moment;
      moment.wall.material = 0;
      if (scanning) exhibit::show_scan(scan, moment);
      if (scanning) moment.wall.particles = &particles;
      scene::TipState tip;
      tip.material = 0;
      render::FrameState frame = frames.build(moment);
      panels_->follow({.right = static_cast<std::uint32_t>(right)});
      add_panels(*stage_, *panels_, moment, {.pointed = {}, .hand = HandSource::Mouse, .tip = tip}, "", frame);
      look(frame);
    }
  }
  render::FrameState calibration;
  exhibit::show_calibration(stage_->screen, scene::StereoMode::Mono, 0.063, stage_->phrases(), calibration);
  look(calibration);
  panels_->toggle_keys();
  look(frame(""));
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_TRUE(seen[i]) << "slot " << i << " of render::FramePanels";
}

}  // namespace view_panels_test
}  // namespace afm::app
