// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "exhibit/state/cycle_curve.h"
#include "exhibit/state/wall_state.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"
#include "servo/session_file.h"

namespace afm::exhibit {

// Events of a finished cycle, magnitudes.
struct CycleResult {
  std::string title;
  std::string law;  // word of the force law, such as "dmt"
  bool hysteretic = true;
  double f_attr_n = 0, f_ad_n = 0, z_jtc_m = 0, z_joc_m = 0;
  bool taps = false;  // true: lever in tapping mode, whose jumps have only heights
};

class LiveScan;

// One moment of the demonstration, from the live servo or from a session: everything that the wall shows.
struct Moment {
  WallState wall;
  scene::ServoState servo_state = scene::ServoState::Disarmed;
  bool stopped = false;  // true: Fault caused by a person's Stop
  physics::Phase phase = physics::Phase::WaitForLift;
  bool by_wand = false;     // true: pointing with a wand; false: with a mouse
  bool retracting = false;  // true: after the deepest push of this cycle
  bool realtime = false;
  double slow_motion = 1;  // factor as in scene::ActiveContact
  std::string guidance;
  std::string letters;                 // labels of the keyboard, as render::Window::letters() returns them
  std::vector<render::DataRow> servo;  // rows from servo_rows()
  // curves of all materials, empty until felt; the current one is drawn in front
  std::span<const CycleCurve> curves;
  const LiveScan* scan = nullptr;    // scan whose images replace the curves; may be null
  std::vector<CycleResult> results;  // results of the finished cycles, for Centerpiece::Plot
};

template <class Visit, scene::RecordOf<Moment>... Record>
constexpr void for_each_field(Visit&& visit, Record&... moment) {
  visit("wall", moment.wall...);
  visit("servo_state", moment.servo_state...);
  visit("stopped", moment.stopped...);
  visit("phase", moment.phase...);
  visit("by_wand", moment.by_wand...);
  visit("retracting", moment.retracting...);
  visit("realtime", moment.realtime...);
  visit("slow_motion", moment.slow_motion...);
  visit("guidance", moment.guidance...);
  visit("letters", moment.letters...);
  visit("servo", moment.servo...);
  visit("curves", moment.curves...);
  visit("scan", moment.scan...);
  visit("results", moment.results...);
}
static_assert(scene::all_fields_described<Moment>());

// True if a person has stopped the force: no fault, though its state is the same.
bool is_stopped(const scene::TipState& tip);

// Word for the state of the force.
Phrase state_phrase(scene::ServoState state, bool stopped);

// The moment for the newest state of the tip.
Moment moment_of(const scene::TipState& tip, bool retracting);

// The moment of a session at `time_ns`, as on the live wall. `curves` has one entry per material.
Moment moment_of(const servo::RecordedSession& session, std::size_t material, std::int64_t time_ns,
                 std::span<const CycleCurve> curves);

// True if the tip is on its way back from the deepest push of its cycle.
bool is_retracting(double z_m, double deepest_z_m);

}  // namespace afm::exhibit
