// SPDX-License-Identifier: Apache-2.0
#include "exhibit/guidance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "places.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kFolder = std::string(AFM_SOURCE_DIR) + "/assets/guidance/";

// Mica under the tip at this height of the hand.
scene::TipState tip(scene::ServoState state, physics::Phase phase, double hand_height_m) {
  constexpr double kHandMPerM = 0.05 / 14e-9;
  scene::TipState tip;
  tip.material = 0;
  tip.servo_state = state;
  tip.phase = phase;
  tip.active.scale.hand_m_per_m = kHandMPerM;
  tip.tip.z_m = hand_height_m / kHandMPerM;
  tip.active.release_z_m = 0.05 / kHandMPerM;
  return tip;
}

TEST(Guidance, LeadsThroughTheProcedureByWhatHasHappened) {
  using State = scene::ServoState;
  using physics::Phase;
  EXPECT_EQ(next_step({}, false, 0), Hint::ChooseSample);
  EXPECT_EQ(next_step(tip(State::Disarmed, Phase::WaitForLift, 0.03), false, 0), Hint::Lift);
  EXPECT_EQ(next_step(tip(State::Disarmed, Phase::Free, 0.051), true, 0), Hint::Lift);
  EXPECT_EQ(next_step(tip(State::Disarmed, Phase::Free, 0.060), true, 0), Hint::TurnOn);
  EXPECT_EQ(next_step(tip(State::Arming, Phase::Free, 0.060), true, 0), Hint::ComingOn);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Free, 0.040), false, 0), Hint::MoveDown);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Attached, 0.005), false, 0), Hint::PressOn);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Attached, -0.010), false, 0), Hint::Pressed);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Attached, 0.030), true, 0), Hint::MoveUp);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Free, 0.060), true, 1), Hint::LetGo);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Free, 0.060), false, 1), Hint::MoveDown);
  EXPECT_EQ(next_step(tip(State::Fading, Phase::Attached, 0.0), true, 0), Hint::GoingOff);
}

TEST(Guidance, EveryLanguageThatWeShipIsComplete) {
  std::size_t languages = 0;
  for (const auto& file : std::filesystem::directory_iterator(kFolder)) {
    const auto guidance = Guidance::load(file.path());
    ASSERT_TRUE(guidance) << guidance.error().message;
    ++languages;
  }
  EXPECT_GE(languages, 2U);
}

TEST(Guidance, SaysWhyTheForceWasTakenAway) {
  scene::TipState fault = tip(scene::ServoState::Fault, physics::Phase::WaitForLift, 0.0);
  fault.fault = scene::FaultCode::VelocityTrip;
  const Guidance english = Guidance::load(kFolder + "en.toml").value();
  EXPECT_EQ(english.line(fault, false, 0), "Force off: the hand was faster than is safe. Press Turn-On to go on");

  scene::TipState released = tip(scene::ServoState::Disarmed, physics::Phase::Free, 0.060);
  released.fault = scene::FaultCode::LateTick;
  EXPECT_THAT(english.line(released, true, 0), AllOf(HasSubstr("20 ms late"), HasSubstr("Press Turn-On")));
}

TEST(Guidance, RefusesAFileThatDoesNotSayEverythingInOneLineEach) {
  const support::ScratchFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto guidance = Guidance::load(folder.write("g.toml", text));
    return guidance ? std::string() : guidance.error().message;
  };
  EXPECT_THAT(refusal(""), HasSubstr("line 1: choose-sample: is missing"));
  EXPECT_THAT(refusal("lift = \"x\"\nlitf = \"y\"\n"), HasSubstr("line 2: litf: unknown key"));
  EXPECT_THAT(refusal("choose-sample = 3\n"), HasSubstr("line 1: choose-sample: must be one line"));
  EXPECT_THAT(refusal("choose-sample = \"" + std::string(91, 'x') + "\"\n"), HasSubstr("1 to 90 characters"));
  EXPECT_THAT(refusal("choose-sample = \"a\\nb\"\n"), HasSubstr("must be one line"));
  EXPECT_THAT(Guidance::load("no-such-file.toml").error().message, HasSubstr("phrase file no-such-file.toml"));
}

TEST(Guidance, GivesInEnglishTheReasonsOfTheLog) {
  const auto guidance = Guidance::load(kFolder + "en.toml");
  ASSERT_TRUE(guidance) << guidance.error().message;
  scene::TipState released = tip(scene::ServoState::Disarmed, physics::Phase::Free, 0.060);
  for (const scene::FaultText& fault : scene::kFaultTexts) {
    if (fault.code == scene::FaultCode::None) continue;
    released.fault = fault.code;
    const std::string reason = "Force off: " + std::string(fault.reason) + ". ";
    EXPECT_THAT(guidance->line(released, true, 0), HasSubstr(reason));
  }
}

TEST(Guidance, AsksToHoldTheButtonThatTheForceHangsOn) {
  scene::TipState lifted = tip(scene::ServoState::Disarmed, physics::Phase::Free, 0.060);
  lifted.dead_man = 1;
  EXPECT_EQ(next_step(lifted, true, 0), Hint::TurnOnAndHold);
}

}  // namespace
}  // namespace afm::exhibit
