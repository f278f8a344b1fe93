// SPDX-License-Identifier: Apache-2.0
// Invariant: an instructor can skip, stop and keep the force off, but not consent or answer for a participant
#include "exhibit/lesson/instructor_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/phrases.h"

namespace afm::exhibit {
namespace instructor_page_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Action = InstructorAction;
using Wants = LessonPrompt::Wants;

LessonPrompt prompt_of(StepKind kind, Wants wants, bool in_step = true) {
  LessonPrompt prompt;
  prompt.title = "First touch";
  prompt.words = "Feel one cycle.";
  prompt.kind = kind;
  prompt.wants = wants;
  prompt.in_step = in_step;
  return prompt;
}

std::vector<Action> offered(const LessonPrompt& prompt) {
  std::vector<Action> actions;
  for (const Action action : core::kEnumerators<Action>) {
    if (acts(action, prompt)) actions.push_back(action);
  }
  return actions;
}

std::string text_of(const render::FrameState& frame) {
  std::string text = frame.panels.data.content.title + "\n" + frame.panels.data.content.subtitle + "\n";
  for (const render::DataRow& row : frame.panels.data.content.rows) text += row.name + ": " + row.value + "\n";
  for (const render::Label& label : frame.labels) text += label.text + "\n";
  return text;
}

// The middle of a target, in unit coordinates from the picture's top left corner.
glm::dvec2 middle_of(const render::PanelPlacement& target, double aspect) {
  const glm::dvec3 middle_m = target.lower_left_m + 0.5 * (target.right_m + target.up_m);
  return {middle_m.x / (aspect * InstructorPage::kHeightM) + 0.5, 1.0 - middle_m.y / InstructorPage::kHeightM};
}

TEST(InstructorActions, ActOnlyWhereTheyTakeNothingFromTheParticipant) {
  EXPECT_THAT(offered(prompt_of(StepKind::Text, Wants::GoOn)),
              ElementsAre(Action::Next, Action::Skip, Action::Stop, Action::HandOff));
  EXPECT_THAT(offered(prompt_of(StepKind::Write, Wants::Write)),
              ElementsAre(Action::Skip, Action::Stop, Action::HandOff));
  EXPECT_THAT(offered(prompt_of(StepKind::Free, Wants::Cycle)),
              ElementsAre(Action::Next, Action::Skip, Action::Stop, Action::HandOff));
  for (const StepKind kind : {StepKind::Cycle, StepKind::Identify, StepKind::Question}) {
    const Wants wants = kind == StepKind::Question ? Wants::Answer : Wants::Cycle;
    EXPECT_THAT(offered(prompt_of(kind, wants)), ElementsAre(Action::Skip, Action::Stop, Action::HandOff))
        << "no one answers for the participant";
  }
  EXPECT_THAT(offered(prompt_of(StepKind::Text, Wants::Answer, false)), ElementsAre(Action::Stop, Action::HandOff))
      << "consent and break are the participant's";
  EXPECT_THAT(offered(prompt_of(StepKind::Text, Wants::Nothing, false)), ElementsAre(Action::HandOff));
}

TEST(InstructorPage, IsPressedWhereItDrawsItsTargets) {
  const InstructorState state{.prompt = prompt_of(StepKind::Text, Wants::GoOn)};
  for (const double aspect : {4.0 / 3.0, 16.0 / 9.0, 0.6}) {
    const InstructorPage page(aspect);
    const render::FrameState frame = page.frame(state, std::nullopt, test::english());
    ASSERT_EQ(frame.labels.size(), kInstructorActions);
    for (std::size_t i = 0; i < frame.labels.size(); ++i) {
      const render::PanelPlacement& target = frame.labels[i].placement;
      EXPECT_EQ(page.action_at(middle_of(target, aspect), state.prompt), core::kEnumerators<Action>[i]);
      EXPECT_GE(target.up_m.y, 0.1 * InstructorPage::kHeightM) << "no fine aim is needed";
      EXPECT_LE(target.lower_left_m.y + target.up_m.y, frame.panels.data.placement.lower_left_m.y);
    }
    EXPECT_EQ(page.action_at({0.5, 0.2}, state.prompt), std::nullopt) << "the panel";
  }
  const InstructorPage page(1.6);
  const auto over = prompt_of(StepKind::Text, Wants::Nothing, false);
  const glm::dvec2 next = middle_of(page.frame(state, {}, test::english()).labels.front().placement, 1.6);
  EXPECT_EQ(page.action_at(next, over), std::nullopt) << "what does not act is not pressed";
}

TEST(InstructorPage, ShowsStateAndWords) {
  const InstructorPage page(1.6);
  InstructorState state{.prompt = prompt_of(StepKind::Identify, Wants::Cycle),
                        .participant = "QXWERT",
                        .elapsed_s = 450,
                        .planned_min = 18,
                        .right = 3,
                        .judged = 5,
                        .hand = scene::ServoState::Running};
  state.prompt.progress = "Step 2 of 3";
  const std::string text = text_of(page.frame(state, std::nullopt, test::english()));
  for (const char* part : {"First touch", "Step 2 of 3", "QXWERT", "a cycle", "FORCE ON", "7 of 18 min", "3 of 5",
                           "Feel one cycle.", "2  Skip", "3  Stop the lesson", "4  Hand off"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  state.hand = scene::ServoState::Fault;
  state.stopped = true;
  EXPECT_THAT(text_of(page.frame(state, std::nullopt, test::english())), HasSubstr("STOPPED"));
  state.participant.clear();
  state.hand_off = state.stop_asked = true;
  const std::string later = text_of(page.frame(state, std::nullopt, test::english()));
  for (const char* part : {"nothing is kept", "off, by you", "3  Really stop?", "4  Allow the force again"}) {
    EXPECT_THAT(later, HasSubstr(part));
  }
}

TEST(InstructorPage, MarksWhatIsPointedAt) {
  const InstructorPage page(1.6);
  const InstructorState state{.prompt = prompt_of(StepKind::Text, Wants::GoOn)};
  std::vector<std::string> marked;
  for (const render::Label& label : page.frame(state, Action::Skip, test::english()).labels) {
    if (label.highlighted) marked.push_back(label.text);
  }
  EXPECT_THAT(marked, ElementsAre("2  Skip this step"));
}

}  // namespace instructor_page_test
}  // namespace afm::exhibit
