// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/shared_blocks.h"

namespace afm::app {

// One recorded cycle on one material: every tick's sample and every event, as the servo gave them.
struct RecordedSession {
  std::string material;                             // name in the material file
  scene::SharedMaterial parameters;                 // what was felt
  std::optional<scene::SharedMeasuredCurve> curve;  // of Law::Measured
  double rate_hz = 0;
  bool realtime = false;
  double hand_m_per_m = 0;  // position scale
  double hand_n_per_n = 0;  // force scale
  double slow_motion = 1;   // as in TipState
  std::vector<scene::TipSample> samples;
  std::vector<scene::TipEvent> events;

  double seconds_since_start(std::int64_t time_ns) const;
  const scene::TipEvent* find(scene::TipEventKind kind) const;  // the first one, or null
};

// A session file (.afms): "AFMS", a version, a JSON header with the material, its law, all parameters and the scales,
// then the samples and events as fixed-size little-endian records, then a 64-bit FNV-1a checksum of all that stands
// before it. Written whole or not at all.
core::Result<void> save_session(const RecordedSession& session, const std::string& path);

// Believes nothing unchecked: truncated, altered and foreign files, other versions, and numbers that are not finite are
// errors that name the file.
core::Result<RecordedSession> load_session(const std::string& path);

}  // namespace afm::app
