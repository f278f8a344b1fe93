// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves/tapping/tapped_hand.h"
#include "exhibit/lesson/lesson.h"
#include "scene/config/toml_table.h"

namespace afm::exhibit {

// The lever of a lesson file's table `tapping`. Refuses, like TomlTable, unknown keys and texts that are no quantities;
// whether a hand can feel the lever depends on the material (lesson_setup()).
curves::TappedHand read_tapping(const scene::TomlTable& top);

// Refuses a type of step that does not go with a lever that taps, or needs one.
void refuse_kind_beside_tapping(const scene::TomlTable& table, const study::StepKindRow& row, const Lesson& lesson);

// Returns whether a step `identify` asks for the state of the swing instead of the material; refuses what does not go
// with it.
bool read_states(const scene::TomlTable& table, const Lesson& lesson);

}  // namespace afm::exhibit
