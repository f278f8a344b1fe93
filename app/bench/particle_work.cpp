// SPDX-License-Identifier: Apache-2.0
#include "app/bench/particle_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <utility>

#include "app/bench/servo_work.h"
#include "app/bench/timed_servo.h"
#include "core/log.h"
#include "scene/shared/particle_blocks.h"

namespace afm::app {

namespace {

constexpr double kBarUs = 20.0;      // limit set by the design
constexpr double kPitchM = 70e-9;    // pitch of a square lattice with two fifths of its area covered
constexpr double kHandMPerS = 0.05;  // fastest part of a line

struct Crowd {
  std::string name;
  std::vector<glm::dvec2> places_m;
  double bar_us = 0;
  double hand_m_per_s = kHandMPerS;
  double pitch_m = kPitchM;  // pitch of the lattice and of the lines
  double tip_radius_m = 0;   // radius of the tip; 0: that of the set's tip
};

// Places on a square lattice, each shifted by up to two fifths of the gap.
std::vector<glm::dvec2> scattered(std::uint32_t count, double radius_m, double pitch_m) {
  const double most_m = 0.4 * (pitch_m - 2.0 * radius_m);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> aside_m(-most_m, most_m);
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  std::vector<glm::dvec2> places_m;
  places_m.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t column = i % columns, row = i / columns;
    const double x_m = (column - 0.5 * (columns - 1)) * pitch_m + aside_m(random);
    const double y_m = (row - 0.5 * (columns - 1)) * pitch_m + aside_m(random);
    places_m.emplace_back(x_m, y_m);
  }
  return places_m;
}

// Places in a hexagon of `rings` rings around a sphere, 0.1 nm apart.
std::vector<glm::dvec2> heaped(int rings, double radius_m) {
  const double step_m = 2.0 * radius_m + 0.1e-9;
  std::vector<glm::dvec2> places_m;
  for (int row = -rings; row <= rings; ++row) {
    const int columns = 2 * rings + 1 - std::abs(row);
    for (int i = 0; i < columns; ++i) {
      places_m.emplace_back((i - 0.5 * (columns - 1)) * step_m, row * 0.5 * std::sqrt(3.0) * step_m);
    }
  }
  return places_m;
}

// Crowds of spheres with this radius.
std::vector<Crowd> crowds(double radius_m) {
  std::vector<Crowd> all{{.name = "the law alone", .places_m = {}}};
  for (const std::uint32_t count : {1U, 20U, 200U}) {
    all.push_back({.name = fmt::format("{} particle{}", count, count == 1 ? "" : "s"),
                   .places_m = scattered(count, radius_m, kPitchM),
                   .bar_us = kBarUs});
  }
  all.push_back(
      {.name = "200, a faster hand", .places_m = scattered(200, radius_m, kPitchM), .hand_m_per_s = 2.0 * kHandMPerS});
  // spacing so small that the simulated hand can feel this many particles with a blunt tip
  constexpr double kCloseM = 60e-9;
  all.push_back({.name = "2000 particles",
                 .places_m = scattered(2000, radius_m, kCloseM),
                 .bar_us = kBarUs,
                 .pitch_m = kCloseM,
                 .tip_radius_m = 20e-9});
  all.push_back({.name = "heap of 37", .places_m = heaped(3, radius_m)});
  return all;
}

// Copies tip, lever and first species of the set, with other places.
void lay(const Crowd& crowd, const scene::SharedParticles& set, scene::SharedParticles& particles) {
  particles.pusher = set.pusher;
  if (crowd.tip_radius_m > 0.0) particles.pusher.tip_radius_m = crowd.tip_radius_m;
  particles.species_count = 1;
  particles.species[0] = set.species[0];
  for (const glm::dvec2& place_m : crowd.places_m) {
    particles.particles[particles.count++] = {.x_m = place_m.x, .y_m = place_m.y};
  }
}

// Numbers of ticks.
struct Counts {
  std::uint64_t touching = 0, exhausted = 0;
};

// One round of lines over the whole crowd, back and forth.
class Round {
 public:
  Round(TimedServo& servo, const Crowd& crowd, double hand_m_per_m)
      : servo_(servo),
        hand_m_per_m_(hand_m_per_m),
        half_m_(crowd.pitch_m),
        pitch_m_(crowd.pitch_m),
        hand_m_per_s_(crowd.hand_m_per_s) {
    for (const glm::dvec2& at_m : crowd.places_m) half_m_ = std::max({half_m_, std::abs(at_m.x), std::abs(at_m.y)});
    half_m_ += pitch_m_;
  }

  // False: the servo took the force away.
  bool run(std::size_t ticks, std::vector<double>& us, Counts& counts) {
    double way = -1.0;
    for (double y_m = pitch_m_ - half_m_; y_m < half_m_ && us.size() < ticks; y_m += pitch_m_, way = -way) {
      go({way * half_m_, y_m}, kOverM);
      go({way * half_m_, y_m}, kOnM);
      const std::uint64_t before = servo_.push().exhausted;
      scene::TipPush push;
      aim({-way * half_m_, y_m}, kOnM, hand_m_per_s_);
      do {
        us.push_back(servo_.tick_us());
        push = servo_.push();
        if (push.particle != scene::kNoParticle) ++counts.touching;
      } while (!servo_.arrived() && us.size() < ticks);
      counts.exhausted += push.exhausted - before;
      go({-way * half_m_, y_m}, kOverM);
    }
    return servo_.state().servo_state == scene::ServoState::Running;
  }

 private:
  static constexpr double kOverM = 0.030, kOnM = 0.0005;  // height of the hand
  static constexpr double kTravelMPerS = 0.25;

  void aim(const glm::dvec2& at_m, double height_m, double speed_m_per_s) {
    const glm::dvec3 to_m(at_m.x * hand_m_per_m_, height_m, -at_m.y * hand_m_per_m_);
    // a minimum-jerk path is 15/8 times as fast in its middle as on average
    servo_.aim(to_m, std::max(0.1, 15.0 / 8.0 * glm::distance(to_m, at_m_) / speed_m_per_s));
    at_m_ = to_m;
  }

  void go(const glm::dvec2& at_m, double height_m) {
    aim(at_m, height_m, kTravelMPerS);
    while (!servo_.arrived()) servo_.tick_us();
  }

  TimedServo& servo_;
  double hand_m_per_m_;
  double half_m_, pitch_m_, hand_m_per_s_;
  glm::dvec3 at_m_ = TimedServo::kLiftedM;
};

core::Result<ParticleWorkFigure> measure(const Crowd& crowd, const scene::SharedParticles& set, double alone_m_per_m,
                                         std::size_t ticks) {
  scene::SharedModel model = mica_alone();
  lay(crowd, set, model.particles);
  const bool among = !crowd.places_m.empty();
  if (!among) model.particles = {};
  ParticleWorkFigure figure{
      .name = crowd.name, .particles = model.particles.count, .us = {}, .p99_bar_us = crowd.bar_us};
  std::vector<double> us;
  us.reserve(ticks);
  Counts counts;
  while (us.size() < ticks) {
    auto servo = TimedServo::create(model, {}, among ? scene::ScaleMode::Particles : scene::ScaleMode::Fit);
    if (!servo) return tl::unexpected(servo.error());
    if (!(*servo)->turn_on()) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot measure {}: the force was never enabled", crowd.name));
    }
    const double hand_m_per_m = among ? (*servo)->state().active.scale.hand_m_per_m : alone_m_per_m;
    if (!Round(**servo, crowd, hand_m_per_m).run(ticks, us, counts)) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot measure {}: the servo took the force away", crowd.name));
    }
  }
  const auto count = static_cast<double>(us.size());
  figure.touching_share = static_cast<double>(counts.touching) / count;
  figure.exhausted_share = static_cast<double>(counts.exhausted) / count;
  figure.us = core::percentiles(std::move(us));
  return figure;
}

}  // namespace

core::Result<std::vector<ParticleWorkFigure>> measure_particle_work(const scene::SharedParticles& set,
                                                                    std::size_t ticks) {
  constexpr double kAloneMPerM = 2e5;  // scale of a few particles
  std::vector<ParticleWorkFigure> figures;
  const std::vector<Crowd> all = crowds(set.species[0].radius_m);
  figures.reserve(all.size());
  for (const Crowd& crowd : all) {
    core::log_line(fmt::format("measuring ticks: {} ({} of {})", crowd.name, figures.size() + 1, all.size()));
    auto figure = measure(crowd, set, kAloneMPerM, ticks);
    if (!figure) return tl::unexpected(figure.error());
    figures.push_back(std::move(*figure));
  }
  return figures;
}

}  // namespace afm::app
