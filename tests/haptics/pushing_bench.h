// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "servo_bench.h"
#include "support/particles/gold_particles.h"

// The servo among particles, pushed by a simulated hand.
namespace afm::test {

// Model with one particle in the path of the hand, and another beside it.
inline scene::SharedModel two_particles() {
  scene::SharedModel model = paper_model();
  model.particles = particles_at({{-80e-9, 0.0}, {80e-9, 100e-9}});
  return model;
}

class PushingBench : public ServoBench {
 public:
  explicit PushingBench(double rate_hz = 1000.0, const scene::SharedModel& model = two_particles())
      : ServoBench(model, rate_hz) {}

  // Sends the hand to a place on the sample, at a height above the contact point.
  void send(double x_m, double y_m, double height_m, double seconds) {
    renderer.store(scene::HandScript{.target_m = {x_m, height_m, -y_m}, .duration_s = seconds, .revision = ++script});
  }
  void go(double x_m, double y_m, double height_m, double seconds) {
    send(x_m, y_m, height_m, seconds);
    while (state().acknowledged.hand_script != script) tick();
  }

  // Lifts, moves in front of the row, and puts the tip down.
  void put_down() {
    arm(kMica, scene::ScaleMode::Particles);
    go(-0.030, 0.0, 0.030, 0.4);
    go(-0.030, 0.0, 0.001, 0.4);
  }

  scene::ParticlePose pose(std::uint32_t particle) {
    if (const auto newer = renderer.new_particle_page(0)) page = *newer;
    return page.poses[particle];
  }

  double sideways_n() {
    const auto force = state().hand.force_n;
    return std::hypot(force[0], force[2]);
  }

  std::size_t count(physics::EventKind kind) const {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [&](const scene::TipEvent& e) { return e.kind == kind; }));
  }

  // Removes the force and lifts; the sample stays.
  void release() {
    renderer.store(scene::Selection{.material = kMica,
                                    .revision = ++selection,
                                    .scale_mode = scene::ScaleMode::Particles,
                                    .release = 1,
                                    .settings = settings});
    run(0.3);
  }

  // Pushes once to a place on the row, then lifts the hand.
  void push_to(double x_m) {
    put_down();
    go(x_m, 0.0, 0.001, 1.0);
    go(x_m, 0.0, 0.050, 0.5);
  }

  void order(std::uint32_t& orders) {
    ++orders;
    tick();
  }

  scene::ParticlePage page;
};

}  // namespace afm::test
