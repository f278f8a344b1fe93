// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "exhibit/friction/friction_history.h"
#include "exhibit/state/cycle_curve.h"
#include "exhibit/state/moment.h"
#include "scene/display/wall.h"
#include "scene/shared/pose.h"
#include "servo/session_file.h"

namespace afm::exhibit {

struct LinesToWrite;
struct ScanProgress;

// The live wall at one moment, for a session. `materials` are the names of those on the wall. The caller adds the
// sample's place, the head and the modes.
servo::WallFrame wall_frame_of(const Moment& moment, std::int64_t time_ns, std::span<const std::string> materials);

// The scan of a frame, which must have WallFrame::scan. The result may be invalid: check it with LiveScan::valid().
ScanProgress scan_progress_of(const servo::WallFrame& frame);

// Conversion of lines to be written between the program's form and that of sessions.
servo::RecordedLines recorded_lines(const LinesToWrite& lines);
LinesToWrite lines_of(const servo::RecordedLines& recorded);

// Conversion of a head between the program's form and that of messages and sessions.
scene::Pose pose_of(const scene::HeadPose& head);
scene::HeadPose head_of(const scene::Pose& pose);

// A moment of the live wall, read from its session.
struct RecordedMoment {
  const servo::WallFrame* frame = nullptr;  // frame of the session
  std::vector<CycleCurve> curves;           // curves at that time, one per material
  FrictionHistory friction;
  Moment moment;  // moment without the curves
};

// The frame on the wall at `time_ns`, or the first one after it. The session must contain frames. `materials` are the
// names of those drawn now, which must include the session's own.
RecordedMoment moment_on_wall(const servo::RecordedSession& session, std::span<const std::string> materials,
                              std::int64_t time_ns);

}  // namespace afm::exhibit
