// SPDX-License-Identifier: Apache-2.0
// Invariant: no frame waits for the law of a lever that taps, and a force that is off stays off until the law is there
#include "app/view/parameter_edits.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "curves/live_parameters.h"
#include "exhibit/panels/parameter_panel.h"
#include "servo/servo_client.h"
#include "support/paper_model.h"
#include "support/samples/tapped_sample.h"

namespace afm::app {
namespace parameter_edits_test {

using exhibit::ChangeState;
using Kind = render::ControlTarget::Kind;

constexpr render::ControlTarget kLargerRadius{Kind::More, 0};
constexpr render::ControlTarget kReset{Kind::Button, static_cast<std::size_t>(exhibit::PanelButton::Reset)};

class TappedEdits : public ::testing::Test {
 protected:
  void SetUp() override {
    scene::SharedModel model = test::paper_model();
    model.material_count = 1;
    model.materials[0] = loaded_.parameters;
    auto started = servo::ServoClient::start(model, 0, {.mode = servo::ServoMode::Thread}, "");
    ASSERT_TRUE(started) << started.error().message;
    servo_ = std::move(*started);
    servo_->choose(0);
    frames_until([&] { return tip().material == 0; });
  }

  const scene::TipState& tip() const { return servo_->tip(); }
  // Frames of a window.
  void frames_until(const std::function<bool()>& done) {
    while (!done()) {
      ASSERT_TRUE(servo_->poll(core::MonotonicClock().now_ns()));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  const curves::SampleModel loaded_ = test::tapped_sample();
  ParameterEdits edits_{std::vector<curves::SampleModel>{loaded_}};
  std::unique_ptr<servo::ServoClient> servo_;
};

TEST_F(TappedEdits, AreBuiltBesideTheFrames) {
  EXPECT_FALSE(edits_.apply(kLargerRadius, 0, *servo_));
  EXPECT_EQ(edits_.of(0).model().tables, loaded_.tables);
  EXPECT_FALSE(edits_.changed(0));
  EXPECT_EQ(edits_.state(0, tip()), ChangeState::Waiting);
  EXPECT_TRUE(edits_.keeps_force_off(tip()));

  std::vector<std::size_t> taken;
  frames_until([&] { return !(taken = edits_.take_built(*servo_)).empty(); });
  EXPECT_EQ(taken, std::vector<std::size_t>{0});
  EXPECT_NE(edits_.of(0).model().tables, loaded_.tables);
  frames_until([&] { return edits_.state(0, tip()) != ChangeState::Waiting || !edits_.keeps_force_off(tip()); });
  EXPECT_EQ(edits_.state(0, tip()), ChangeState::Applied);
  EXPECT_FALSE(edits_.keeps_force_off(tip()));
  std::vector<curves::SampleModel> felt{loaded_};
  EXPECT_TRUE(edits_.take_felt(tip(), felt));
  EXPECT_EQ(felt[0].tables, edits_.of(0).model().tables);
}

TEST_F(TappedEdits, LeaveAForceThatIsOn) {
  scene::TipState running = tip();
  running.servo_state = scene::ServoState::Running;
  edits_.apply(kLargerRadius, 0, *servo_);
  EXPECT_FALSE(edits_.keeps_force_off(running));
  scene::TipState off = running;
  off.servo_state = scene::ServoState::Disarmed;
  EXPECT_TRUE(edits_.keeps_force_off(off));
  EXPECT_TRUE(edits_.keeps_force_off(running));
}

TEST_F(TappedEdits, AreForgottenByAReset) {
  edits_.apply(kLargerRadius, 0, *servo_);
  EXPECT_TRUE(edits_.apply(kReset, 0, *servo_));
  EXPECT_EQ(edits_.state(0, tip()), ChangeState::AsLoaded);
  edits_.apply(kLargerRadius, 0, *servo_);
  frames_until([&] { return !edits_.take_built(*servo_).empty(); });
  EXPECT_EQ(edits_.of(0).state().steps[0], 1);
}

}  // namespace parameter_edits_test
}  // namespace afm::app
