// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves/tapping/tapped_hand.h"
#include "exhibit/lesson/lesson.h"
#include "scene/config/toml_table.h"

namespace afm::exhibit {

// The lever of a lesson file's table `tapping`. Refuses, like TomlTable, unknown keys and texts that are no quantities;
// whether a hand can feel the lever depends on the material (lesson_setup()).
curves::TappedHand read_tapping(const scene::TomlTable& top);

// Refuses a step of this type in a lesson whose lever taps.
void refuse_kind_in_tapping(const scene::TomlTable& table, StepKind kind);

// Returns whether a step `identify` asks for the state of the swing instead of the material; refuses what does not go
// with it.
bool read_states(const scene::TomlTable& table, const Lesson& lesson);

}  // namespace afm::exhibit
