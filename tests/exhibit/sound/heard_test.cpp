// SPDX-License-Identifier: Apache-2.0
// Events as they are heard, shown and spoken.
// Invariant: one table gives each event a sound, a caption and a phrase in every language
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/sound/captions.h"
#include "exhibit/sound/narrator.h"
#include "exhibit/sound/speech_queue.h"
#include "exhibit/sound/spoken_text.h"
#include "exhibit/sound/tip_ear.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace heard_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using State = scene::ServoState;

constexpr std::int64_t kMs = 1'000'000;

class SetClock final : public core::Clock {
 public:
  std::int64_t now_ns() const noexcept override { return now; }
  std::int64_t now = 1'000'000'000;
};

Phrases phrases_in(std::string_view language) {
  return Phrases::load(test::kPhraseFolder + std::string(language) + ".toml").value();
}

// ---- the table

TEST(EveryHeardEvent, HasASoundACaptionAndAPhraseInEveryLanguage) {
  std::size_t checked = 0;
  for (const auto& language : kLanguages) {
    const Phrases phrases = phrases_in(language.word);
    std::set<std::string> captions, said;
    for (const HeardEvent event : core::kEnumerators<HeardEvent>) {
      const HeardEventRow& row = row_of(event);
      EXPECT_EQ(row.event, event);
      EXPECT_GT(row.signal.length_s(), 0.0);
      EXPECT_GT(row.signal.notes.front().level, 0.0);
      const Heard heard{.event = event, .force_n = 1.4e-9, .material = 0};
      captions.insert(caption_of(phrases, heard, "Mica"));
      said.insert(said_of(phrases, heard, "Mica"));
      ++checked;
    }
    EXPECT_EQ(captions.size(), core::kEnumerators<HeardEvent>.size()) << language.word << ": no two captions are alike";
    EXPECT_EQ(said.size(), core::kEnumerators<HeardEvent>.size()) << language.word;
    EXPECT_FALSE(captions.contains("") || said.contains(""));
  }
  EXPECT_EQ(checked, 2 * core::kEnumerators<HeardEvent>.size());
}

TEST(EveryHeardEvent, OfJumpsGivesTheForce) {
  for (const auto& language : kLanguages) {
    const Phrases phrases = phrases_in(language.word);
    for (const HeardEvent event : {HeardEvent::SnapIn, HeardEvent::PullOff, HeardEvent::Slip}) {
      const Heard heard{.event = event, .force_n = -1.399894e-9};
      EXPECT_THAT(caption_of(phrases, heard, ""), HasSubstr(phrases.number("1.4 nN")));
      EXPECT_THAT(said_of(phrases, heard, ""), HasSubstr(phrases.number("1.4 ")));
    }
  }
}

// ---- numbers

TEST(SpokenNumber, HasTwoSignificantDigits) {  // D19
  const Phrases english = phrases_in("en");
  EXPECT_EQ(spoken_force(english, 0.239752e-9), "0.24 nanonewtons");
  EXPECT_EQ(spoken_force(english, 9.99969e-9), "10 nanonewtons");
  EXPECT_EQ(spoken_length(english, 99.9969e-9), "100 nanometres");
  EXPECT_EQ(spoken_force(english, -1.399894e-9), "1.4 nanonewtons");
  EXPECT_EQ(spoken_force(english, 123e-9), "120 nanonewtons");
  EXPECT_EQ(spoken_force(english, 0.0), "0 nanonewtons");
}

TEST(SpokenNumber, ChoosesItsUnitAndItsPlural) {
  const Phrases english = phrases_in("en");
  EXPECT_EQ(spoken_force(english, 1.02e-9), "1 nanonewton");
  EXPECT_EQ(spoken_force(english, 0.1e-9), "0.1 nanonewtons");
  EXPECT_EQ(spoken_force(english, 24.1e-12), "24 piconewtons");
  EXPECT_EQ(spoken_force(english, 999.7e-9), "1 micronewton");
  EXPECT_EQ(spoken_length(english, 2.4e-6), "2.4 micrometres");
  EXPECT_EQ(spoken_length(english, 5e-12), "5 picometres");
  EXPECT_EQ(spoken_force(phrases_in("de"), 0.239752e-9), "0,24 Nanonewton");
  EXPECT_EQ(shown_force(phrases_in("de"), 0.239752e-9), "0,24 nN");
}

TEST(SpokenState, SaysSampleForceHeightAndTheNextStep) {
  const Phrases english = phrases_in("en");
  scene::TipState tip;
  EXPECT_EQ(said_of_state(english, tip, "", "Choose a sample"), "FORCE OFF. Choose a sample");
  tip.material = 0;
  tip.servo_state = State::Running;
  tip.phase = physics::Phase::Attached;
  tip.tip.force_n = -0.8e-9;
  tip.tip.z_m = 6e-9;
  EXPECT_EQ(said_of_state(english, tip, "Mica", "Move up"),
            "Mica. FORCE ON. A pull of 0.8 nanonewtons. 6 nanometres above the first touch. Move up");
  tip.tip.force_n = 0.3e-9;
  tip.tip.z_m = -3e-9;
  EXPECT_THAT(said_of_state(english, tip, "Mica", "Move up"),
              HasSubstr("A push of 0.3 nanonewtons. 3 nanometres below the first touch"));
  tip.tip.force_n = 0.0;
  EXPECT_THAT(said_of_state(english, tip, "Mica", "Move up"), HasSubstr("No force on the tip"));
}

// ---- the queue

TEST(SpeechQueue, LetsTheNewestEventCutOffTheOneBefore) {  // D20
  struct Start {
    std::string text;
    double at_s;
    bool operator==(const Start&) const = default;
  };
  SpeechQueue queue;
  std::vector<Start> started;
  const std::vector<Start> events{{"snap-in", 0.00}, {"pull-off", 0.35}, {"snap-in", 0.40}};
  for (int ms = 0; ms < 5000; ms += 5) {
    for (const Start& event : events) {
      if (std::lround(event.at_s * 1000) == ms) queue.offer({event.text, SpeechKind::Event});
    }
    if (const auto text = queue.take(ms * kMs)) {
      started.push_back({text->text, ms / 1000.0});
      queue.spoken_until(ms * kMs + 2'000 * kMs);
    }
  }
  EXPECT_EQ(started, (std::vector<Start>{{"snap-in", 0.0}, {"pull-off", 0.35}, {"snap-in", 0.40}}));
}

TEST(SpeechQueue, LetsGuidanceWaitForAnEventAndForgetsOlderGuidance) {
  SpeechQueue queue;
  queue.offer({"lift", SpeechKind::Guidance});
  EXPECT_EQ(queue.take(0)->text, "lift");
  queue.spoken_until(3'000 * kMs);
  queue.offer({"on", SpeechKind::Event});
  EXPECT_EQ(queue.take(1)->text, "on");
  queue.offer({"older", SpeechKind::Guidance});
  EXPECT_FALSE(queue.take(2).has_value()) << "how long the event takes is not known yet";
  queue.spoken_until(1'000 * kMs);
  queue.offer({"newer", SpeechKind::Guidance});
  EXPECT_FALSE(queue.take(999 * kMs).has_value());
  EXPECT_EQ(queue.next_ns(), 1'000 * kMs);
  EXPECT_EQ(queue.take(1'000 * kMs)->text, "newer");
  EXPECT_FALSE(queue.take(9'000 * kMs).has_value());
  queue.offer({"newest", SpeechKind::Guidance});
  EXPECT_EQ(queue.take(1'001 * kMs)->text, "newest") << "guidance cuts off guidance";
}

// ---- captions

TEST(CaptionOnTheWall, ChangesAtMostThreeTimesASecondWhateverHappens) {  // D16, WCAG 2.3.1
  Captions captions;
  std::vector<std::int64_t> changes;
  std::string last;
  for (std::int64_t ms = 0; ms < 10'000; ++ms) {
    captions.add(ms % 7 == 0 ? HeardEvent::SnapIn : HeardEvent::Slip, std::to_string(ms), ms * kMs);
    const std::string now = captions.text(ms * kMs);
    if (now != last) changes.push_back(ms);
    last = now;
  }
  ASSERT_GT(changes.size(), 10U);
  for (std::size_t i = 3; i < changes.size(); ++i) EXPECT_GT(changes[i] - changes[i - 3], 1000);
}

TEST(CaptionOnTheWall, OfSlipsDoesNotPushAwayAJump) {
  Captions captions;
  captions.add(HeardEvent::Slip, "slip", 0);
  EXPECT_EQ(captions.text(0), "slip");
  captions.add(HeardEvent::PullOff, "pull-off", 500 * kMs);
  captions.add(HeardEvent::Slip, "another slip", 501 * kMs);
  EXPECT_EQ(captions.text(502 * kMs), "pull-off");
  captions.add(HeardEvent::Slip, "another slip", 1'500 * kMs);
  EXPECT_EQ(captions.text(1'600 * kMs), "pull-off");
  captions.add(HeardEvent::Slip, "another slip", 2'600 * kMs);
  EXPECT_EQ(captions.text(2'700 * kMs), "another slip");
  EXPECT_EQ(captions.text(6'800 * kMs), "") << "some seconds later";
}

// ---- events of the tip

class TipEarTest : public ::testing::Test {
 protected:
  std::optional<Heard> sample(State state, physics::Phase phase, double force_n) {
    now_ns_ += kMs;
    scene::TipSample sample{.time_ns = now_ns_};
    sample.material = 0;
    sample.servo_state = state;
    sample.phase = phase;
    sample.tip.force_n = force_n;
    sample.renderer = renderer_;
    return ear_.add(sample);
  }
  TipEar ear_;
  std::int64_t now_ns_ = 0;
  scene::RendererLink renderer_ = scene::RendererLink::Alive;
};

TEST_F(TipEarTest, HearsTheForceComeAndGo) {
  using physics::Phase;
  EXPECT_FALSE(sample(State::Disarmed, Phase::Free, 0).has_value());
  EXPECT_FALSE(sample(State::Arming, Phase::Free, 0).has_value());
  EXPECT_EQ(sample(State::Running, Phase::Free, 0)->event, HeardEvent::ForceOn);
  EXPECT_FALSE(sample(State::Running, Phase::Free, 0).has_value());
  EXPECT_EQ(sample(State::Fading, Phase::Free, 0)->event, HeardEvent::ForceOff);
  EXPECT_FALSE(sample(State::Disarmed, Phase::Free, 0).has_value()) << "once is enough";
  sample(State::Running, Phase::Free, 0);
  EXPECT_EQ(sample(State::Fault, Phase::Free, 0)->event, HeardEvent::Fault);
  EXPECT_FALSE(sample(State::Disarmed, Phase::Free, 0).has_value());
}

TEST_F(TipEarTest, TakesAStopForNoFault) {
  sample(State::Running, physics::Phase::Free, 0);
  renderer_ = scene::RendererLink::Stopped;
  EXPECT_EQ(sample(State::Fault, physics::Phase::Free, 0)->event, HeardEvent::ForceOff);
}

TEST_F(TipEarTest, HearsATouchWhereTheForceCrossesZero) {
  using physics::Phase;
  sample(State::Running, Phase::Free, 0);
  EXPECT_FALSE(sample(State::Running, Phase::Attached, -3e-10).has_value());
  const auto touch = sample(State::Running, Phase::Attached, 1e-10);
  ASSERT_TRUE(touch.has_value());
  EXPECT_EQ(touch->event, HeardEvent::Touch);
  EXPECT_EQ(touch->time_ns, now_ns_ - kMs / 4) << "three quarters of the tick";
  EXPECT_FALSE(sample(State::Running, Phase::Attached, -1e-11).has_value());
  EXPECT_FALSE(sample(State::Running, Phase::Attached, 1e-11).has_value()) << "a trembling hand touches once";
  sample(State::Running, Phase::Free, 0);
  sample(State::Running, Phase::Attached, -3e-10);
  EXPECT_TRUE(sample(State::Running, Phase::Attached, 1e-10).has_value()) << "in the next cycle again";
}

// ---- steps of the procedure, as spoken

class NarratorTest : public ::testing::Test {
 protected:
  Narrator::Step step(Hint hint, const std::string& guidance) { return {hint, guidance, std::nullopt}; }
  std::vector<std::string> spoken() { return std::exchange(said_, {}); }

  const Phrases english_ = phrases_in("en");
  SetClock clock_;
  std::vector<std::string> said_;
  std::vector<HeardEvent> signals_;
  Narrator narrator_{english_,
                     {"Mica", "Gold"},
                     clock_,
                     [this](const Heard& heard) { signals_.push_back(heard.event); },
                     [this](const SpeechText& text) { said_.push_back(text.text); }};
  scene::TipState tip_;
};

TEST_F(NarratorTest, SaysGuidanceWhenItChangesAndASampleWhenItIsChosen) {
  narrator_.follow(tip_, step(Hint::ChooseSample, "Choose a sample"));
  narrator_.follow(tip_, step(Hint::ChooseSample, "Choose a sample"));
  EXPECT_THAT(spoken(), ElementsAre("Choose a sample"));
  tip_.material = 1;
  narrator_.follow(tip_, step(Hint::Lift, "Lift"));
  EXPECT_THAT(spoken(), ElementsAre("Gold", "Lift"));
  narrator_.follow(tip_, step(Hint::TurnOn, "Turn on"));
  EXPECT_THAT(spoken(), ElementsAre("High enough", "Turn on"));
  EXPECT_THAT(signals_, ElementsAre(HeardEvent::SampleChosen, HeardEvent::TurnOnReady));
}

TEST_F(NarratorTest, SaysAndShowsTheResultOfACycle) {
  narrator_.heard(
      scene::TipEvent{.kind = physics::EventKind::JumpToContact, .material = 0, .force_after_n = -0.239752e-9});
  EXPECT_THAT(spoken(), ElementsAre("The tip snapped to contact. 0.24 nanonewtons"));
  EXPECT_EQ(narrator_.caption(), "Snap-in: pull of 0.24 nN");
  clock_.now += 1'000 * kMs;
  narrator_.heard(
      scene::TipEvent{.kind = physics::EventKind::JumpOffContact, .material = 0, .force_before_n = -1.399894e-9});
  EXPECT_THAT(spoken(), ElementsAre("The tip let go. 1.4 nanonewtons"));
  EXPECT_EQ(narrator_.caption(), "Pull-off: pull of 1.4 nN");
  EXPECT_TRUE(signals_.empty()) << "the servo's events are heard at their own times, not at those of frames";
}

TEST_F(NarratorTest, SaysSlipsOnRequestAlone) {
  narrator_.heard(scene::TipEvent{.kind = physics::EventKind::Slip, .material = 0, .force_before_n = 0.31e-9});
  EXPECT_TRUE(spoken().empty());
  EXPECT_THAT(narrator_.caption(), HasSubstr("0.31 nN"));
  narrator_.say_state(tip_);
  EXPECT_THAT(spoken().at(0), HasSubstr("The tip slips. 0.31 nanonewtons"));
}

TEST_F(NarratorTest, ReportsAServoThatHasGoneSilentOnce) {
  tip_.fault = scene::FaultCode::ServoSilent;
  for (int frame = 0; frame < 3; ++frame) narrator_.follow(tip_, step(Hint::PressToGoOn, "Let go"));
  EXPECT_THAT(signals_, ElementsAre(HeardEvent::Fault));
}

TEST_F(NarratorTest, ReportsEachLineOfAnImage) {
  for (const std::uint32_t lines : {0U, 0U, 1U, 1U, 2U}) {
    narrator_.follow(tip_, {.hint = Hint::ChooseSample, .guidance = "", .scan_lines = lines});
  }
  EXPECT_THAT(signals_, ElementsAre(HeardEvent::ScanLine, HeardEvent::ScanLine));
}

// Ten lines a second would keep the caption on the wall for the whole image, and key Y would repeat it first.
TEST_F(NarratorTest, CaptionsTheFirstLineOfAnImageAlone) {
  std::size_t captions = 0;
  std::string shown;
  for (std::uint32_t line = 0; line < 130; ++line) {
    narrator_.follow(tip_, {.hint = Hint::ChooseSample, .guidance = "", .scan_lines = line});
    clock_.now += 100 * kMs;
    const std::string now = narrator_.caption();
    if (now != shown && !now.empty()) ++captions;
    shown = now;
  }
  EXPECT_EQ(signals_.size(), 129U) << "each is heard";
  EXPECT_EQ(captions, 1U);
  EXPECT_EQ(shown, "") << "the note below the panel is free again";
  narrator_.say_state(tip_);
  EXPECT_THAT(spoken().back(), Not(HasSubstr("line"))) << "the state comes first";
}

}  // namespace heard_test
}  // namespace afm::exhibit
