// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "render/frame.h"

namespace afm::exhibit {
class Phrases;
}
namespace afm::render {
class Context;
class Renderer;
}  // namespace afm::render

namespace afm::app {

class OptionList;

// Keeps frames within a time budget by lowering the quality: first fewer pixels, down to half of them each way, then
// one sample per pixel. Content and geometry of the picture do not change. Steps down at once if frames take too long,
// past every resolution that cannot fit; steps up only when the finer frame is predicted to fit, and waits longer after
// each failed attempt. Judges the median of a few frames, so that a single slow one has no effect.
class DynamicResolution {
 public:
  // `budget_ms` > 0; `samples` is the renderer's setting.
  DynamicResolution(double budget_ms, std::uint32_t samples);

  // Adds the time of the newest frame. True if the next frame has a different quality.
  bool add(double frame_ms);

  // Call before there is a force, with the first frame: draws it with the least quality. Drivers compile shaders for it
  // at first use, which would stop a busy machine's picture for seconds just when it is slow.
  void rehearse(render::Renderer& renderer, const render::FrameState& frame) const;

  // Takes the time of the renderer's newest finished frame, sets the renderer's quality and logs a change.
  void follow(render::Renderer& renderer);

  const render::FrameQuality& quality() const { return steps_[step_]; }

  // True if the picture is coarser than it could be.
  bool reduced() const { return step_ > 0; }

  // "71 % of the pixels each way, 4 samples"; adds a missed budget if no coarser step is left.
  std::string text() const;

  // The same text for the wall.
  render::DataRow row(const exhibit::Phrases& phrases) const;

 private:
  bool go(std::size_t step);
  bool over_budget() const {
    return step_ + 1 == steps_.size() && typical_ms_ > budget_ms_;
  }  // true if no coarser step is left
  std::size_t coarser_step() const;
  double finer_cost() const;

  double budget_ms_;
  std::vector<render::FrameQuality> steps_;  // steps from fine to coarse
  std::size_t step_ = 0;
  std::vector<double> recent_ms_;  // times since the last change
  int steady_frames_ = 0;          // number of frames within the budget since the last change
  int patience_frames_;            // number of steady frames before a finer step
  bool trying_ = false;            // true: last change to a finer step
  double typical_ms_ = 0;          // median of recent_ms_; 0 until there are enough
};

// Adds --frame-budget; `budget_ms` stays empty without it, and is 0 for none.
void add_frame_budget(OptionList& command, std::optional<double>& budget_ms);

// Budget in ms for live pictures, 0 for none: the given one; otherwise one that keeps a picture moving if a processor
// draws it, and none on a GPU or for a size fixed by a person.
double frame_budget_ms(std::optional<double> given_ms, bool fixed_size, const render::Context& context);

}  // namespace afm::app
