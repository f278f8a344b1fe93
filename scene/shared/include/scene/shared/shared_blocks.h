// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "physics/contact_parameters.h"
#include "physics/contact_phase.h"
#include "physics/law.h"
#include "physics/law_tables.h"
#include "physics/lever_dynamics.h"
#include "scene/shared/fault_codes.h"
#include "scene/shared/scale_modes.h"

// The blocks of the shared scene: trivially copyable, without pointers, SI units, and each with exactly one writer, the
// process named in its comment. A reader believes nothing unchecked: indices are compared with counts, numbers with
// ranges.
namespace afm::scene {

inline constexpr std::uint32_t kMaxNodes = 128;
inline constexpr std::uint32_t kMaxMaterials = 32;
inline constexpr std::uint32_t kMaxMeasuredCurves = 4;
inline constexpr std::uint32_t kMaxMeasuredPoints = 512;  // of one branch
inline constexpr std::uint32_t kMaxHeightFields = 8;
inline constexpr std::uint32_t kMaxHeightFieldSide = 129;  // vertices
inline constexpr std::uint32_t kNameLength = 48;
inline constexpr std::uint32_t kNoParent = 0xFFFFFFFFU;
inline constexpr std::uint32_t kNoMeasuredCurve = 0xFFFFFFFFU;
inline constexpr std::uint32_t kNoHeightField = 0xFFFFFFFFU;

using Name = std::array<char, kNameLength>;  // zero-terminated UTF-8

// A name is for people: a longer one is cut.
Name to_name(std::string_view text);

// ---- constant after the segment is created (written by touchafm before the servo starts) ----

struct SharedNode {
  Name name{};
  std::uint32_t parent = kNoParent;
  std::uint32_t padding = 0;
  std::array<double, 16> parent_from_node{};  // column-major rest transform
};

// What is felt: one choice of tip, lever, sample and medium, and the law of force that they are given. The options of
// the law lie flat, because nobody can check the bytes of a std::optional.
struct SharedContact {
  Name name{};
  physics::ContactParameters contact{};
  physics::Law law = physics::Law::Paper;
  std::uint32_t measured_curve = kNoMeasuredCurve;  // index into SharedModel::curves, of Law::Measured alone
  std::uint32_t exact_hamaker_sphere = 0;           // 0 or 1
  std::uint32_t has_meniscus = 0;                   // 0 or 1
  double retardation_wavelength_m = 0;              // 0: not retarded
  physics::Meniscus meniscus{};
  std::uint32_t dynamic = 0;                    // 1: with the inertia, damping and thermal noise of the lever
  std::uint32_t height_field = kNoHeightField;  // index into SharedModel::height_fields; none: a plane
  physics::LeverDynamics lever{};
};

// A curve that an instrument recorded, to be felt: each branch along rising Z.
struct SharedMeasuredCurve {
  std::uint32_t approach_count = 0;
  std::uint32_t retract_count = 0;
  std::array<physics::MeasuredPoint, kMaxMeasuredPoints> approach{};
  std::array<physics::MeasuredPoint, kMaxMeasuredPoints> retract{};
};

// The surface of a sample as it is drawn: heights on a square grid that is centred on the origin of the sample's frame,
// row by row from -y to +y, x fastest; metres of the nanoworld along +z.
struct SharedHeightField {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double spacing_m = 0;
  std::array<float, kMaxHeightFieldSide * kMaxHeightFieldSide> height_m{};
};

struct SharedModel {
  std::uint32_t node_count = 0;
  std::uint32_t material_count = 0;
  std::uint32_t sample_node =
      0;  // its orientation turns the force: the axes of this node are those of its surface, +z outwards
  std::uint32_t curve_count = 0;
  std::uint32_t height_field_count = 0;
  std::uint32_t padding = 0;
  // the common scale, as in TipState; 0: the one that suits all of these materials. A replay has the one it was felt
  // on.
  double common_hand_m_per_m = 0;
  double common_hand_n_per_n = 0;
  std::array<SharedNode, kMaxNodes> nodes{};
  std::array<SharedContact, kMaxMaterials> materials{};
  std::array<SharedMeasuredCurve, kMaxMeasuredCurves> curves{};
  std::array<SharedHeightField, kMaxHeightFields> height_fields{};
};

// ---- written by touchafm ----

// Where every node is now: room from node, column-major, metres.
struct SceneTransforms {
  std::uint32_t count = 0;
  std::uint32_t padding = 0;
  std::array<std::array<double, 16>, kMaxNodes> room_from_node{};
};

// The material that the wand chose, and the scale on which it is to be felt. `revision` grows by one with every choice.
struct Selection {
  std::int32_t material = -1;  // index into SharedModel::materials, -1: none yet
  std::uint32_t revision = 0;
  ScaleMode scale_mode = ScaleMode::Fit;
  std::uint32_t padding = 0;
};

// Other parameters for one material while the servo runs. `revision` grows by one with every edit, of whichever
// material. It takes effect as a choice of a material does: once the tip is off the sample, without force, in the wait
// state.
struct MaterialEdit {
  SharedContact material{};
  std::uint32_t revision = 0;
  std::uint32_t padding = 0;
};

// What the simulated person does with the simulated hand; ignored by real devices. A new `revision` starts a
// minimum-jerk path of the hand's aim from where it is now to `target_m` (device frame, +y up, metres) in `duration_s`.
struct HandScript {
  std::array<double, 3> target_m{};
  double duration_s = 0;
  std::uint32_t revision = 0;
  std::uint32_t turn_on_pressed = 0;  // 1 while the Turn-On button is held
};

struct RendererHeartbeat {
  std::int64_t time_ns = 0;
  std::uint64_t frame = 0;
  std::uint32_t leaving = 0;  // 1: the renderer ends in good order; the servo releases the hand and ends too
  std::uint32_t padding = 0;
};

// ---- written by touchafm-servo ----

enum class ServoState : std::uint32_t { Disarmed = 0, Arming = 1, Running = 2, Fading = 3, Fault = 4 };

// What the servo saw of the process that draws.
enum class RendererLink : std::uint32_t {
  Absent = 0,  // has not shown a sign of life yet
  Alive = 1,
  Hung = 2,     // no heartbeat for too long
  Leaving = 3,  // said goodbye
  Died = 4,
};

// What the servo holds: limits as in haptics::DeviceSpec, places in the device frame from the contact point, metres.
// Stored once, when the servo starts.
struct SharedDevice {
  Name name{};
  double max_force_n = 0;
  double max_continuous_force_n = 0;
  double max_stiffness_n_per_m = 0;
  double max_slew_n_per_s = 0;     // infinite: no limit
  double max_speed_m_per_s = 0;    // likewise
  std::uint32_t has_own_hand = 0;  // 1: a person's, or a recorded one, which HandScript does not move
  std::uint32_t padding = 0;
  std::array<double, 3> workspace_min_m{};
  std::array<double, 3> workspace_max_m{};
};

// The newest state of the tip, once a tick. Heights along +z of the sample; forces on the tip, positive away from the
// sample; the hand's values in the device frame.
struct TipState {
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC at the device read
  std::uint64_t tick = 0;
  double z_m = 0;  // piezo displacement Z above the surface below the tip: what the hand commands
  double tip_height_m = 0;
  double deflection_m = 0;          // delta_c
  double sample_deformation_m = 0;  // delta_s
  double force_n = 0;               // on the tip, from the model
  std::array<double, 3> hand_position_m{};
  std::array<double, 3> hand_force_n{};  // after the safety governor: what the device got
  double hand_m_per_m = 0;               // position scale: metres of hand per metre of Z
  double hand_n_per_n = 0;               // force scale: newtons on the hand per newton on the tip
  double release_z_m = 0;                // Z at and above which the tip is free, whatever it did before
  double slow_motion = 1;                // seconds that a second of the lever's physics takes; 1 without dynamics
  std::array<double, 2> tip_xy_m{};      // the tip's place over the sample, in the sample's frame
  double surface_height_m = 0;           // of the surface below the tip, along +z of the sample
  std::array<double, 3> normal{0.0, 1.0, 0.0};  // outward normal of the surface below the tip, device frame, unit
  double force_cap_n = 0;                       // the longest force vector that may be given now
  double slew_limit_n_per_s = 0;
  double motor_heat = 0;        // 0: cold, 1: as hot as the motors may become
  double thermal_gain = 1;      // what is left of the force to let the motors cool
  double excess_energy_j = 0;   // energy that the hand has got beyond what the model and its sampling may give
  double observer_damping = 0;  // N s/m that the passivity observer adds in this tick
  ScaleMode scale_mode = ScaleMode::Fit;
  std::uint32_t dead_man = 0;  // 1: the force lasts only as long as the button is held
  ServoState servo_state = ServoState::Disarmed;
  physics::Phase phase = physics::Phase::WaitForLift;
  FaultCode fault = FaultCode::None;
  std::int32_t material = -1;
  std::uint32_t selection_revision = 0;  // the newest Selection that took effect
  std::uint32_t edit_revision = 0;       // the MaterialEdit that the material under the tip is felt with, 0: as loaded
  std::uint32_t edit_refused = 0;        // the newest MaterialEdit that cannot be felt
  std::uint32_t hand_revision = 0;       // the newest HandScript that was finished
  std::uint32_t realtime = 0;            // 1: SCHED_FIFO and locked pages were granted
  std::uint32_t garbage_blocks = 0;      // shared blocks refused as out of range
};

// Every tick, for curves and sessions.
struct TipSample {
  std::int64_t time_ns = 0;
  std::uint64_t tick = 0;
  double z_m = 0;
  double force_n = 0;
  double tip_height_m = 0;
  double deflection_m = 0;
  double sample_deformation_m = 0;
  double hand_height_m = 0;  // along the sample's normal, device frame
  double hand_force_n = 0;   // along the sample's normal, positive away from the sample, after the governor
  ServoState servo_state = ServoState::Disarmed;
  physics::Phase phase = physics::Phase::WaitForLift;
  std::int32_t material = -1;
  std::uint32_t wake_us = 0;        // how late this tick woke
  std::uint32_t edit_revision = 0;  // as in TipState
  std::uint32_t turn_on = 0;        // 1: the button was held
  RendererLink renderer = RendererLink::Absent;
  ScaleMode scale_mode = ScaleMode::Fit;
  // device frame, from the device's contact point: with turn_on, renderer and the sample's normal all that a replay
  // needs
  std::array<double, 3> hand_from_contact_m{};
  std::array<double, 3> sample_normal{0.0, 1.0, 0.0};  // +z of the sample's frame, unit
  std::array<double, 3> sample_x{1.0, 0.0, 0.0};       // +x of the sample's frame, unit
  std::array<double, 2> tip_xy_m{};                    // as in TipState
  double surface_height_m = 0;                         // as in TipState
  double motor_heat = 0;                               // as in TipState
  std::uint32_t device_healthy = 1;                    // 0: the device failed, and the hand's place is the last known
  std::uint32_t changing = 0;                          // 1: another choice, or an edit, has taken the force away
};

// A transition of the latch, at the place where the path crossed the fold inside the tick.
struct TipEvent {
  physics::EventKind kind = physics::EventKind::JumpToContact;
  std::int32_t material = -1;
  std::int64_t time_ns = 0;  // interpolated
  double z_m = 0;
  double force_before_n = 0;
  double force_after_n = 0;
};

// Wake-up lateness and work of every tick, microseconds; the last bin holds all that is longer.
inline constexpr std::uint32_t kHistogramBins = 2001;
struct ServoTiming {
  double rate_hz = 0;
  std::uint32_t policy_fifo = 0;  // 1: SCHED_FIFO
  std::uint32_t priority = 0;
  std::uint32_t pages_locked = 0;
  std::uint32_t padding = 0;
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;  // deadlines that passed without a tick
  std::uint32_t wake_max_us = 0;
  std::uint32_t work_max_us = 0;
  std::array<std::uint32_t, kHistogramBins> wake_us{};
  std::array<std::uint32_t, kHistogramBins> work_us{};
};

}  // namespace afm::scene
