// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::app {

class OptionList;

// Keeps a frame within a budget by drawing it coarser: first with fewer pixels, down to half of them each way, then
// with one sample a pixel. What is seen and where is left alone. A step coarser follows at once on frames that are too
// long; a step finer waits until the frame would leave room, and longer after each one that turned out to be too much.
// Frames are judged by the middle one of a few, so that a hiccup changes nothing.
class DynamicResolution {
 public:
  // `budget_ms` > 0; `samples` as the renderer was made with.
  DynamicResolution(double budget_ms, std::uint32_t samples);

  // Adds the time of the newest frame. True if the next frame has a different quality.
  bool add(double frame_ms);

  // Takes the time of the renderer's newest finished frame, sets its quality and logs a change.
  void follow(render::Renderer& renderer);

  const render::FrameQuality& quality() const { return steps_[step_]; }

  // "71 % of the pixels each way, 4 samples"; with what could not be held if nothing coarser is left.
  std::string text() const;

  // The same for the wall.
  render::DataRow row(const exhibit::Phrases& phrases) const;

 private:
  bool go(std::size_t step);
  bool over_budget() const {
    return step_ + 1 == steps_.size() && typical_ms_ > budget_ms_;
  }  // nothing coarser is left
  double finer_cost() const;

  double budget_ms_;
  std::vector<render::FrameQuality> steps_;  // finest first
  std::size_t step_ = 0;
  std::vector<double> recent_ms_;  // since the last change
  int steady_frames_ = 0;          // within the budget since then
  int patience_frames_;            // before a finer step is tried
  bool trying_ = false;            // the last change was to a finer step
  double typical_ms_ = 0;          // the middle one of recent_ms_, once there are enough
};

// --frame-budget MS; 0 without it.
void add_frame_budget(OptionList& command, double& budget_ms);

}  // namespace afm::app
