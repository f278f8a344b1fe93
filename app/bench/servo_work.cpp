// SPDX-License-Identifier: Apache-2.0
#include "app/bench/servo_work.h"
#include "core/percentiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "app/bench/timed_servo.h"
#include "core/clock.h"
#include "core/log.h"
#include "haptics/contact/felt_ink.h"
#include "haptics/contact/felt_scratch.h"
#include "haptics/law_family.h"
#include "haptics/particle_scale.h"
#include "haptics/simulated_device.h"
#include "physics/law.h"
#include "scene/shared/shared_segment.h"

namespace afm::app {

namespace {

constexpr double kDearestBar_us = 20.0;  // limit set by the design
constexpr double kMapP99_us = 8.0;
constexpr double kTapP99_us = 5.0;
// CHAI3D's custom effect on a field of 128 x 128 at full speed, on a comparable machine
constexpr double kFieldP50_us = 0.8;
constexpr double kFieldP99_us = 1.0;

constexpr std::size_t kHalfCycle = 600;  // number of ticks
constexpr double kTop_m = 0.060, kBottom_m = -0.015, kSideways_m = 0.03;

enum class Ground { Plane, Surface, Measured, Map, Tapped };

struct WorkCase {
  std::string name;
  physics::Law law;
  bool dynamic;
  Ground ground;
  double p50_bar_us;
  double p99_bar_us;
};

// The paper's law and CHAI3D's, both also on a measured surface; every other law; and a lever with mass.
std::vector<WorkCase> work_cases(const MeasuredSurface& measured) {
  using physics::Law;
  std::vector<WorkCase> all{{"paper on a plane", Law::Paper, false, Ground::Plane, 0, kFieldP99_us},
                            {"paper on a surface", Law::Paper, false, Ground::Surface, kFieldP50_us, kFieldP99_us},
                            {measured.name, Law::Paper, false, Ground::Measured, 0, kDearestBar_us}};
  for (const Law law : physics::laws_with(&physics::LawTraits::computed)) {
    if (law != Law::Paper) all.push_back({std::string(name_of(law)), law, false, Ground::Surface, 0, kDearestBar_us});
  }
  all.push_back({"dynamic-dmt", Law::Dmt, true, Ground::Surface, 0, kDearestBar_us});
  all.push_back({"map of jkr", Law::Jkr, false, Ground::Map, 0, kMapP99_us});
  all.push_back({"tapping", Law::Dmt, false, Ground::Tapped, 0, kTapP99_us});
  return all;
}

// A surface with waves and steps as steep as a cleaved face.
scene::SharedHeightField rough_surface() {
  scene::SharedHeightField field{
      .columns = scene::kMaxHeightFieldSide, .rows = scene::kMaxHeightFieldSide, .spacing_m = 1e-9};
  for (std::uint32_t row = 0; row < field.rows; ++row) {
    for (std::uint32_t column = 0; column < field.columns; ++column) {
      const double step_m = (column / 16) % 2 == 0 ? 0.0 : 0.5e-9;
      field.height_m[row * field.columns + column] = static_cast<float>(step_m + 0.2e-9 * std::sin(0.3 * row));
    }
  }
  return field;
}

// Adds the largest map of modulus and adhesion, with hills of both, about as wide as the hand's path.
void lay_map(scene::SharedModel& model) {
  constexpr double kWidthM = 300e-9;
  scene::SharedContact& rubber = model.materials[0];
  rubber.law_map = 1;
  rubber.contact.tip_radius = physics::Length(30e-9);
  rubber.contact.spring_constant = physics::Stiffness(0.2);
  rubber.contact = haptics::contact_with(rubber.contact, physics::Pressure(2e6), 40e-3);
  scene::SharedLawMap& map = model.law_map;
  map.columns = map.rows = scene::kMaxLawMapSide;
  map.spacing_m = kWidthM / map.columns;
  for (std::uint32_t row = 0; row < map.rows; ++row) {
    for (std::uint32_t column = 0; column < map.columns; ++column) {
      const double x = 4.0 * column / map.columns, y = 4.0 * row / map.rows;
      const std::size_t cell = std::size_t{row} * map.columns + column;
      map.ln_modulus[cell] = static_cast<float>(std::log(3e6) + std::sin(x) * std::cos(y));
      map.adhesion_j_per_m2[cell] = static_cast<float>(50e-3 + 30e-3 * std::cos(x + y));
    }
  }
}

// The sample and the lever of docs/tapping.md.
void tap_on(scene::SharedContact& polymer) {
  polymer.contact.tip_radius = physics::Length(20e-9);
  polymer.contact.spring_constant = physics::Stiffness(40.0);
  polymer.contact.hamaker = physics::Energy(64e-21);
  polymer.contact.mean_surface_energy = physics::SurfaceEnergy(31.2e-3);
  polymer.contact.reduced_modulus = physics::Pressure(1.5e9);
  polymer.lever.resonance = physics::Frequency(300e3);
  polymer.lever.quality_factor = 400.0;
  polymer.free_amplitude_m = 20e-9;
  polymer.drive_hz = 300e3;
}

scene::SharedModel model_of(const WorkCase& work, const MeasuredSurface& measured) {
  scene::SharedModel model = mica_alone();
  scene::SharedContact& mica = model.materials[0];
  mica.law = work.law;
  mica.dynamic = work.dynamic ? 1 : 0;
  if (work.ground == Ground::Surface) {
    model.height_field_count = 1;
    model.height_fields[0] = rough_surface();
    mica.height_field = 0;
  }
  if (work.ground == Ground::Map) lay_map(model);
  if (work.ground == Ground::Tapped) tap_on(mica);
  if (work.ground == Ground::Measured) {
    model.topography = measured.topography.size();
    mica.height_field = scene::kTopography;
    mica.topography = measured.scale;
  }
  return model;
}

// Simulated person who moves up and down and sideways continuously.
class Hand {
 public:
  explicit Hand(TimedServo& servo) : servo_(servo) {}

  double tick_us() {
    if (tick_++ % kHalfCycle == 0) {
      down_ = !down_;
      const double sideways_m = down_ ? -kSideways_m : kSideways_m;
      servo_.aim({sideways_m, down_ ? kBottom_m : kTop_m, sideways_m},
                 1e-9 * static_cast<double>(kHalfCycle * TimedServo::kPeriodNs));
    }
    return servo_.tick_us();
  }

 private:
  TimedServo& servo_;
  std::size_t tick_ = 0;
  bool down_ = false;
};

core::Result<WorkFigure> measure_case(const WorkCase& work, const MeasuredSurface& measured, std::size_t ticks) {
  const bool on_measured = work.ground == Ground::Measured;
  auto servo = TimedServo::create(model_of(work, measured), on_measured ? measured.topography : scene::Topography{});
  if (!servo) return tl::unexpected(servo.error());
  if (!(*servo)->turn_on()) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot measure {}: the force was never enabled", work.name));
  }
  Hand hand(**servo);
  std::vector<double> us(ticks);
  for (double& each : us) each = hand.tick_us();
  return WorkFigure{work.name, core::percentiles(std::move(us)), work.p50_bar_us, work.p99_bar_us};
}

// Measures a tick with a silicon tip that a hand drags over PMMA with about 100 nN, back and forth beside its own
// grooves, including the tile that is published.
core::Result<WorkFigure> measure_scratching(std::size_t ticks) {
  constexpr double kStepM = 0.3e-9, kBesideM = 3e-9, kHalfM = 150e-9, kPressedM = -106e-9, kOverM = 30e-9;
  constexpr double kHalfAngle = 0.35;  // in radians
  const auto pmma = std::make_unique<scene::SharedParticles>();
  pmma->pusher = {.tip_radius_m = 20e-9,
                  .half_angle_rad = kHalfAngle,
                  .lateral_spring_n_per_m = 10.0,
                  .normal_spring_n_per_m = 1.0,
                  .contact_stiffness_n_per_m = 100.0};
  pmma->soft = {.name = scene::to_name("PMMA"),
                .hardness_pa = 0.3e9,
                .reduced_modulus_pa = 3.4e9,
                .work_of_adhesion_j_per_m2 = 0.08,
                .pile_up_share = 0.7};
  const auto scale = haptics::particle_scale(*pmma, haptics::SimulatedDevice().spec());
  if (!scale) return tl::unexpected(scale.error());
  haptics::FeltScratch felt(*pmma, *scale, 1e-9 * static_cast<double>(TimedServo::kPeriodNs));
  double x_m = -kHalfM, y_m = -kHalfM, step_m = kStepM, beside_m = kBesideM;
  for (double z_m = kOverM; z_m > kPressedM; z_m -= kStepM) felt.step({x_m, y_m}, z_m, 1e-3);
  const core::MonotonicClock clock;
  std::vector<double> us(ticks);
  for (double& each : us) {
    x_m += step_m;
    y_m += beside_m * kStepM / (2.0 * kHalfM);
    if (std::abs(x_m) > kHalfM) {
      step_m = -step_m;
      x_m += 2.0 * step_m;
      if (std::abs(y_m) > kHalfM) beside_m = -beside_m;
    }
    const std::int64_t before_ns = clock.now_ns();
    felt.step({x_m, y_m}, kPressedM, 1e-3);
    felt.next_tile();
    each = 1e-3 * static_cast<double>(clock.now_ns() - before_ns);
  }
  return WorkFigure{"scratching PMMA", core::percentiles(std::move(us)), 0, kDearestBar_us};
}

// Measures a tick with a tip that writes over its own ink, in circles about the middle of a dot of some 20 s.
core::Result<WorkFigure> measure_writing(std::size_t ticks) {
  constexpr double kOverM = 500e-9, kPressedM = -20e-9, kCircleM = 100e-9, kTurn = 0.005;  // in radians per tick
  constexpr int kSoaked = 20'000;                                                          // number of ticks
  const auto thiol = std::make_unique<scene::SharedParticles>();
  thiol->pusher = {.tip_radius_m = 20e-9, .half_angle_rad = 0.35, .normal_spring_n_per_m = 0.1};
  thiol->ink = {.name = scene::to_name("a thiol on gold"),
                .molecules_per_s = 1e5,
                .footprint_m2 = 0.216e-18,
                .thickness_m = 2e-9,
                .surface_tension_n_per_m = 0.0728};
  const auto scale = haptics::particle_scale(*thiol, haptics::SimulatedDevice().spec());
  if (!scale) return tl::unexpected(scale.error());
  haptics::FeltInk felt(*thiol, *scale);
  felt.step({kCircleM, 0.0}, kOverM, 1e-3);
  const core::MonotonicClock clock;
  double angle = 0.0;
  const auto step = [&] {
    angle += kTurn;
    const std::int64_t before_ns = clock.now_ns();
    felt.step({kCircleM * std::cos(angle), kCircleM * std::sin(angle)}, kPressedM, 1e-3);
    felt.next_tile();
    return 1e-3 * static_cast<double>(clock.now_ns() - before_ns);
  };
  for (int i = 0; i < kSoaked; ++i) step();
  std::vector<double> us(ticks);
  for (double& each : us) each = step();
  return WorkFigure{"writing with ink", core::percentiles(std::move(us)), 0, kDearestBar_us};
}

}  // namespace

scene::SharedModel mica_alone() {
  scene::SharedModel model;
  model.node_count = 1;
  model.nodes[0].name = scene::to_name("sample");
  model.nodes[0].parent_from_node = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};  // frame with +z up
  model.material_count = 1;
  scene::SharedContact& mica = model.materials[0];
  mica.name = scene::to_name("mica");
  mica.contact = {.tip_radius = physics::Length(50e-9),
                  .spring_constant = physics::Stiffness(0.1),
                  .sample_stiffness = physics::Stiffness(std::numeric_limits<double>::infinity()),
                  .hamaker = physics::Energy(24.5e-21),
                  .mean_surface_energy = physics::SurfaceEnergy(2.228e-3),
                  .reduced_modulus = physics::Pressure(51.5e9)};
  mica.lever = {physics::Frequency(12e3), 2.5, physics::Temperature(298.0)};
  return model;
}

MeasuredSurface largest_measured_surface() {
  constexpr std::uint32_t kSide = scene::kMaxTopographySide;
  constexpr double kWidthM = 10e-6, kReliefM = 1e-6, kNoiseM = 10e-9, kShownM = 60e-9;
  scene::Topography topography{.columns = kSide, .rows = kSide, .spacing_m = kWidthM / kSide, .height_m = {}};
  topography.height_m.reserve(std::size_t{kSide} * kSide);
  std::mt19937 random(1);
  std::normal_distribution<double> noise_m(0.0, kNoiseM);
  for (std::uint32_t row = 0; row < kSide; ++row) {
    for (std::uint32_t column = 0; column < kSide; ++column) {
      const double x = (column + 0.5) / kSide - 0.5, y = (row + 0.5) / kSide - 0.5;
      const double hills = 0.4 * std::sin(7.0 * x + 4.0 * y) * std::cos(6.0 * y), steps = 0.3 * std::round(3.0 * y + x);
      topography.height_m.push_back(static_cast<float>(kReliefM * (hills + steps) + noise_m(random)));
    }
  }
  const float origin_m = topography.height_m[(kSide / 2) * kSide + kSide / 2];
  for (float& height_m : topography.height_m) height_m -= origin_m;
  const double scale = kShownM / kWidthM;
  return {fmt::format("measured {0} x {0}", kSide), std::move(topography), {.lateral = scale, .vertical = scale}};
}

core::Result<std::vector<WorkFigure>> measure_servo_work(std::size_t ticks, const MeasuredSurface& measured) {
  std::vector<WorkFigure> figures;
  const std::vector<WorkCase> all = work_cases(measured);
  for (const WorkCase& work : all) {
    core::log_line(fmt::format("measuring ticks: {} ({} of {})", work.name, figures.size() + 1, all.size()));
    auto figure = measure_case(work, measured, ticks);
    if (!figure) return tl::unexpected(figure.error());
    figures.push_back(std::move(*figure));
  }
  for (const auto& measure : {measure_scratching, measure_writing}) {
    auto figure = measure(ticks);
    if (!figure) return tl::unexpected(figure.error());
    figures.push_back(std::move(*figure));
  }
  return figures;
}

}  // namespace afm::app
