// SPDX-License-Identifier: Apache-2.0
// No path of the hand takes energy out of lever and particles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "physics/manipulation/pushed_particles.h"
#include "pushing.h"
#include "support/deep.h"

namespace afm::physics {
namespace certificate_test {

using test::base_at;
using test::flank_tip;
using test::gold;
using test::latex;

// Relative rounding error of the balance, as a fraction of the energy given by the hand, and of a place, in metres.
constexpr double kRounding = 1e-12, kPlaceRounding = 1e-21;

struct Crowd {
  const char* name;
  std::size_t particles;
  double spacing;  // ratio to the diameter
  double share_of_ticks;
  double rods = 0.0;  // fraction of the particles
};

constexpr Crowd kCrowds[] = {{"one", 1, 2.0, 0.4},
                             {"twenty", 20, 1.6, 0.3},
                             {"two hundred", 200, 1.3, 0.2},
                             {"jammed", 400, 1.0, 0.05},
                             {"two thousand", 2000, 1.25, 0.05},
                             {"one rod", 1, 2.6, 0.1, 1.0},
                             {"rods", 9, 2.3, 0.1, 1.0},
                             {"rods among spheres", 25, 2.1, 0.1, 0.3}};
constexpr Length kRodLength{120e-9};
constexpr std::array kBudgets{kHeapLooks, 24.0, 8.0, 1.0};  // looks of a tick, also so few that no heap settles

ParticleSpecies random_rod(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  ParticleSpecies rod;
  rod.law = ParticleLaw::Measured;
  rod.contact.tip_radius = Length(uniform(25e-9, 40e-9));
  rod.length = kRodLength;
  rod.measured_threshold = Force(std::exp(uniform(std::log(1e-10), std::log(3e-8))));
  rod.kinetic_ratio = uniform(0.2, 1.0);
  rod.ageing = Time(uniform(0.0, 1.0) < 0.3 ? 0.0 : 0.1);
  return rod;
}

PushSetup random_setup(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto spring = [&](double low, double high) {
    return Stiffness(std::exp(uniform(std::log(low), std::log(high))));
  };
  PushSetup setup{flank_tip(Length(uniform(5e-9, 20e-9)), uniform(0.0, 30.0)),
                  {spring(0.3, 100.0), spring(0.01, 40.0), spring(10.0, 1000.0)},
                  uniform(0.0, 0.5),
                  {gold(), latex()}};
  for (ParticleSpecies& species : setup.species) {
    species.kinetic_ratio = uniform(0.2, 1.0);
    species.ageing = Time(uniform(0.0, 1.0) < 0.3 ? 0.0 : 0.1);
    species.law = static_cast<ParticleLaw>(std::uniform_int_distribution(0, 2)(random));
    species.coefficient = uniform(0.05, 0.5);
    species.rolling_distance = Length(uniform(0.0, 0.5e-9));
    species.tip_adhesion = SurfaceEnergy(uniform(0.0, 0.05));
  }
  return setup;
}

struct Point {
  double x = 0.0, y = 0.0;
};

double apart(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// The point of a particle's axis at a share of the half length from its middle, and the one nearest to another point.
Point point_of(const PushSetup& setup, const PushedParticles& particles, std::size_t i, double share) {
  const double half = 0.5 * setup.species[particles.species(i)].length.si, angle = angle_rad(particles.turn(i));
  return {particles.position(i).x.si + share * half * std::cos(angle),
          particles.position(i).y.si + share * half * std::sin(angle)};
}
Point nearest_to(const PushSetup& setup, const PushedParticles& particles, std::size_t i, const Point& to) {
  const Point a = point_of(setup, particles, i, -1.0), b = point_of(setup, particles, i, 1.0);
  const double x = b.x - a.x, y = b.y - a.y, squares = x * x + y * y;
  const double share = squares > 0.0 ? std::clamp(((to.x - a.x) * x + (to.y - a.y) * y) / squares, 0.0, 1.0) : 0.0;
  return {a.x + share * x, a.y + share * y};
}

// Distances at which two particles press each other: two rods do where an end of one meets the other.
std::vector<double> distances(const PushSetup& setup, const PushedParticles& particles, std::size_t i, std::size_t j) {
  const auto is_rod_at = [&](std::size_t k) { return is_rod(setup.species[particles.species(k)]); };
  const auto of_point = [&](std::size_t k, double share, std::size_t other) {
    const Point point = point_of(setup, particles, k, share);
    return apart(point, nearest_to(setup, particles, other, point));
  };
  if (!is_rod_at(i)) return {of_point(i, 0.0, j)};
  if (!is_rod_at(j)) return {of_point(j, 0.0, i)};
  return {of_point(i, -1.0, j), of_point(i, 1.0, j), of_point(j, -1.0, i), of_point(j, 1.0, i)};
}

// Energy of lever and contacts from the published state alone, by formulas of this test.
double energy_of(const PushSetup& setup, const PushedParticles& particles, const PushTick& tick) {
  const auto square = [](double x) { return x * x; };
  double energy = 0.5 * setup.springs.lateral.si *
                      (square((tick.apex.position.x - tick.base.position.x).si) +
                       square((tick.apex.position.y - tick.base.position.y).si)) +
                  0.5 * setup.springs.normal.si * square((tick.apex.z - tick.base.z).si);
  const double k = setup.springs.contact.si, theta = setup.tip.half_angle_rad, cap = setup.tip.radius.si;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double radius = setup.species[particles.species(i)].contact.tip_radius.si;
    const Point apex{tick.apex.position.x.si, tick.apex.position.y.si};
    const double away = apart(apex, nearest_to(setup, particles, i, apex));
    const double down = tick.apex.z.si + cap - radius;
    const double gap = std::atan2(down, away) < theta ? away * std::cos(theta) + down * std::sin(theta) - cap - radius
                                                      : std::hypot(away, down) - cap - radius;
    energy += 0.5 * k * square(std::min(0.0, gap));
    for (std::size_t j = 0; j < i; ++j) {
      const double other = setup.species[particles.species(j)].contact.tip_radius.si;
      for (const double distance : distances(setup, particles, i, j)) {
        energy += 0.5 * k * square(std::min(0.0, distance - 2.0 * std::sqrt(radius * other)));
      }
    }
  }
  return energy;
}

// A hand that strays over the particles, at times fast, at times up or down.
class StrayingHand {
 public:
  StrayingHand(std::mt19937_64& random, double field_m) : random_(random), field_m_(field_m) {}

  LeverBase next() {
    if (left_-- <= 0) {
      left_ = std::uniform_int_distribution(1, 200)(random_);
      const double speed = std::exp(between(std::log(1e-12), std::log(12e-9)));  // metres per tick
      const double angle = between(0.0, 6.3);
      dx_ = speed * std::cos(angle);
      dy_ = speed * std::sin(angle);
      dz_ = between(0.0, 1.0) < 0.3 ? between(-1.0, 1.0) * std::min(speed, 1e-9) : 0.0;
    }
    x_ = turned_back(x_ + dx_, dx_);
    y_ = turned_back(y_ + dy_, dy_);
    z_ = std::clamp(z_ + dz_, -10e-9, 70e-9);
    return base_at(x_, y_, z_);
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  double turned_back(double value, double& step) const {
    if (std::abs(value) > field_m_) step = -std::copysign(step, value);
    return std::clamp(value, -field_m_, field_m_);
  }

  std::mt19937_64& random_;
  double field_m_;
  int left_ = 0;
  double x_ = 0.0, y_ = 0.0, z_ = 0.0, dx_ = 0.0, dy_ = 0.0, dz_ = 0.0;
};

void expect_certified(const Crowd& crowd, std::uint64_t seed, int ticks, long& touched) {
  std::mt19937_64 random(seed);
  PushSetup setup = random_setup(random);
  setup.heap_looks = kBudgets.at(seed % kBudgets.size());
  if (crowd.rods > 0.0) setup.species.push_back(random_rod(random));
  const double pitch = 100e-9 * crowd.spacing;
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(crowd.particles))));
  std::vector<PlacedParticle> placed;
  for (std::size_t i = 0; i < crowd.particles; ++i) {
    const auto column = static_cast<double>(i % side), row = static_cast<double>(i / side);
    const double middle = 0.5 * static_cast<double>(side - 1) - 0.37;
    placed.push_back({std::uniform_int_distribution<std::size_t>(0, 1)(random),
                      {Length((column - middle) * pitch), Length((row - middle) * pitch)},
                      std::uniform_int_distribution(0, 19)(random) == 0});
    if (crowd.rods == 0.0 || std::uniform_real_distribution(0.0, 1.0)(random) > crowd.rods) continue;
    placed.back().species = 2;
    placed.back().angle_rad = std::uniform_real_distribution(0.0, 6.3)(random);
  }
  PushedParticles particles(setup, placed, base_at(0.0, 0.0, 120e-9));
  StrayingHand hand(random, std::min(400e-9, 150e-9 + 0.5 * pitch * static_cast<double>(side)));
  double before = 0.0, largest = 0.0, strongest = 0.0;
  for (int i = 0; i < ticks; ++i) {
    const PushTick& tick = particles.move_to(hand.next(), Time(1e-3));
    // in any tick the hand gives at least the lost and the stored energy
    const double surplus = (tick.given - tick.lost - tick.stored).si;
    largest = std::max({largest, std::abs(tick.given.si), tick.lost.si, tick.stored.si});
    strongest = std::max({strongest, tick.normal.si, magnitude(tick.lateral).si});
    ASSERT_GE(surplus - before, -kRounding * largest - kPlaceRounding * strongest)
        << crowd.name << ", seed " << seed << ", tick " << i;
    before = surplus;
    if (tick.state != PushState::Free) ++touched;
    if (crowd.particles <= 20 || i % (ticks / 4 + 1) == 0) {  // the published energy is the stored one
      ASSERT_NEAR(tick.stored.si, energy_of(setup, particles, tick), 1e-9 * largest + kPlaceRounding * strongest)
          << crowd.name << ", seed " << seed;
    }
  }
  const PushTick& last = particles.last();
  EXPECT_NEAR(last.stored.si, energy_of(setup, particles, last), 1e-9 * largest + kPlaceRounding * strongest)
      << crowd.name << ", seed " << seed;
}

TEST(Certificate, HoldsOnRandomPathsAmongAnyNumberOfParticles) {
  const int ticks = support::deep() ? 10'000'000 : 200'000, ticks_of_a_path = 10'000;
  std::uint64_t seed = 1;
  for (const Crowd& crowd : kCrowds) {
    const int paths = static_cast<int>(std::lround(crowd.share_of_ticks * ticks / ticks_of_a_path));
    long touched = 0;
    for (int i = 0; i < paths; ++i) {
      expect_certified(crowd, seed++, ticks_of_a_path, touched);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(touched, paths * ticks_of_a_path / (crowd.particles > 1 ? 10 : 100)) << crowd.name;
  }
}

}  // namespace certificate_test
}  // namespace afm::physics
