// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_panels.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
#include "support/places.h"

namespace afm::app {
namespace view_panels_test {

class PanelsOfTheView : public ::testing::Test {
 protected:
  void SetUp() override {
    exhibit::ExhibitFiles files;
    files.assets_dir = support::source("assets");
    auto stage = exhibit::load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    stage_.emplace(std::move(*stage));
    for (const scene::MaterialEntry& entry : stage_->materials.materials) {
      models_.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
    }
    panels_.emplace(stage_->wall_scene, models_, key_list);
    panels_->set_friction(&friction_);
  }

  // With one field of what is sent set.
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

TEST_F(PanelsOfTheView, FollowWhatAnotherMachineHasTold) {
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
  for (const char* const word : {"samples", "parameters", "friction-loop", "keys", "none"}) {
    panels_->show(word);
    EXPECT_EQ(panels_->shown(), word);
  }
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
  for (const bool scanning : {false, true}) {
    for (const RightPanel right : core::kEnumerators<RightPanel>) {
      exhibit::Moment moment;
      moment.wall.material = 0;
      if (scanning) exhibit::show_scan(scan, moment);
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
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_TRUE(seen[i]) << "slot " << i << " of render::FramePanels";
}

}  // namespace view_panels_test
}  // namespace afm::app
