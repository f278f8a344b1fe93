// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::render {
struct FrameState;
}

namespace afm::exhibit {

struct LinesToWrite;
class WallScene;

// Draws lines that are to be written on the soft sample of a wall, as dots; call after WallScene::update(). Nothing on
// a wall without particles.
void add_lines(const LinesToWrite& lines, const WallScene& wall, render::FrameState& frame);

}  // namespace afm::exhibit
