// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::render {
struct FrameState;
}

namespace afm::exhibit {

struct LinesToWrite;
class WallScene;

// Draws the lines to write as dots on the soft sample of a wall; call after WallScene::update(). No effect on
// a wall without particles.
void add_lines(const LinesToWrite& lines, const WallScene& wall, render::FrameState& frame);

}  // namespace afm::exhibit
