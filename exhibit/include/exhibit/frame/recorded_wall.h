// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "exhibit/friction/friction_history.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/state/cycle_curve.h"
#include "exhibit/state/moment.h"
#include "scene/display/wall.h"
#include "scene/shared/pose.h"
#include "servo/session_file.h"

namespace afm::exhibit {

// A moment of the live wall as a session records it; `materials` are the names of those on it. The caller adds the
// place of the sample, the head and the modes.
servo::WallFrame wall_frame_of(const Moment& moment, std::int64_t time_ns, std::span<const std::string> materials);

// The scan of a frame; WallFrame::scan must be there. It may be no valid one: LiveScan::valid().
ScanProgress scan_progress_of(const servo::WallFrame& frame);

// A head as messages and sessions hold it, and back.
scene::Pose pose_of(const scene::HeadPose& head);
scene::HeadPose head_of(const scene::Pose& pose);

// A moment of the live wall, taken from its session.
struct RecordedMoment {
  const servo::WallFrame* frame = nullptr;  // of the session
  std::vector<CycleCurve> curves;           // one per material, as they were
  FrictionHistory friction;
  Moment moment;  // without the curves
};

// The frame that was on the wall at `time_ns`, or the first one after it. The session must hold frames, and one of
// `materials`, the names of those that are drawn now, must be its own.
RecordedMoment moment_on_wall(const servo::RecordedSession& session, std::span<const std::string> materials,
                              std::int64_t time_ns);

}  // namespace afm::exhibit
