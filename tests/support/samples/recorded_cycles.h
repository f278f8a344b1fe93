// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "physics/curve_point.h"

// Cycles as recorded by instruments, with a loop in contact and noise, which none of our laws has.
namespace afm::test {

// Points between `far` and `deep`; forces as functions of Z, in newtons.
template <class Down, class Up>
std::vector<physics::CurvePoint> recording(double far, double deep, Down down, Up up, double noise,
                                           int count_down = 1000, int count_up = 1000, unsigned seed = 11) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<physics::CurvePoint> points;
  for (int i = 0; i < count_down; ++i) {
    const double z = far + (deep - far) * i / (count_down - 1);
    points.push_back({physics::Length(z - 3e-6), physics::Force(down(z) + normal(random)), physics::Branch::Approach});
  }
  for (int i = 0; i < count_up; ++i) {
    const double z = deep + (far - deep) * i / (count_up - 1);
    points.push_back({physics::Length(z - 3e-6), physics::Force(up(z) + normal(random)), physics::Branch::Retract});
  }
  return points;
}

// A tip on a hard sample as recorded by an MFP-3D: the retract runs 2 nm beside the approach, so that the contact line
// of the retract pulls harder at the place of the snap-in than the snap-in did.
inline std::vector<physics::CurvePoint> hard_sample() {
  const auto down = [](double z) { return z > 6.6e-9 ? 0.0 : -0.55 * z; };
  const auto up = [](double z) { return z > 24e-9 ? 0.0 : -0.55 * (z + 2e-9 * std::min(1.0, (z + 18e-9) / 5e-9)); };
  return recording(190e-9, -18e-9, down, up, 10e-12);
}

// A soft, sticky sample: no snap-in, a loop in contact, a pull that ends gradually.
inline std::vector<physics::CurvePoint> soft_sample() {
  const auto push = [](double z) { return z > 0 ? 0.0 : 4e-9 * std::pow(-z / 400e-9, 1.5); };
  const auto down = [&](double z) { return push(z); };
  const auto up = [&](double z) {
    const double turned = std::min(1.0, (z + 400e-9) / 100e-9);
    return push(z) - 1.5e-9 * turned * std::exp(-std::max(0.0, z) / 60e-9);
  };
  return recording(2e-6, -400e-9, down, up, 15e-12);
}

// A soft sample with a pull-off over this range, with noise relative to the pull.
inline std::vector<physics::CurvePoint> gradual_pull_off(double range, double noise, unsigned seed) {
  constexpr double kPull = 0.4e-9;
  const auto push = [](double z) { return z > 0 ? 0.0 : 2e-9 * std::pow(-z / 500e-9, 1.5); };
  const auto up = [&](double z) {
    const double turned = std::min(1.0, (z + 500e-9) / 100e-9);
    return push(z) - kPull * turned * std::exp(-std::max(0.0, z) / range);
  };
  return recording(2.5e-6, -500e-9, push, up, noise * kPull, 2000, 2000, seed);
}

// A soft sample that continues to pull over many micrometres, recorded more densely on the way down.
inline std::vector<physics::CurvePoint> long_weak_pull() {
  const auto down = [](double z) { return z > 0 ? 0.0 : 6e-9 * std::pow(-z / 3.2e-6, 1.5); };
  const auto up = [&](double z) {
    const double turned = std::min(1.0, (z + 3.2e-6) / 1e-6);
    return down(z) - turned * (0.3e-9 + 0.6e-9 * std::exp(-std::max(0.0, z) / 300e-9)) * (z > 20e-6 ? 0.0 : 1.0);
  };
  return recording(60e-6, -3.2e-6, down, up, 40e-12, 10400, 2000);
}

// A soft sample with its pull-off below the contact point, while still pressed: the approach pulls a little before it,
// over a retract that lies beside it by much of its push.
inline std::vector<physics::CurvePoint> lets_go_pressed() {
  const auto down = [](double z) { return z > 30e-9 ? 0.0 : 24e-12 * std::pow((30e-9 - z) / 740e-9, 1.3); };
  const auto up = [](double z) {
    const double push = z > -500e-9 ? 0.0 : 24e-12 * std::pow((-500e-9 - z) / 240e-9, 1.3);
    return push - (z < -16e-9 && z > -640e-9 ? 11e-12 : 0.0);
  };
  return recording(475e-9, -740e-9, down, up, 0.3e-12);
}

// A cycle without any adhesion, with an undulating baseline.
inline std::vector<physics::CurvePoint> no_adhesion() {
  const auto wave = [](double z) { return 2e-9 * std::sin(z / 10e-9); };
  const auto down = [&](double z) { return (z > 0 ? 0.0 : 5.0 * -z) + wave(z); };
  const auto up = [&](double z) {
    return std::max(0.0, 5.0 * (-z - 20e-9 * std::min(1.0, (z + 200e-9) / 50e-9))) + wave(z);
  };
  return recording(1e-6, -200e-9, down, up, 0.5e-9);
}

// A double layer or a brush that pushes the tip beyond the place of the pull-off.
inline std::vector<physics::CurvePoint> pushes_beyond_pull_off() {
  const auto down = [](double z) {
    return 0.2e-9 * std::exp(-std::max(0.0, z) / 150e-9) + (z > 0 ? 0.0 : 4e-9 * std::pow(-z / 400e-9, 1.5));
  };
  const auto up = [&](double z) { return down(z) - (z > 60e-9 ? 0.0 : 1.5e-9 * std::min(1.0, (z + 400e-9) / 100e-9)); };
  return recording(2e-6, -400e-9, down, up, 5e-12);
}

}  // namespace afm::test
