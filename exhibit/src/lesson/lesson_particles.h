// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/lesson/lesson.h"
#include "exhibit/state/lines_to_write.h"

namespace afm::scene {
class TomlTable;
}

namespace afm::exhibit {

// Reads the set of particles, or the soft sample, shared by all steps of a lesson. Like TomlTable, each function
// refuses invalid values.
void read_particles(const scene::TomlTable& top, const std::string& assets_dir, Lesson& lesson);

// Refuses a kind of step that does not suit the sample under the lesson's tip.
void refuse_kind_on_ground(const scene::TomlTable& table, const study::StepKindRow& row, const Lesson& lesson);

// Reads a push of spheres of that set.
PushPlan read_push(const scene::TomlTable& table, const scene::ParticleSet& set);

// Reads lines for that soft sample.
LinesToWrite read_lines(const scene::TomlTable& table, const scene::ParticleSet& set);

}  // namespace afm::exhibit
