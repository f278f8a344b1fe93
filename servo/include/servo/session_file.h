// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/shared/felt_heights.h"
#include "scene/shared/tip_blocks.h"
#include "servo/wall_frame.h"

namespace afm::servo {

// Recording of one material, with everything that its forces depend on: every tick's sample and every event from the
// servo. The first sample follows a moment without force or motion that counts (haptics::ServoLoop), so that a replay
// gives the same forces bit for bit.
struct RecordedSession {
  std::string material;                             // name in the material file
  scene::SharedContact parameters;                  // what was felt; curve and surface are the only ones of a replay
  std::optional<scene::SharedMeasuredCurve> curve;  // of Law::Measured
  std::optional<scene::SharedHeightField> surface;  // none: a topography, or a plane
  scene::Topography topography;                     // without columns: none
  std::array<double, 16> room_from_sample{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // as in SceneTransforms
  scene::SharedDevice device;
  double rate_hz = 0;
  bool dead_man = false;
  bool realtime = false;
  double hand_m_per_m = 0;  // position scale
  double hand_n_per_n = 0;  // force scale
  double slow_motion = 1;   // as in TipState
  std::vector<scene::TipSample> samples;
  std::vector<scene::TipEvent> events;
  std::vector<std::string> shown;            // the materials on the wall, by name
  std::vector<EarlierCurve> earlier_curves;  // on the wall when the session began
  std::vector<WallFrame> wall;               // of a live window, in the order of their times; else none
  bool complete = true;                      // false: the file was cut, and this is what it still holds

  double seconds_since_start(std::int64_t time_ns) const;
  const scene::TipEvent* find(physics::EventKind kind) const;  // the first one, or null
};

// The scene of a session for a servo that is to feel it again: one node, the sample, and its material twice, because
// the session may end with the choice of another.
std::unique_ptr<scene::SharedModel> model_of(const RecordedSession& session);

// A session file (.afms): JSON and fixed-size records with checksums. Written whole or not at all.
core::Result<void> save_session(const RecordedSession& session, const std::string& path);

// Files of every version since TouchAFM 0.1.0. Believes nothing unchecked: altered and foreign files, other versions,
// and numbers that are not finite are errors that name the file. One that was cut holds what came before.
core::Result<RecordedSession> load_session(const std::string& path);

// Whether a regular file begins as a session does.
bool is_session_file(const std::string& path);

// Message about a session that is not complete.
std::string cut_text(const RecordedSession& session, const std::string& path);

}  // namespace afm::servo
