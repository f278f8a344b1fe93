// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "exhibit/state/lines_to_write.h"
#include "scene/samples/pattern_task.h"
#include "scene/shared/soft_blocks.h"
#include "scene/shared/tip_blocks.h"
#include "written_lines.h"

namespace afm::exhibit {

// Lines that a step makes a person write on a sample that keeps marks, judged once the tip has been lifted for
// scene::PatternTask::kRestNs, and scored like a push. Undoing a stroke, or levelling the sample, counts as taken back.
// The sample is level when the trial begins. One thread.
class WriteTrial {
 public:
  // `set` has a soft sample or ink; both must outlive the object.
  WriteTrial(const scene::ParticleSet& set, const LinesToWrite& lines);

  // Call in order of time, with the events of a tick before its sample.
  void add(const scene::TipEvent& event);
  void add(const scene::TipSample& sample);

  // Call with the newest tiles after the newest sample; true once the lines are done, then do not call it again.
  bool look(std::span<const scene::MarkTile> tiles);

  const scene::TaskScore& score() const { return task_.score(); }
  const WrittenLines& written() const { return written_; }  // result of the latest judgement

  // Fault found in the latest judgement, which keeps the lines from being done; empty before.
  std::optional<WritingFault> fault() const { return fault_; }

 private:
  MarkGrid grid_;
  const LinesToWrite& lines_;
  scene::PatternTask task_;
  std::uint64_t digest_ = scene::kSoftDigest;  // digest of the newest sample
  std::uint64_t changes_ = 0;                  // number of changes by strokes and by undoing
  bool was_on_ = false;                        // true: tip on the sample in the newest tick
  WrittenLines written_;
  std::optional<WritingFault> fault_;
};

}  // namespace afm::exhibit
