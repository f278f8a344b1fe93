// SPDX-License-Identifier: Apache-2.0
// Labels of the wall beside the objects that they name.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "exhibit/scenery/journey.h"
#include "exhibit/scenery/wall_places.h"
#include "exhibit/state/jump_cue.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// Label beside the point of contact, in the wall's plane; moves with the sample, not with the tip.
render::Label cue_label(const JumpCue& cue, const Phrases& phrases, const WallPlaces& places,
                        const glm::dvec3& touched_m);

// Ladder of powers of ten with the current rung, the gap below the last atom, and the apex above the picture.
void add_journey_labels(const Journey& journey, const WallPlaces& places, const Phrases& phrases, double orders,
                        render::FrameState& frame);

// Label above the companion, at its depth, and beside the ruler.
void add_companion_label(const Journey::Companion& companion, const glm::dmat4& room_from_journey,
                         const WallPlaces& places, const Phrases& phrases, render::FrameState& frame);

// Numbers at the ends of the colour scale, in metres as measured, and a measured sample's exaggeration.
void add_height_labels(const WallPlaces& places, const Phrases& phrases, double range_m,
                       std::optional<double> exaggeration, render::FrameState& frame);

}  // namespace afm::exhibit
