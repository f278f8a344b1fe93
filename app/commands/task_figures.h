// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scene/shared/task_score.h"

namespace afm::app {

// Score of a task, with the unit in each key; null before the task has begun.
nlohmann::json task_json(const scene::TaskScore& score);

}  // namespace afm::app
