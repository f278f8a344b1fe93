// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/frame_builder.h"
#include "app/measurement.h"
#include "app/session_file.h"
#include "core/result.h"
#include "render/renderer.h"

namespace afm::app {

struct Figure {
  std::string file;     // "fig5a.png"
  std::string caption;  // what is seen
  Moment moment;
};

// The pictures (a) to (e) of the paper's Fig. 5, as moments of recorded sessions: the pull just after the jump to
// contact, the deepest push, the last moment before the jump off contact, the tip free again, and all curves together.
// `curves` receives one curve per material for each moment and must outlive the figures.
class FigurePlan {
 public:
  FigurePlan(const std::vector<RecordedSession>& sessions, const std::vector<Measurement>& measurements,
             std::size_t shown_material);

  const std::vector<Figure>& figures() const { return figures_; }

 private:
  std::vector<std::vector<CycleCurve>> curves_;  // one set per figure
  std::vector<Figure> figures_;
};

// Draws a figure side by side and writes it as PNG.
core::Result<void> draw_figure(const Figure& figure, const FrameBuilder& frames, render::Renderer& renderer,
                               const std::string& path);

}  // namespace afm::app
