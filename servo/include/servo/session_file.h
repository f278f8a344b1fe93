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
#include "servo/recorded_force_map.h"
#include "servo/wall_frame.h"

namespace afm::servo {

// Places in a picture at a moment, in the scanner's frame, and the times at which they were measured, as in TipState.
struct PictureState {
  std::vector<scene::ParticlePage> shown{}, measured{};  // pages_of() the particles
  std::vector<std::int64_t> seen_ns{};                   // time at which each particle was measured

  bool empty() const { return seen_ns.empty(); }
};

// Particles on a sample, and their poses when the session began, or a soft sample or ink with its marks. The tip was
// off them.
struct RecordedParticles {
  scene::SharedParticles set;
  std::vector<scene::ParticlePage> pages;  // poses, pages_of(set.count) pages
  std::vector<scene::MarkTile> tiles{};    // marks of a soft sample or of ink, kMarkTiles tiles
  PictureState picture{};                  // picture at level 1 and 2; empty: all measured at the first tick
};

// Recording of one material, with everything that its forces depend on: every tick's sample and every event of the
// servo. The first sample follows a state without force or relevant motion (haptics::ServoLoop), so that a replay gives
// the same forces bit for bit.
struct RecordedSession {
  std::string material;             // name of the material in its file
  scene::SharedContact parameters;  // parameters in effect; a replay has one curve and one surface at most
  std::string sources{};  // sources of the parameters, curves::felt_sources(); empty: a file of 0.2.0 or older
  std::optional<scene::SharedMeasuredCurve> curve;     // recorded curve, only for Law::Measured
  std::optional<scene::SharedHeightField> surface;     // height field; empty: the sample is a topography or a plane
  scene::Topography topography;                        // topography; no columns: none
  std::shared_ptr<const scene::SharedLawMap> law_map;  // map of moduli and adhesions for parameters.law_map; null: none
  std::optional<RecordedForceMap> force_map;           // file of the map of law_map or curve; empty: none, or older
  std::optional<RecordedParticles> particles;
  bool has_plans = false;  // true: the samples have the plans of pushes; false: none, or an older file
  std::array<double, 16> room_from_sample{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // as in SceneTransforms
  scene::SharedDevice device;
  double rate_hz = 0;
  bool dead_man = false;
  bool realtime = false;
  double hand_m_per_m = 0;  // scale of positions
  double hand_n_per_n = 0;  // scale of forces
  double slow_motion = 1;   // slow-motion factor, as in TipState
  std::vector<scene::TipSample> samples;
  std::vector<scene::TipEvent> events;
  std::vector<std::string> shown;            // names of the materials on the wall
  std::vector<EarlierCurve> earlier_curves;  // curves that were on the wall when the session began
  std::vector<WallFrame> wall;               // frames of the live window, in time order
  bool complete = true;                      // false: the file was cut, and this session is its beginning

  double seconds_since_start(std::int64_t time_ns) const;
  const scene::TipEvent* find(physics::EventKind kind) const;  // first event of that kind, or null
};

// Scene of a session for a servo that replays it: one node, the sample, and its material twice, because the session may
// end with the selection of another.
std::unique_ptr<scene::SharedModel> model_of(const RecordedSession& session);

// Writes a session file (.afms): JSON and fixed-size records with checksums. Written completely or not at all.
core::Result<void> save_session(const RecordedSession& session, const std::string& path);

// Reads files of every version since TouchAFM 0.1.0. All input is checked: altered or foreign files, other versions,
// and numbers that are not finite are errors that name the file. A file that was cut yields its beginning.
core::Result<RecordedSession> load_session(const std::string& path);

// True for a regular file that begins like a session.
bool is_session_file(const std::string& path);

// Message about an incomplete session.
std::string cut_text(const RecordedSession& session, const std::string& path);

}  // namespace afm::servo
