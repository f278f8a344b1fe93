// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/render_subjects.h"
#include "core/clock.h"
#include "core/percentiles.h"
#include "core/result.h"
#include "render/renderer.h"

namespace afm::app {

struct RenderTimingPlan {
  int rounds = 5;
  int frames = 12;  // of each way in each round
  std::uint32_t samples = 4;
  std::vector<std::string> peers;  // shell commands that print a JSON object with "frame_ms"
};

// One way of drawing one subject, or a peer.
struct RenderFigure {
  std::string subject, way;
  core::Percentiles frame_ms{};
  double ratio = 1.0;                          // of the medians of the rounds to those of the subject's first way
  double redrawn = 0;                          // share of the eyes' pixels, the mean of the frames
  double processor_ms = 0;                     // of all threads of the process, a frame; median of the rounds
  std::optional<render::PassTimes> pass_ms{};  // medians; a round composes and reads back one picture, side by side
  std::vector<double> round_ms{};              // the median of each round
};

struct RenderFigures {
  std::string device;
  std::vector<RenderFigure> figures;
  double memory_before_bytes = 0,
         memory_after_bytes = 0;  // resident, once everything had been drawn once, and at the end
};

// Draws every subject in every way, and runs the peers, in turn in each round, so that a load on the machine hits all
// of them alike. Two frames are in flight: a frame's time is that from the end of one render() to that of the next.
core::Result<RenderFigures> time_rendering(const std::vector<RenderSubject>& subjects, const RenderTimingPlan& plan,
                                           const core::Clock& clock);

// Runs a shell command and takes the time that it prints; the error names the command.
core::Result<double> printed_frame_ms(const std::string& command);

}  // namespace afm::app
