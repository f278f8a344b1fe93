// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/lesson/lesson.h"
#include "exhibit/state/lines_to_write.h"

namespace afm::scene {
class TomlTable;
}

namespace afm::exhibit {

// Reads the set of particles, or the soft sample, that all steps of a lesson share. Each function refuses, like
// TomlTable, what does not fit.
void read_particles(const scene::TomlTable& top, const std::string& assets_dir, Lesson& lesson);

// Refuses a type of step for which the lesson's tip works on something else.
void refuse_kind_on_ground(const scene::TomlTable& table, const study::StepKindRow& row, const Lesson& lesson);

// A push on that set of spheres.
PushPlan read_push(const scene::TomlTable& table, const scene::ParticleSet& set);

// Lines on that soft sample.
LinesToWrite read_lines(const scene::TomlTable& table, const scene::ParticleSet& set);

}  // namespace afm::exhibit
