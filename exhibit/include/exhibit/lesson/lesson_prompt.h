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
  double f_ad_n = 0;  // pull-off force, magnitude; in tapping, mean force before the swing became attractive
};

// The current request to the participant.
struct LessonPrompt {
  enum class Wants { GoOn, Cycle, Push, Write, Answer, Nothing };
  Wants wants = Wants::GoOn;
  std::string title, words, hint, progress;     // texts of the request; the hint is empty until it is due
  std::vector<std::string> answers;             // possible answers for Wants::Answer; more than nine form a scale
  std::size_t marked = 0;                       // initial value of a scale
  std::optional<std::size_t> material;          // sample required under the tip
  std::optional<scene::SharedContact> variant;  // changed parameters of the material; empty: as loaded
  std::size_t task = 0;                         // counter that changes with every step
  std::uint32_t cycle = 0;                      // counter that changes with every requested cycle
  bool in_step = false;                         // false in consent, break and end
  bool hidden = false;                          // true: names, curves, figures and sounds would reveal the answer
  bool dark = false;                            // true: a blind push has begun, so there is no picture
  bool far_enough = false;                      // true: the pushed particle is at the end of its line
  bool of_states = false;                       // true: asks for the hidden state of a swing, audible in its tones
  std::optional<Condition> condition;
  bool put_back = false;  // true: particles must be put back to their start, or marks removed from a soft sample
  const LinesToWrite* lines = nullptr;  // lines to write, owned by the lesson; null: none

  bool by_hand() const { return wants == Wants::Cycle || moves_matter(); }
  // True if the tip's motion on the sample is judged.
  bool moves_matter() const { return wants == Wants::Push || wants == Wants::Write; }
  // for a simulated participant
  StepKind kind = StepKind::Text;
  std::string item;       // id of a questionnaire item
  std::size_t right = 0;  // index of the right answer; valid if has_right
  bool has_right = false;
  PushPlan push;
};

}  // namespace afm::exhibit
