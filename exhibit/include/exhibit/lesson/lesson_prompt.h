// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/lesson/lesson.h"
#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

// The tip's newest complete cycle, from snap-in to pull-off; in tapping, of the swing.
struct FeltCycle {
  std::size_t material = 0;
  double f_ad_n = 0;  // magnitude; in tapping the mean force before the swing became attractive
};

// The current request to the participant.
struct LessonPrompt {
  enum class Wants { GoOn, Cycle, Push, Write, Answer, Nothing };
  Wants wants = Wants::GoOn;
  std::string title, words, hint, progress;     // the hint is empty until it is due
  std::vector<std::string> answers;             // used with Wants::Answer; more than nine are a scale
  std::size_t marked = 0;                       // initial value of a scale
  std::optional<std::size_t> material;          // sample required under the tip
  std::optional<scene::SharedContact> variant;  // its changed parameters; empty: as loaded
  std::size_t task = 0;                         // changes with every step
  std::uint32_t cycle = 0;                      // changes with every requested cycle
  bool in_step = false;                         // false in consent, break and end
  bool hidden = false;                          // names, curves, figures and sounds would reveal the answer
  bool dark = false;                            // a blind push has begun: there is no picture
  bool far_enough = false;                      // its particle is at the end of its line
  bool of_states = false;                       // hidden state of a swing, to be judged by its tones, too
  std::optional<Condition> condition;
  bool put_back = false;  // all particles are to be put back to their start, or a soft sample is to be level
  const LinesToWrite* lines = nullptr;  // to be written; those of the lesson; null: none

  bool by_hand() const { return wants == Wants::Cycle || moves_matter(); }
  // The tip's motion on the sample is judged.
  bool moves_matter() const { return wants == Wants::Push || wants == Wants::Write; }
  // for a simulated participant
  StepKind kind = StepKind::Text;
  std::string item;       // id of a questionnaire's item
  std::size_t right = 0;  // the right answer, if there is one
  bool has_right = false;
  PushPlan push;
};

}  // namespace afm::exhibit
