// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "physics/contact_parameters.h"
#include "physics/contact_phase.h"
#include "physics/friction/friction.h"
#include "physics/law.h"
#include "physics/law_tables.h"
#include "physics/lever_dynamics.h"
#include "scene/shared/fault_codes.h"
#include "scene/shared/name.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/scale_modes.h"

// Blocks of the shared scene: trivially copyable, without pointers, in SI units, each with exactly one writer, the
// process named in its comment. Readers check everything: indices against counts, numbers against ranges.
namespace afm::scene {

enum class MapVibration : std::uint32_t;  // scene/shared/map_vibration.h

inline constexpr std::uint32_t kMaxNodes = 160;
inline constexpr std::uint32_t kMaxMaterials = 32;
inline constexpr std::uint32_t kMaxMeasuredCurves = 4;
inline constexpr std::uint32_t kMaxMeasuredPoints = 512;  // points of each branch
inline constexpr std::uint32_t kMaxHeightFields = 8;
inline constexpr std::uint32_t kMaxHeightFieldSide = 129;  // largest number of vertices on a side
inline constexpr std::uint32_t kMaxTopographySide = 1024;  // largest number of points on a side
inline constexpr std::uint32_t kMaxLawMapSide = 128;       // largest number of points on a side
inline constexpr std::uint32_t kNoParent = 0xFFFFFFFFU;
inline constexpr std::uint32_t kNoMeasuredCurve = 0xFFFFFFFFU;
inline constexpr std::uint32_t kNoHeightField = 0xFFFFFFFFU;
inline constexpr std::uint32_t kTopography = 0xFFFFFFFEU;  // value that selects the segment's topography

// ---- constant after the segment is created (written by touchafm before the servo starts) ----

struct SharedNode {
  Name name{};
  std::uint32_t parent = kNoParent;
  std::uint32_t padding = 0;
  std::array<double, 16> parent_from_node{};  // column-major rest transform
};

// Metres of the nanoworld, drawn and felt, per metre measured by the instrument: lateral and vertical.
struct TopographyScale {
  double lateral = 1;
  double vertical = 1;
};

// Session version whose answers a lever that taps has, so that older sessions replay bit for bit. Version10:
// physics::Harmonics::AtResonance; both: physics::JumpOff::WherePhaseCrossed.
enum class OlderTapping : std::uint16_t { None = 0, Version10 = 1, Version21 = 2 };

// Parameters of a contact: one combination of tip, lever, sample and medium, and its force law. The options of the law
// are plain members, because the bytes of a std::optional cannot be checked.
struct SharedContact {
  Name name{};
  physics::ContactParameters contact{};
  physics::Law law = physics::Law::Paper;
  std::uint32_t measured_curve = kNoMeasuredCurve;  // Law::Measured only: index into SharedModel::curves
  std::uint32_t exact_hamaker_sphere = 0;           // 1: the sphere's exact Hamaker force; 0: its approximation
  std::uint32_t has_meniscus = 0;                   // 1: `meniscus` applies; 0: no meniscus
  double retardation_wavelength_m = 0;              // wavelength of retardation; 0: no retardation
  physics::Meniscus meniscus{};
  std::uint32_t dynamic = 0;                    // 1: includes the inertia, damping and thermal noise of the lever
  std::uint32_t height_field = kNoHeightField;  // index into SharedModel::height_fields, or kTopography; none: a plane
  physics::LeverDynamics lever{};
  TopographyScale topography{};  // scale of the topography; with kTopography only
  double surface_release_m = 0;  // release Z at which the surface has its original size (surface_scale); 0: any
  // Lever in tapping mode: a drive swings it, with the resonance and damping of `lever`. Not dynamic, no friction.
  double free_amplitude_m = 0;  // zero-to-peak amplitude; 0: no tapping
  double drive_hz = 0;
  double viscosity_pa_s = 0;  // viscosity of the medium under the tip
  physics::FrictionParameters friction{};
  std::uint32_t law_map = 0;      // 1: modulus and adhesion at each place come from the model's map
  std::uint32_t viscous_map = 0;  // 1: with law_map, damping that grows with the energy lost by the law at each place
  MapVibration map_vibration{};   // quantity felt as a vibration; with law_map only; zero: none
  std::uint16_t felt_mean_force = 0;  // 1: mean force of a lever that taps on the hand, as far as a tank pays for it
  OlderTapping older_tapping{};       // older answers of a lever that taps
};

// True if the lever is in tapping mode.
constexpr bool taps(const SharedContact& material) { return material.free_amplitude_m > 0.0; }

// Curve recorded by an instrument, to be felt; each branch is sorted by increasing Z.
struct SharedMeasuredCurve {
  std::uint32_t approach_count = 0;
  std::uint32_t retract_count = 0;
  std::int32_t column = -1;  // pixel of a map, as in curves::MapPixel; -1: not from a map
  std::int32_t row = -1;
  physics::MeasuredJumps jumps{};
  std::array<physics::MeasuredPoint, kMaxMeasuredPoints> approach{};
  std::array<physics::MeasuredPoint, kMaxMeasuredPoints> retract{};
};

// Drawn surface of a sample: heights on a square grid centred on the origin of the sample's frame, row by row from
// -y to +y, x fastest; metres of the nanoworld along +z.
struct SharedHeightField {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double spacing_m = 0;
  std::array<float, kMaxHeightFieldSide * kMaxHeightFieldSide> height_m{};
};

// Size of the topography stored in a segment after its blocks (scene/shared/felt_heights.h); no columns: none.
struct SharedTopography {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double spacing_m = 0;
};

// Modulus and work of adhesion of a sample from place to place, for the materials with SharedContact::law_map: a square
// grid centred on the origin of the sample's frame, row by row from -y to +y, x fastest, in metres as measured, which
// SharedContact::topography scales. No columns: no map.
struct SharedLawMap {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double spacing_m = 0;
  std::array<float, kMaxLawMapSide * kMaxLawMapSide> ln_modulus{};  // natural logarithm of E* in pascals
  std::array<float, kMaxLawMapSide * kMaxLawMapSide> adhesion_j_per_m2{};
};

struct SharedModel {
  std::uint32_t node_count = 0;
  std::uint32_t material_count = 0;
  std::uint32_t sample_node =
      0;  // determines the direction of the force: the axes of this node are those of the sample's surface, +z outwards
  std::uint32_t curve_count = 0;
  std::uint32_t height_field_count = 0;
  std::uint32_t padding = 0;
  // common scale, as in TipState; 0: the one that suits all of these materials; replays use the recorded one
  double common_hand_m_per_m = 0;
  double common_hand_n_per_n = 0;
  SharedTopography topography{};
  SharedLawMap law_map{};
  SharedParticles particles{};
  std::array<SharedNode, kMaxNodes> nodes{};
  std::array<SharedContact, kMaxMaterials> materials{};
  std::array<SharedMeasuredCurve, kMaxMeasuredCurves> curves{};
  std::array<SharedHeightField, kMaxHeightFields> height_fields{};
};

// ---- written by touchafm ----

// Current transform of every node: room from node, column-major, metres.
struct SceneTransforms {
  std::uint32_t count = 0;
  std::uint32_t padding = 0;
  std::array<std::array<double, 16>, kMaxNodes> room_from_node{};
};

// Material selected with the wand, scale for feeling it, and settings among particles. `revision` increases by
// one with every selection. A new material, scale or setting takes effect once the tip is off the sample. With
// `release` the force is removed at once, even if nothing else changes.
struct Selection {
  std::int32_t material = -1;  // index into SharedModel::materials; -1: none yet
  std::uint32_t revision = 0;
  ScaleMode scale_mode = ScaleMode::Fit;
  std::uint32_t release = 0;  // 1: the force is removed at once; 0: it stays
  PushSettings settings{};
};

// New parameters for one material while the servo runs. `revision` increases by one with every edit of any material.
// An edit takes effect like a selection: once the tip is off the sample, without force, in the wait state.
struct MaterialEdit {
  SharedContact material{};
  std::uint32_t revision = 0;
  std::uint32_t padding = 0;
  SharedMeasuredCurve curve{};  // replaces that of the SharedModel; Law::Measured only; no points: no change
};

// Motion that the simulated user makes with the simulated hand; real devices ignore it. A new `revision` starts a
// minimum-jerk path of the hand's aim from its current position to `target_m` (device frame, +y up, metres) in
// `duration_s`.
struct HandScript {
  std::array<double, 3> target_m{};
  double duration_s = 0;
  std::uint32_t revision = 0;
  std::uint32_t turn_on_pressed = 0;  // 1 while Turn-On is held
};

// Relation between a scan on the wall and the hand.
enum class ScanHand : std::uint32_t {
  Apart = 0,  // scan independent of the hand
  Led = 1,    // a weak spring leads the hand along the scan's path
  Scans = 2,  // hand in the role of the scanner
  Looks = 3,  // independent scan of particles whose load may push them
};

// Scan data for the hand, sent once per frame. The servo uses it while is_valid() is true and it is not older than
// kScanLeadLastsNs; otherwise it assumes Apart.
struct ScanLead {
  std::int64_t time_ns = 0;           // CLOCK_MONOTONIC time of the frame
  std::array<double, 2> apex_xy_m{};  // Led: tip of the scan; Looks: middle of the square; in the sample's frame
  double height_m = 0;                // Led: height of the scan's tip; Looks: half a side of the square
  double gain_per_s = 0;            // gain of the integral controller, 0 to kMostScanGainPerS; Scans with feedback only
  ScanHand hand = ScanHand::Apart;  // role of the hand; Apart: the other fields are ignored
  std::uint32_t feedback = 0;       // 1: the loop moves the tip up and down; Scans only
  std::uint32_t revision = 0;       // counter that increases by one with every message
  std::uint32_t load_pn = 0;        // load of the scan's tip, piconewtons; Looks only

  bool operator==(const ScanLead&) const = default;
};

inline constexpr std::int64_t kScanLeadLastsNs = 350'000'000;
inline constexpr double kMostScanGainPerS = 1e6;
inline constexpr std::uint32_t kMostLookLoadPn = 1'000'000;  // 1 uN

struct RendererHeartbeat {
  std::int64_t time_ns = 0;
  std::uint64_t frame = 0;
  std::uint32_t leaving = 0;    // 1: normal exit of the renderer; the servo releases the hand and exits too
  std::uint32_t stop = 0;       // 1: request of a person for zero force at once
  std::uint32_t unseen = 0;     // 1: invisible picture, so no force is applied
  std::uint32_t take_back = 0;  // number of requests to take back a push, since the renderer's start
  std::uint32_t put_back = 0;   // number of requests to put all particles back
  std::uint32_t look = 0;       // number of requests for a second look at the particles near the tip
};

// ---- written by touchafm-servo ----

enum class ServoState : std::uint32_t { Disarmed = 0, Arming = 1, Running = 2, Fading = 3, Fault = 4 };

// False: there is no force, or it falls to zero within milliseconds, and a new one needs Turn-On.
constexpr bool is_armed(ServoState state) { return state != ServoState::Disarmed && state != ServoState::Fault; }

// State of the renderer as detected by the servo.
enum class RendererLink : std::uint32_t {
  Absent = 0,  // no heartbeat yet
  Alive = 1,
  Hung = 2,     // no heartbeat for too long
  Leaving = 3,  // announced its exit
  Died = 4,
  Stopped = 5,  // alive; a person has pressed Stop there
  Unseen = 6,   // alive; its picture is not visible
};

// The servo's device: limits as in haptics::DeviceSpec, positions in the device frame from the contact point, metres.
// Stored once, when the servo starts.
struct SharedDevice {
  Name name{};
  double max_force_n = 0;
  double max_continuous_force_n = 0;
  double max_stiffness_n_per_m = 0;
  double max_slew_n_per_s = 0;     // largest rate of change of the force; infinite: no limit
  double max_speed_m_per_s = 0;    // largest speed of the hand; infinite: no limit
  double max_vibration_n = 0;      // largest amplitude of a vibration; 0: no vibration
  std::uint32_t has_own_hand = 0;  // 1: hand of a person or a recording, which ignores HandScript
  std::uint32_t padding = 0;
  std::array<double, 3> workspace_min_m{};
  std::array<double, 3> workspace_max_m{};
};

// Histograms of wake-up lateness and work of the ticks, microseconds; the last bin holds all longer ones.
inline constexpr std::uint32_t kHistogramBins = 2001;
struct ServoTiming {
  double rate_hz = 0;
  std::uint32_t policy_fifo = 0;  // 1: SCHED_FIFO was granted
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
