// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/result.h"
#include "curves/sample_model.h"
#include "exhibit/lesson/lesson.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// The samples of a lesson, in the order of Lesson::materials. Fails where a step needs a jump that a material does not
// make, and where a threshold's strongest pull-off is stronger than that of any material of the lesson: the common
// scale would give way for it, and the hand would feel no difference.
core::Result<std::vector<curves::SampleModel>> lesson_samples(const Lesson& lesson,
                                                              const scene::MaterialLibrary& library);

// The same checks of samples that exist already.
core::Result<void> check_samples(const Lesson& lesson, std::span<const curves::SampleModel> samples);

// The standard of a threshold with an F_ad that is 1 + w times as large and with what the plan does with the distances;
// `rove` is the factor of the stiffness, of Roved alone. Takes milliseconds.
core::Result<curves::SampleModel> comparison_sample(const curves::SampleModel& standard, DistanceCue distance, double w,
                                                    double rove);

}  // namespace afm::exhibit
