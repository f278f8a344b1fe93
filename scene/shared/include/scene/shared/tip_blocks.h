// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "scene/shared/field_visitor.h"
#include "scene/shared/shared_blocks.h"

// State of the tip that touchafm-servo publishes every tick. Fields shared by several blocks are one struct. A new
// field takes one line in the struct, one in its description and one in ServoLoop::publish().
namespace afm::scene {

// Tip and lever, computed by the force law. Heights along +z of the sample.
struct Tip {
  double z_m = 0;      // piezo displacement Z above the surface below the tip: the input from the hand
  double force_n = 0;  // force on the tip, positive away from the sample; tapping: mean over a swing
  double height_m = 0;
  double deflection_m = 0;          // delta_c, deflection of the lever, positive towards the sample
  double sample_deformation_m = 0;  // delta_s, deformation of the sample
};

template <class Visit, RecordOf<Tip>... Record>
constexpr void for_each_field(Visit&& visit, Record&... tip) {
  visit("z_m", tip.z_m...);
  visit("force_N", tip.force_n...);
  visit("tip_height_m", tip.height_m...);
  visit("deflection_m", tip.deflection_m...);
  visit("sample_deformation_m", tip.sample_deformation_m...);
}
static_assert(all_fields_described<Tip>());

// Swing of a lever in tapping mode; zero without tapping.
struct Swing {
  double amplitude_m = 0;  // zero-to-peak amplitude
  double phase_rad = 0;    // lag behind the drive
};

template <class Visit, RecordOf<Swing>... Record>
constexpr void for_each_field(Visit&& visit, Record&... swing) {
  visit("amplitude_m", swing.amplitude_m...);
  visit("phase_rad", swing.phase_rad...);
}
static_assert(all_fields_described<Swing>());

// Point of the sample's surface below the tip, in the sample's frame. The heights of a Tip are measured from it.
struct SurfacePoint {
  std::array<double, 2> xy_m{};
  double height_m = 0;
};

template <class Visit, RecordOf<SurfacePoint>... Record>
constexpr void for_each_field(Visit&& visit, Record&... surface) {
  visit("tip_x_m", surface.xy_m[0]...);
  visit("tip_y_m", surface.xy_m[1]...);
  visit("surface_height_m", surface.height_m...);
}
static_assert(all_fields_described<SurfacePoint>());

// Hand, in the device frame, as reported by the device.
struct HandState {
  std::array<double, 3> position_m{};
  std::array<double, 3> force_n{};  // force sent to the device, after the safety governor
};

template <class Visit, RecordOf<HandState>... Record>
constexpr void for_each_field(Visit&& visit, Record&... hand) {
  visit("hand_position_m", hand.position_m...);
  visit("hand_force_N", hand.force_n...);
}
static_assert(all_fields_described<HandState>());

// Scale of the hand: metres of hand per metre of Z, newtons on the hand per newton on the tip.
struct HandScale {
  double hand_m_per_m = 0;
  double hand_n_per_n = 0;
};

template <class Visit, RecordOf<HandScale>... Record>
constexpr void for_each_field(Visit&& visit, Record&... scale) {
  visit("hand_m_per_m", scale.hand_m_per_m...);
  visit("hand_N_per_N", scale.hand_n_per_n...);
}
static_assert(all_fields_described<HandScale>());

// Current contact model under the tip.
struct ActiveContact {
  HandScale scale{};
  double release_z_m = 0;  // Z at and above which the tip is always free
  double slow_motion = 1;  // duration of a second of the lever's physics, in seconds; 1 without dynamics
  ScaleMode scale_mode = ScaleMode::Fit;
  std::uint32_t edit_revision = 0;  // revision of the MaterialEdit in effect; 0: none
};

template <class Visit, RecordOf<ActiveContact>... Record>
constexpr void for_each_field(Visit&& visit, Record&... active) {
  visit("scale", active.scale...);
  visit("release_z_m", active.release_z_m...);
  visit("slow_motion", active.slow_motion...);
  visit("scale_mode", active.scale_mode...);
  visit("edit_revision", active.edit_revision...);
}
static_assert(all_fields_described<ActiveContact>());

// Law below the tip, as felt, for a material whose modulus and adhesion vary from place to place; zero for any other.
struct LawHere {
  double reduced_modulus_pa = 0;  // reduced modulus E*
  double adhesion_j_per_m2 = 0;   // work of adhesion W
};
template <class Visit, RecordOf<LawHere>... Record>
constexpr void for_each_field(Visit&& visit, Record&... here) {
  visit("reduced_modulus_Pa", here.reduced_modulus_pa...);
  visit("adhesion_J_per_m2", here.adhesion_j_per_m2...);
}
static_assert(all_fields_described<LawHere>());

// Limits on the force on the hand, from the safety governor.
struct SafetyFigures {
  double force_cap_n = 0;  // current limit on the force vector
  double slew_limit_n_per_s = 0;
  double motor_heat = 0;                  // 0: cold; 1: at the limit of the motors
  double thermal_gain = 1;                // fraction of the force that remains while the motors cool
  double excess_energy_j = 0;             // energy given to the hand beyond what the model and its sampling allow
  double observer_damping_n_s_per_m = 0;  // damping added by the passivity observer in this tick
};

template <class Visit, RecordOf<SafetyFigures>... Record>
constexpr void for_each_field(Visit&& visit, Record&... safety) {
  visit("force_cap_N", safety.force_cap_n...);
  visit("slew_limit_N_per_s", safety.slew_limit_n_per_s...);
  visit("motor_heat", safety.motor_heat...);
  visit("thermal_gain", safety.thermal_gain...);
  visit("excess_energy_J", safety.excess_energy_j...);
  visit("observer_damping_N_s_per_m", safety.observer_damping_n_s_per_m...);
}
static_assert(all_fields_described<SafetyFigures>());

// Newest requests of the renderer that the servo has handled.
struct Acknowledged {
  std::uint32_t selection = 0;     // revision of the newest Selection in effect
  std::uint32_t refused_edit = 0;  // revision of the newest MaterialEdit that cannot be built
  std::uint32_t hand_script = 0;   // revision of the newest HandScript that is finished
};

template <class Visit, RecordOf<Acknowledged>... Record>
constexpr void for_each_field(Visit&& visit, Record&... acknowledged) {
  visit("selection", acknowledged.selection...);
  visit("refused_edit", acknowledged.refused_edit...);
  visit("hand_script", acknowledged.hand_script...);
}
static_assert(all_fields_described<Acknowledged>());

// Newest state of the tip, once per tick, grouped by the code that computes it.
struct TipState {
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC time at which the device was read
  std::uint64_t tick = 0;
  Tip tip{};
  Swing swing{};
  SurfacePoint surface{};
  std::array<double, 3> normal{0.0, 1.0, 0.0};  // outward unit normal of the surface below the tip, device frame
  HandState hand{};
  ActiveContact active{};
  LawHere here{};
  SafetyFigures safety{};
  std::int32_t material = -1;
  physics::Phase phase = physics::Phase::WaitForLift;
  ServoState servo_state = ServoState::Disarmed;
  FaultCode fault = FaultCode::None;
  Acknowledged acknowledged{};
  std::uint32_t dead_man = 0;        // 1: the force lasts only while the button is held
  std::uint32_t realtime = 0;        // 1: SCHED_FIFO and locked pages were granted
  std::uint32_t garbage_blocks = 0;  // shared blocks rejected as out of range
  std::uint32_t led = 0;             // 1: hand led by the scan
  std::uint32_t lead_lost = 0;       // 1: lead lost; resumes once Turn-On is released
  std::uint32_t level = 0;           // 1: sample felt level, due to a scan's feedback
  std::uint64_t presses = 0;         // number of presses of Turn-On since the servo started
};

template <class Visit, RecordOf<TipState>... Record>
constexpr void for_each_field(Visit&& visit, Record&... state) {
  visit("time_ns", state.time_ns...);
  visit("tick", state.tick...);
  visit("tip", state.tip...);
  visit("swing", state.swing...);
  visit("surface", state.surface...);
  visit("normal", state.normal...);
  visit("hand", state.hand...);
  visit("active", state.active...);
  visit("here", state.here...);
  visit("safety", state.safety...);
  visit("material", state.material...);
  visit("phase", state.phase...);
  visit("servo_state", state.servo_state...);
  visit("fault", state.fault...);
  visit("acknowledged", state.acknowledged...);
  visit("dead_man", state.dead_man...);
  visit("realtime", state.realtime...);
  visit("garbage_blocks", state.garbage_blocks...);
  visit("led", state.led...);
  visit("lead_lost", state.lead_lost...);
  visit("level", state.level...);
  visit("presses", state.presses...);
}
static_assert(all_fields_described<TipState>());

template <class Visit, RecordOf<ScanLead>... Record>
constexpr void for_each_field(Visit&& visit, Record&... lead) {
  visit("scan_time_ns", lead.time_ns...);
  visit("scan_apex_m", lead.apex_xy_m...);
  visit("scan_height_m", lead.height_m...);
  visit("scan_gain_per_s", lead.gain_per_s...);
  visit("scan_hand", lead.hand...);
  visit("scan_feedback", lead.feedback...);
  visit("scan_revision", lead.revision...);
  visit("scan_load_pN", lead.load_pn...);
}
static_assert(all_fields_described<ScanLead>());

// State from which a picture of the particles at level 1 or 2 is computed, recorded in every tick.
struct LevelSample {
  std::int64_t since_ns = 0;  // start of the drift; 0: none
  std::uint64_t met = 0;      // `met` of TipPush; 0 at level 0
};

template <class Visit, RecordOf<LevelSample>... Record>
constexpr void for_each_field(Visit&& visit, Record&... level) {
  visit("drift_since_ns", level.since_ns...);
  visit("met", level.met...);
}
static_assert(all_fields_described<LevelSample>());

// Part of a push that is recorded in every tick.
struct PushSample {
  std::uint64_t digest = 0;           // `digest` of TipPush; 0: neither particles nor marks
  std::array<double, 2> lateral_n{};  // force on the lever, along the sample's x and y
  double lift_n = 0;
  double normal_n = 0;
  std::int32_t particle = kNoParticle;
  physics::PushState state = physics::PushState::Free;
};

template <class Visit, RecordOf<PushSample>... Record>
constexpr void for_each_field(Visit&& visit, Record&... push) {
  visit("particle_digest", push.digest...);
  visit("push_x_N", push.lateral_n[0]...);
  visit("push_y_N", push.lateral_n[1]...);
  visit("push_lift_N", push.lift_n...);
  visit("push_normal_N", push.normal_n...);
  visit("pushed_particle", push.particle...);
  visit("push_state", push.state...);
}
static_assert(all_fields_described<PushSample>());

// Record of every tick, for curves and sessions. Its bytes are the record of a session file (servo/session_file.h): a
// new field requires a new version of that format.
struct TipSample {
  std::int64_t time_ns = 0;
  std::uint64_t tick = 0;
  Tip tip{};
  double hand_height_m = 0;  // height along the sample's normal, device frame
  double hand_force_n = 0;   // force along the sample's normal, positive away from the sample, after the governor
  ServoState servo_state = ServoState::Disarmed;
  physics::Phase phase = physics::Phase::WaitForLift;
  std::int32_t material = -1;
  std::uint32_t wake_us = 0;        // wake-up lateness of this tick
  std::uint32_t edit_revision = 0;  // revision of the MaterialEdit in effect; 0: none
  std::uint32_t turn_on = 0;        // 1: the button was held
  RendererLink renderer = RendererLink::Absent;
  ScaleMode scale_mode = ScaleMode::Fit;
  // device frame, from the device's contact point; with turn_on, renderer and the sample's normal, all inputs that a
  // replay needs
  std::array<double, 3> hand_from_contact_m{};
  std::array<double, 3> sample_normal{0.0, 1.0, 0.0};  // unit vector +z of the sample's frame
  std::array<double, 3> sample_x{1.0, 0.0, 0.0};       // unit vector +x of the sample's frame
  SurfacePoint surface{};
  double motor_heat = 0;                    // 0: cold; 1: at the limit of the motors
  std::uint32_t device_healthy = 1;         // 0: failed device; the hand's position is the last known one
  std::uint32_t changing = 0;               // 1: force removed for a selection or an edit
  std::array<double, 2> lateral_force_n{};  // friction of the sample on the lever, along the sample's x and y
  ScanLead scan{};                          // scan in effect in this tick; default: none
  PushSample push{};                        // push of particles in this tick; default: none
  Swing swing{};                            // swing of the lever; default: no tapping
  PlannedPush plan{};                       // plan in effect in this tick; default: none
  std::array<double, 2> guide_n{};  // force of the plan's groove on the hand before limits, along the sample's x and y
  LevelSample level{};              // state of the particles' picture; default: level 0
  PushSettings settings{};          // settings in use; absent from session files, whose particles already have them
  std::uint32_t padding = 0;
};

// Results of the tick: a replay must reproduce them bit for bit.
template <class Visit, RecordOf<TipSample>... Record>
constexpr void for_each_result(Visit&& visit, Record&... sample) {
  visit("tip", sample.tip...);
  visit("hand_height_m", sample.hand_height_m...);
  visit("hand_force_N", sample.hand_force_n...);
  visit("servo_state", sample.servo_state...);
  visit("phase", sample.phase...);
  visit("surface", sample.surface...);
  visit("lateral_x_N", sample.lateral_force_n[0]...);
  visit("lateral_y_N", sample.lateral_force_n[1]...);
  visit("push", sample.push...);
  visit("swing", sample.swing...);
  visit("guide_x_N", sample.guide_n[0]...);
  visit("guide_y_N", sample.guide_n[1]...);
  visit("level", sample.level...);
}

// Inputs of the tick: a replay starts from them.
template <class Visit, RecordOf<TipSample>... Record>
constexpr void for_each_input(Visit&& visit, Record&... sample) {
  visit("time_ns", sample.time_ns...);
  visit("tick", sample.tick...);
  visit("material", sample.material...);
  visit("wake_us", sample.wake_us...);
  visit("edit_revision", sample.edit_revision...);
  visit("turn_on", sample.turn_on...);
  visit("renderer", sample.renderer...);
  visit("scale_mode", sample.scale_mode...);
  visit("hand_from_contact_m", sample.hand_from_contact_m...);
  visit("sample_normal", sample.sample_normal...);
  visit("sample_x", sample.sample_x...);
  visit("motor_heat", sample.motor_heat...);
  visit("device_healthy", sample.device_healthy...);
  visit("changing", sample.changing...);
  visit("scan", sample.scan...);
  visit("plan", sample.plan...);
  visit("settings", sample.settings...);
  visit("padding", sample.padding...);
}

template <class Visit, RecordOf<TipSample>... Record>
constexpr void for_each_field(Visit&& visit, Record&... sample) {
  for_each_result(visit, sample...);
  for_each_input(visit, sample...);
}
static_assert(all_fields_described<TipSample>());

// Transition of the latch, at the point where the path crossed the fold within the tick; or a slip between atoms,
// where the forces are the magnitudes of the lateral force before and after.
struct TipEvent {
  physics::EventKind kind = physics::EventKind::JumpToContact;
  std::int32_t material = -1;
  std::int64_t time_ns = 0;  // interpolated within the tick
  double z_m = 0;
  double force_before_n = 0;
  double force_after_n = 0;
};

template <class Visit, RecordOf<TipEvent>... Record>
constexpr void for_each_result(Visit&& visit, Record&... event) {
  visit("kind", event.kind...);
  visit("time_ns", event.time_ns...);
  visit("z_m", event.z_m...);
  visit("force_before_N", event.force_before_n...);
  visit("force_after_N", event.force_after_n...);
}

template <class Visit, RecordOf<TipEvent>... Record>
constexpr void for_each_field(Visit&& visit, Record&... event) {
  for_each_result(visit, event...);
  visit("material", event.material...);
}
static_assert(all_fields_described<TipEvent>());

}  // namespace afm::scene
