// SPDX-License-Identifier: Apache-2.0
// Invariant: a steady frame allocates nothing
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/no_alloc.h"
#include "support/vulkan_fixture.h"

// Frames after everything has reached its largest size. No validation layers: they allocate in the caller's thread.
namespace afm::test {
namespace frame_allocation_test {

render::Context open_context() {
  auto context = render::Context::open();
  if (!context) throw std::runtime_error(context.error().message);
  return std::move(*context);
}

class FrameAllocation : public testing::Test {
 protected:
  // Everything that moves in a frame moves, so that things come into sight, pass each other and are chosen.
  std::vector<render::FrameState> moving_frames() const {
    std::vector<render::FrameState> frames;
    for (int i = 0; i < 12; ++i) {
      render::FrameState frame = full_frame(test_);
      const double turn = 0.4 * i;
      frame.room_from_node[test_.mica][3].x += 3.0 * std::sin(turn);
      frame.room_from_node[test_.gold][3].z += std::cos(turn);
      frame.bends.front().end_deflection = 0.01F * static_cast<float>(i);
      frame.visible.assign(test_.scene.nodes.size(), 1);
      frame.visible[test_.beam] = i % 3 == 0 ? 0 : 1;
      frame.highlighted = {i % 2 == 0 ? test_.mica : test_.nitride};
      frames.push_back(std::move(frame));
    }
    return frames;
  }

  // A cycle is felt: its curve grows by some samples a frame, the cursor follows, numbers, words and colours change,
  // and something else is pointed at.
  std::vector<render::FrameState> telling_frames() const {
    std::vector<render::FrameState> frames = moving_frames();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      render::FrameState& frame = frames[i];
      render::PlotCurve& curve = frame.panels.force.content.curves.front();
      auto& branch = 2 * i < frames.size() ? curve.approach : curve.retract;
      curve.retract.clear();
      curve.approach.clear();
      for (std::size_t k = 0; k < 200 * (i + 1); ++k) {
        const double z_nm = 20.0 - 0.01 * static_cast<double>(k);
        branch.push_back({z_nm, std::sin(z_nm)});
      }
      const std::string number = std::to_string(1000 + 37 * i);
      frame.panels.force.content.cursor = branch.back();
      frame.panels.force.content.stage =
          "pressed, at " + number + " of what a hand may push, and longer than the panel is wide";
      frame.panels.force.content.markers = {{render::PlotMarker::Kind::VerticalLine, 2.4, "Z_jtc " + number + " nm"},
                                            {render::PlotMarker::Kind::HorizontalLine, -1.4, "F_ad " + number + " nN"}};
      for (render::DataRow& row : frame.panels.data.content.rows) row.value = number + " nN/m, by another hand";
      frame.panels.banner.content.guidance =
          "Move down, " + number + " nm are left until the tip snaps onto the surface";
      frame.panels.banner.content.state_shape = static_cast<render::StateShape>(i % 5);
      frame.panels.control.content = {.title = "Parameters of a sample with a rather long name",
                                      .buttons = {"Apply"},
                                      .rows = {{"spring constant", number + " N/m", i % 2 == 0}},
                                      .notes = {"what follows from " + number},
                                      .status = "felt since " + number,
                                      .pointed = {},
                                      .marked = {},
                                      .picture = {}};
      if (i % 3 == 0) frame.panels.control.content.pointed = render::ControlTarget{};
      frame.panels.control.placement = frame.panels.data.placement;
      for (render::Label& label : frame.labels) label.highlighted = i % 2 == 0;
    }
    return frames;
  }

  void expect_none(const std::vector<render::FrameState>& frames, render::PassMode pass_mode) {
    auto context = open_context();
    auto renderer = render::Renderer::create(context, test_.scene, small(4, pass_mode));
    ASSERT_TRUE(renderer) << renderer.error().message;
    for (int turn = 0; turn < 2; ++turn) {
      for (const auto& frame : frames) renderer->render(frame);
    }
    for (const auto& frame : frames) {
      const NoAllocation no_allocation;
      renderer->render(frame);
    }
    renderer->wait();
  }

  TestScene test_ = make_test_scene();
};

TEST_F(FrameAllocation, AMovingSceneIsDrawnWithoutAny) { expect_none(moving_frames(), render::PassMode::Multiview); }

TEST_F(FrameAllocation, EyeByEyeTakesNoneEither) { expect_none(moving_frames(), render::PassMode::TwoPasses); }

TEST_F(FrameAllocation, PanelsThatChangeInEveryFrameTakeNone) {
  expect_none(telling_frames(), render::PassMode::Multiview);
}

// Resolution and samples change while it runs.
TEST_F(FrameAllocation, AChangeOfDetailTakesNone) {
  auto context = open_context();
  auto renderer = render::Renderer::create(context, test_.scene, small());
  ASSERT_TRUE(renderer) << renderer.error().message;
  const auto frames = moving_frames();
  const std::vector<render::FrameQuality> qualities{{1.0, 4}, {0.84, 4}, {0.5, 4}, {0.5, 1}};
  const auto draw_all = [&] {
    for (const auto& quality : qualities) {
      renderer->set_quality(quality);
      for (const auto& frame : frames) renderer->render(frame);
    }
  };
  draw_all();
  draw_all();
  const NoAllocation no_allocation;
  draw_all();
}

}  // namespace frame_allocation_test
}  // namespace afm::test
