// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/blind_task_words.h"

namespace afm::exhibit {

std::optional<std::string> blind_guidance(const scene::BlindTask& task, const scene::TaskScore& score, bool far_enough,
                                          const Phrases& phrases) {
  if (score.state == scene::TaskState::Done) return std::nullopt;
  if (task.kind == scene::BlindKind::Line) return phrases[far_enough ? Phrase::BlindLift : Phrase::BlindLine];
  return phrases[score.threshold_n > 0.0 ? Phrase::BlindPress : Phrase::BlindFeel];
}

}  // namespace afm::exhibit
