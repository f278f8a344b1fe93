// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/result.h"
#include "exhibit/lesson/lesson.h"

namespace afm::exhibit {

// Details of a push, or of lines that were written, in addition to the response. Work and force are those of
// scene::TaskScore.
struct PushFigures {
  std::uint32_t strokes = 0, losses = 0, undos = 0;
  double work_j = 0, largest_lateral_n = 0;
  bool truth = true;  // the wall showed particles and marks
};

// A line of events.tsv: a finished trial. Empty texts and missing values are written as n/a.
struct TrialRow {
  double onset_s = 0, duration_s = 0;  // since the start of the lesson
  std::string step{};
  StepKind kind = StepKind::Text;
  std::optional<Condition> condition{};
  bool practice = false;
  int trial = 1;
  std::optional<double> level{};  // w
  std::string stimulus{}, response{};
  std::optional<bool> correct{};
  std::optional<double> rt_s{};
  std::optional<bool> force{};  // on from snap-in to pull-off of each of the trial's cycles; empty: it has no cycle
  std::optional<PushFigures> push{};
};

using TrialSink = std::function<core::Result<void>(const TrialRow&)>;

}  // namespace afm::exhibit
