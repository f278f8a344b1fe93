// SPDX-License-Identifier: Apache-2.0
#include "exhibit/words/guidance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "core/enumerators.h"
#include "exhibit/state/moment.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace guidance_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

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
  EXPECT_EQ(next_step({}, {}), Hint::ChooseSample);
  EXPECT_EQ(next_step(tip(State::Disarmed, Phase::WaitForLift, 0.03), {}), Hint::Lift);
  EXPECT_EQ(next_step(tip(State::Disarmed, Phase::Free, 0.051), {.ascending = true}), Hint::Lift);
  EXPECT_EQ(next_step(tip(State::Disarmed, Phase::Free, 0.060), {.ascending = true}), Hint::TurnOn);
  EXPECT_EQ(next_step(tip(State::Arming, Phase::Free, 0.060), {.ascending = true}), Hint::ComingOn);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Free, 0.040), {}), Hint::MoveDown);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Attached, 0.005), {}), Hint::PressOn);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Attached, -0.010), {.pressed = true}), Hint::Pressed);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Attached, 0.030), {.ascending = true, .pressed = true}), Hint::MoveUp);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Free, 0.060), {.ascending = true, .let_go = true}), Hint::LetGo);
  EXPECT_EQ(next_step(tip(State::Running, Phase::Free, 0.060), {.let_go = true}), Hint::MoveDown);
  EXPECT_EQ(next_step(tip(State::Fading, Phase::Attached, 0.0), {}), Hint::GoingOff);

  scene::TipState pushing = tip(State::Running, Phase::Free, 0.040);
  pushing.active.scale_mode = scene::ScaleMode::Particles;
  EXPECT_EQ(next_step(pushing, {}), Hint::GoBeside);
  EXPECT_EQ(next_step(pushing, {.ascending = true, .let_go = true}), Hint::GoBeside) << "no cycle ends here";
  pushing.phase = Phase::Attached;
  EXPECT_EQ(next_step(pushing, {.pressed = true}), Hint::PushAside);
}

TEST(Guidance, NamesNeitherSnapInNorPullOffWhileTheLeverTaps) {
  for (const physics::Phase phase : {physics::Phase::Free, physics::Phase::Attached}) {
    const scene::TipState tapping = tip(scene::ServoState::Running, phase, 0.040);
    EXPECT_EQ(next_step(tapping, {.swing_taken = false}), Hint::TakeSwing);
    EXPECT_EQ(next_step(tapping, {.pressed = true, .swing_taken = true}), Hint::GiveSwing);
    EXPECT_EQ(next_step(tapping, {.ascending = true, .let_go = true, .swing_taken = false}), Hint::SwingsFree);
  }
}

TEST(Guidance, AsksToPressBeforeItAsksToMoveUpHoweverTheHandTrembles) {
  const scene::TipState snapped = tip(scene::ServoState::Running, physics::Phase::Attached, 0.005);
  EXPECT_EQ(next_step(snapped, {.ascending = true}), Hint::PressOn);
  EXPECT_EQ(next_step(snapped, {.ascending = false}), Hint::PressOn);
  EXPECT_EQ(next_step(snapped, {.ascending = false, .pressed = true}), Hint::MoveUp);
}

constexpr Controls kMouse{HandControls::Mouse, Pointer::Mouse};

TEST(Guidance, NamesTheControlsOfWhatIsInTheHand) {
  const auto text = [](Hint hint, const Controls& controls) { return step_text(test::english(), hint, controls); };
  EXPECT_EQ(text(Hint::TurnOn, kMouse), "Press Turn-On to feel the force: key T or middle button");
  EXPECT_EQ(text(Hint::MoveDown, kMouse), "Move down until the tip snaps in: drag down with the right button");
  EXPECT_EQ(text(Hint::TurnOn, {HandControls::Pen, Pointer::Mouse}),
            "Press Turn-On to feel the force: the button on the pen");
  EXPECT_THAT(text(Hint::MoveDown, {HandControls::Gamepad, Pointer::Mouse}), HasSubstr("left stick down"));
  EXPECT_THAT(text(Hint::ChooseSample, kMouse), HasSubstr("click"));
  EXPECT_THAT(text(Hint::ChooseSample, {HandControls::Mouse, Pointer::Wand}), HasSubstr("wand"));
}

TEST(Guidance, NamesTheControlsInEveryLanguageThatWeShip) {
  std::size_t languages = 0;
  for (const auto& file : std::filesystem::directory_iterator(test::kPhraseFolder)) {
    const auto phrases = Phrases::load(file.path());
    ASSERT_TRUE(phrases) << phrases.error().message;
    ++languages;
    for (const Note note : core::kEnumerators<Note>) EXPECT_NE(note_text(*phrases, note), "") << file.path();
    for (const Hint hint : core::kEnumerators<Hint>) {
      std::set<std::string> texts;
      for (const HandControls hand : core::kEnumerators<HandControls>) {
        const std::string text = step_text(*phrases, hint, {hand, Pointer::Mouse});
        EXPECT_FALSE(text.ends_with(": ")) << file.path() << ": " << text;
        texts.insert(text);
      }
      const bool has_control = hint == Hint::Lift || hint == Hint::TurnOn || hint == Hint::TurnOnAndHold ||
                               hint == Hint::MoveDown || hint == Hint::Pressed || hint == Hint::MoveUp ||
                               hint == Hint::GoBeside || hint == Hint::PushAside || hint == Hint::TakeSwing ||
                               hint == Hint::GiveSwing || hint == Hint::PressToGoOn;
      EXPECT_EQ(texts.size(), has_control ? core::kEnumerators<HandControls>.size() : 1) << file.path();
    }
  }
  EXPECT_EQ(languages, 2U);
}

TEST(Guidance, SaysWhyTheForceWentOff) {
  scene::TipState fault = tip(scene::ServoState::Fault, physics::Phase::WaitForLift, 0.0);
  fault.fault = scene::FaultCode::VelocityTrip;
  EXPECT_EQ(guidance_line(test::english(), Hint::PressToGoOn, fault, kMouse),
            "Force off: the hand was faster than is safe. Press Turn-On to continue: key T or middle button");

  scene::TipState released = tip(scene::ServoState::Disarmed, physics::Phase::Free, 0.060);
  released.fault = scene::FaultCode::LateTick;
  EXPECT_THAT(guidance_line(test::english(), Hint::TurnOn, released, kMouse),
              AllOf(HasSubstr("the computer paused for a moment"), HasSubstr("Press Turn-On")));
}

// The log contains the numbers of two of them.
TEST(Guidance, GivesInEnglishTheReasonsOfTheLogOrAPersonsWords) {
  const std::map<scene::FaultCode, std::string> in_other_words{
      {scene::FaultCode::RendererHung, "the picture froze"},
      {scene::FaultCode::LateTick, "the computer paused for a moment"}};
  scene::TipState released = tip(scene::ServoState::Disarmed, physics::Phase::Free, 0.060);
  for (const scene::FaultText& fault : scene::kFaultTexts) {
    if (fault.code == scene::FaultCode::None) continue;
    released.fault = fault.code;
    const std::string line = guidance_line(test::english(), Hint::TurnOn, released, kMouse);
    const auto other = in_other_words.find(fault.code);
    const std::string reason =
        "Force off: " + (other == in_other_words.end() ? std::string(fault.reason) : other->second) + ". ";
    const bool asked_for = fault.code == scene::FaultCode::StopPressed;
    if (asked_for) {
      EXPECT_THAT(line, Not(HasSubstr("Force off")));
    } else {
      EXPECT_THAT(line, HasSubstr(reason));
    }
  }
}

TEST(Guidance, AsksToHoldTheButtonThatTheForceHangsOn) {
  scene::TipState lifted = tip(scene::ServoState::Disarmed, physics::Phase::Free, 0.060);
  lifted.dead_man = 1;
  EXPECT_EQ(next_step(lifted, {}), Hint::TurnOnAndHold);
}

TEST(StateOfTheForce, IsAFaultUnlessAPersonStoppedIt) {
  scene::TipState now = tip(scene::ServoState::Fault, physics::Phase::Free, 0.1);
  for (const scene::FaultCode fault : core::kEnumerators<scene::FaultCode>) {
    now.fault = fault;
    const bool asked_for = fault == scene::FaultCode::StopPressed;
    const Moment moment = moment_of(now, false);
    EXPECT_EQ(test::english()[state_phrase(moment.servo_state, moment.stopped)], asked_for ? "STOPPED" : "FAULT")
        << scene::reason(fault);
  }
  now.fault = scene::FaultCode::StopPressed;
  for (const scene::ServoState state : core::kEnumerators<scene::ServoState>) {
    if (state == scene::ServoState::Fault) continue;
    EXPECT_EQ(state_phrase(state, is_stopped(now)), state_phrase(state, false));
  }
}

}  // namespace guidance_test
}  // namespace afm::exhibit
