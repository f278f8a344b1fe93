// SPDX-License-Identifier: Apache-2.0
#include "app/commands/task_figures.h"

#include <nlohmann/json.hpp>

namespace afm::app {

nlohmann::json task_json(const scene::TaskScore& score) {
  if (score.state == scene::TaskState::NotBegun) return nullptr;
  const bool done = score.state == scene::TaskState::Done;
  const bool felt = scene::answered(score);
  return {{"done", done},
          {"time_s", score.time_s},
          {"rms_m", done && !felt ? nlohmann::json(score.rms_m) : nlohmann::json()},
          {"threshold_N", score.threshold_n > 0.0 ? nlohmann::json(score.threshold_n) : nlohmann::json()},
          {"answer_N", felt ? nlohmann::json(score.answer_n) : nlohmann::json()},
          {"strokes", score.strokes},
          {"losses", score.losses},
          {"pushes_taken_back", score.undos},
          {"pushes_in_a_groove", score.guided},
          {"particles_shown", score.truth != 0},
          {"work_J", score.work_j},
          {"largest_lateral_N", score.largest_lateral_n}};
}

}  // namespace afm::app
