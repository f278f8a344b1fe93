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
  int frames = 12;  // number per way and round
  std::uint32_t samples = 4;
  render::Lighting lighting = render::Lighting::Studio;
  std::string gpu{};               // graphics device, as named in render::ContextOptions
  std::vector<std::string> peers;  // shell commands that print a JSON object with "frame_ms"
};

// One way of drawing one subject, or a peer.
struct RenderFigure {
  std::string subject, way;
  std::uint32_t things = 0;  // number of RenderSubject::things
  core::Percentiles frame_ms{};
  double ratio = 1.0;                          // median over the rounds of the ratio to the subject's first way
  double redrawn = 0;                          // fraction of the eyes' pixels redrawn, averaged over the frames
  double processor_ms = 0;                     // time per frame, all threads of the process; median of the rounds
  std::optional<render::PassTimes> pass_ms{};  // medians; each round composes and reads back one side-by-side picture
  std::vector<double> round_ms{};              // median of each round
};

struct RenderFigures {
  std::string device;
  std::vector<RenderFigure> figures;
  double memory_before_bytes = 0,
         memory_after_bytes = 0;  // resident memory after everything has been drawn once, and at the end
};

// Draws every subject in every way, growing series only in the first way, and runs the peers, in turn in each
// round, so that other load on the machine affects all of them equally. Two frames are in flight: a frame's time is
// the time from the end of one render() to the end of the next.
core::Result<RenderFigures> time_rendering(const std::vector<RenderSubject>& subjects, const RenderTimingPlan& plan,
                                           const core::Clock& clock);

// Runs a shell command and returns the time that it prints. The error names the command.
core::Result<double> printed_frame_ms(const std::string& command);

}  // namespace afm::app
