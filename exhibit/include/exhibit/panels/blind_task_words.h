// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "exhibit/words/phrases.h"
#include "scene/samples/blind_task.h"
#include "scene/shared/task_score.h"

namespace afm::exhibit {

// Next step of a task without a picture; empty once it is done. `far_enough`: its particle is at the end
// of the line.
std::optional<std::string> blind_guidance(const scene::BlindTask& task, const scene::TaskScore& score, bool far_enough,
                                          const Phrases& phrases);

}  // namespace afm::exhibit
