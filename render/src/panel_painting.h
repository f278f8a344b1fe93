// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "canvas.h"
#include "render/frame.h"

namespace afm::render {

void paint(Canvas& canvas, const ForcePanel& panel);
void paint(Canvas& canvas, const DataPanel& panel);
void paint(Canvas& canvas, const Banner& banner);
void paint(Canvas& canvas, const ControlPanel& panel);
void paint(Canvas& canvas, const Label& label);

}  // namespace afm::render
