// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/sample_model.h"
#include "exhibit/lesson/lesson.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// The contact of one of the lesson's materials, under the lesson's tapping lever if it has one. Fails as
// curves::tapped_setup(), as an error of the file.
core::Result<curves::ContactSetup> lesson_setup(const Lesson& lesson, const scene::MaterialEntry& entry);

// The samples of a lesson, in the order of Lesson::materials. Fails if a step needs a jump that a material does not
// have, or if a threshold's strongest pull-off exceeds that of every material of the lesson: the common scale would
// adapt to it, and the hand would feel no difference.
core::Result<std::vector<curves::SampleModel>> lesson_samples(const Lesson& lesson,
                                                              const scene::MaterialLibrary& library);

// Samples of the lesson for the JSON of a data set, as text: an object with parameters and sources of each material.
core::Result<std::string> samples_json(const Lesson& lesson, const scene::MaterialLibrary& library);

// Same checks for existing samples.
core::Result<void> check_samples(const Lesson& lesson, std::span<const curves::SampleModel> samples);

// A threshold's standard with an F_ad 1 + w times as large and with the plan's treatment of the distances. `rove` is
// the factor of the stiffness, used only for Roved. Takes milliseconds.
core::Result<curves::SampleModel> comparison_sample(const curves::SampleModel& standard, DistanceCue distance, double w,
                                                    double rove);

}  // namespace afm::exhibit
