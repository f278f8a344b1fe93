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

// Lines that a step of a lesson has a person write on a sample that keeps marks, judged once the tip has been lifted
// for scene::PatternTask::kRestNs, and scored as a push is. A stroke that is taken back, and a sample that is made
// level, count as taken back. The sample is level when the trial begins. One thread.
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
  const WrittenLines& written() const { return written_; }  // as judged last

  // Fault for which the lines were not done when they were judged last; nothing before.
  std::optional<WritingFault> fault() const { return fault_; }

 private:
  MarkGrid grid_;
  const LinesToWrite& lines_;
  scene::PatternTask task_;
  std::uint64_t digest_ = scene::kSoftDigest;  // digest of the newest sample
  std::uint64_t changes_ = 0;                  // by strokes, and by what was taken back
  bool was_on_ = false;                        // the tip was on the sample in the newest tick
  WrittenLines written_;
  std::optional<WritingFault> fault_;
};

}  // namespace afm::exhibit
