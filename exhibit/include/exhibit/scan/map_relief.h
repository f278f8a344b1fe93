// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/models/relief.h"
#include "exhibit/state/wall_state.h"
#include "render/frame.h"

namespace afm::curves {
struct SampleModel;
}

namespace afm::exhibit {

struct ScanSubject;
class WallScene;

// Relief of a whole felt map on its sample: the colours of its picture on the drawn surface, `subject`,
// within the map's outermost pixels.
HeightRelief map_relief(const render::MapPicture& picture, const curves::SampleModel& model,
                        const ScanSubject& subject);

// Lays it on the sample in front, with the picture's lowest and highest value beside the colour scale; nothing without
// a sample. Call after WallScene::update(), with the same state, and without another relief.
void lay_map(const HeightRelief& relief, const render::MapPicture& picture, const WallScene& wall_scene,
             const WallState& state, render::FrameState& frame);

}  // namespace afm::exhibit
