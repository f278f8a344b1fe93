// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/result.h"
#include "exhibit/lesson/lesson.h"

namespace afm::exhibit {

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
};

using TrialSink = std::function<core::Result<void>(const TrialRow&)>;

}  // namespace afm::exhibit
