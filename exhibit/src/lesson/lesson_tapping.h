// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves/tapping/tapped_hand.h"
#include "exhibit/lesson/lesson.h"
#include "scene/config/toml_table.h"

namespace afm::exhibit {

// Reads the lever in a lesson's table `tapping`. Refuses, like TomlTable, unknown keys and texts that are no
// quantities; whether a hand can feel the lever depends on the material (lesson_setup()).
curves::TappedHand read_tapping(const scene::TomlTable& top);

// Refuses a kind of step that is impossible in tapping mode, or one that needs it.
void refuse_kind_beside_tapping(const scene::TomlTable& table, const study::StepKindRow& row, const Lesson& lesson);

// True if a step `identify` asks for the state of the swing instead of the material; refuses keys that exclude
// it.
bool read_states(const scene::TomlTable& table, const Lesson& lesson);

}  // namespace afm::exhibit
