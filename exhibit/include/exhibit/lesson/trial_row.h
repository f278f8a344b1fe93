// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/result.h"
#include "exhibit/lesson/lesson.h"

namespace afm::exhibit {

// Details of a push, or of written lines, in addition to the response. Work and force are those of
// scene::TaskScore.
struct PushFigures {
  std::uint32_t strokes = 0, losses = 0, undos = 0;
  double work_j = 0, largest_lateral_n = 0;
  bool truth = true;  // true: particles and marks shown on the wall
};

// A line of events.tsv: a finished trial. Empty texts and missing values are written as n/a.
struct TrialRow {
  double onset_s = 0, duration_s = 0;  // onset since the start of the lesson, and duration
  std::string step{};
  StepKind kind = StepKind::Text;
  std::optional<Condition> condition{};
  bool practice = false;
  int trial = 1;
  std::optional<double> level{};  // level w of a threshold
  std::string stimulus{}, response{};
  std::optional<bool> correct{};
  std::optional<double> rt_s{};
  std::optional<bool> force{};  // true: full force in all cycles of the trial, snap-in to pull-off; empty: no cycles
  std::optional<PushFigures> push{};
};

using TrialSink = std::function<core::Result<void>(const TrialRow&)>;

}  // namespace afm::exhibit
