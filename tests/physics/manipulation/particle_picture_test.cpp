// SPDX-License-Identifier: Apache-2.0
// Invariant: a picture updated after a push equals the whole computation bit for bit, and all other pixels keep their
// bits
#include "physics/manipulation/particle_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "physics/imaging/morphology.h"
#include "physics/manipulation/sample_drift.h"
#include "pushing.h"

namespace afm::physics {
namespace particle_picture_test {

using namespace literals;
using test::expect_relative;

PushSetup setup_of(const std::vector<ParticleSpecies>& species) {
  return {.tip = test::flank_tip(10_nm),
          .springs = {Stiffness(10.0), Stiffness(1.0), Stiffness(100.0)},
          .tip_friction = 0.3,
          .species = species};
}

PlacedParticle particle_at(double x_nm, double y_nm, std::size_t species = 0, double angle_rad = 0.0) {
  return {.species = species, .position = {Length(1e-9 * x_nm), Length(1e-9 * y_nm)}, .angle_rad = angle_rad};
}

ParticlePlace place_of(const PlacedParticle& particle) { return {particle.position, half_turn(particle.angle_rad)}; }

// 1 um of 128 lines.
PictureFrame usual_frame() { return {{Length(-0.5e-6), Length(-0.5e-6)}, Length(1e-6 / 128.0), 128, 128}; }

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(PushCases, N68TheAgeOfAPictureThatDrifts) {
  const double expected[] = {50.0, 250.0, 500.0}, radii[] = {5e-9, 25e-9, 50e-9};
  for (int i = 0; i < 3; ++i) {
    const Length radius(radii[i]);
    expect_relative(PlaceDoubt{Length(0.0), kUsualDrift}.stale_after(radius).si, expected[i], 1e-9);
    expect_relative(PlaceDoubt{Length(0.0), 0.1 * kUsualDrift}.stale_after(radius).si, 10.0 * expected[i], 1e-9);
    // the drift itself has gone as far
    expect_relative(magnitude(SampleDrift(kUsualDrift, 7).after(Time(expected[i]))).si, 0.5 * radii[i], 1e-9);
  }
}

TEST(SampleDrift, GoesInADirectionOfItsSeed) {
  const Sideways<Length> way = SampleDrift(kUsualDrift, 7).after(1_s);
  // the number of the seed 7 is that of N58
  EXPECT_NEAR(std::atan2(way.y.si, way.x.si), 2.0 * std::numbers::pi * (0.6093945246 - 1.0), 1e-9);
  EXPECT_NE(way, SampleDrift(kUsualDrift, 8).after(1_s));
}

TEST(SampleDrift, LeavesADoubtThatGrowsFromThatOfTheMeasurement) {
  const PlaceDoubt doubt{3_nm, kUsualDrift};
  EXPECT_DOUBLE_EQ(doubt.after(0_s).si, 3e-9);
  EXPECT_NEAR(doubt.after(80_s).si, 5e-9, 1e-20);
  EXPECT_NEAR(doubt.after(doubt.stale_after(25_nm)).si, 12.5e-9, 1e-20);
  EXPECT_EQ(doubt.stale_after(5_nm), 0_s);
  EXPECT_TRUE(std::isinf((PlaceDoubt{3_nm, Velocity(0.0)}.stale_after(25_nm).si)));
}

TEST(PushCases, N69ThePixelsOfAPatch) {
  const PushSetup setup = setup_of({test::gold()});
  expect_relative(footprint_radius(setup.tip, 25_nm).si, 4.02539042e-08, 1e-6);
  std::mt19937_64 random(69);
  std::uniform_real_distribution<double> place_nm(-200.0, 200.0);
  double pixels = 0.0;
  constexpr int kRounds = 400;
  for (int round = 0; round < kRounds; ++round) {
    const double x_nm = place_nm(random);
    const std::vector<PlacedParticle> particles{particle_at(x_nm, place_nm(random))};
    ParticlePicture picture(setup, particles, usual_frame());
    const ParticlePlace before = place_of(particles[0]);
    ParticlePlace after = before;
    after.position.x = after.position.x + 100_nm;
    const PixelBox box = picture.box_around(0, before, after);
    EXPECT_EQ(box.columns * box.rows, 300U);
    const PixelBox changed = picture.move(0, before, std::vector{after});
    EXPECT_EQ(changed.columns, box.columns);
    EXPECT_EQ(changed.rows, box.rows);
    pixels += static_cast<double>(picture.computed()) / kRounds;
  }
  expect_relative(pixels, 166.8075966, 0.02);
}

TEST(PushCases, N77TheTimeOfASecondLook) {
  EXPECT_EQ(scan_time(128, 2_Hz), 64_s);
  EXPECT_EQ(scan_time(kLookLines, 2_Hz), Time(16.5));
  expect_relative(scan_time(kLookLines, 10_Hz).si, 3.3, 1e-9);
  // this many lines have three footprint radii to each side
  const PushSetup setup = setup_of({test::gold()});
  const PictureFrame frame = frame_around(setup, {particle_at(0, 0)});
  expect_relative(frame.pixel.si * (kLookLines - 1), 6.0 * 4.02539042e-08, 1e-6);
  EXPECT_EQ(frame.columns, 64U + 1U);
}

// The image of a block after it has moved differs only in both footprints, as wide as the tip makes them.
TEST(PushCases, N83TheUpdateOfAnImage) {
  const auto line = [](std::size_t first) {
    HeightGrid surface{.columns = 13, .rows = 1, .height_m = std::vector<double>(13, 0.0)};
    for (std::size_t i = first; i < first + 3; ++i) surface.height_m[i] = 3.0;
    return surface;
  };
  const TipGrid tip{2, 0, {4.0, 1.0, 0.0, 1.0, 4.0}};
  const std::vector<double> before = dilate(line(2), tip).height_m, after = dilate(line(7), tip).height_m;
  EXPECT_EQ(after, (std::vector<double>{0, 0, 0, 0, 0, 0, 2, 3, 3, 3, 2, 0, 0}));
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] != after[i]) changed.push_back(i);
  }
  EXPECT_EQ(changed.front(), 1U);
  EXPECT_EQ(changed.back(), 10U);
}

ParticleSpecies tube() {
  ParticleSpecies species = test::constant(Force(30e-9), 1.0, 20_nm);
  species.length = 300_nm;
  return species;
}

TEST(ParticlePicture, IsUpdatedToTheBitsOfTheWholePicture) {
  const PushSetup setup = setup_of({test::gold(), tube()});
  std::mt19937_64 random(83);
  std::uniform_real_distribution<double> place_nm(-450.0, 450.0), step_nm(-80.0, 80.0), angle(-3.0, 3.0);
  for (int round = 0; round < 60; ++round) {
    std::vector<PlacedParticle> particles;
    for (std::size_t i = 0; i < 12; ++i) {
      const double x_nm = place_nm(random), y_nm = place_nm(random);
      particles.push_back(particle_at(x_nm, y_nm, i < 9 ? 0 : 1, i < 9 ? 0.0 : angle(random)));
    }
    ParticlePicture picture(setup, particles, usual_frame());
    const HeightGrid old = picture.heights();
    std::vector<ParticlePlace> before, now;
    for (const PlacedParticle& particle : particles) before.push_back(place_of(particle));
    now = before;
    const std::size_t moved[] = {random() % 9, 9 + random() % 3, random() % 9};
    for (const std::size_t i : moved) {
      particles[i].position = {particles[i].position.x + Length(1e-9 * step_nm(random)),
                               particles[i].position.y + Length(1e-9 * step_nm(random))};
      particles[i].angle_rad += i < 9 ? 0.0 : 0.1 * angle(random);
      now[i] = place_of(particles[i]);
    }
    for (const std::size_t i : moved) picture.move(i, before[i], now);
    const ParticlePicture whole(setup, particles, usual_frame());
    std::size_t changed = 0;
    for (std::size_t row = 0; row < 128; ++row) {
      for (std::size_t column = 0; column < 128; ++column) {
        const double there = picture.heights().at(column, row);
        ASSERT_TRUE(same_bits(there, whole.heights().at(column, row))) << column << " " << row;
        if (same_bits(there, old.at(column, row))) continue;
        ++changed;
        ASSERT_EQ(picture.source(column, row), ParticlePicture::Source::Computed);
      }
    }
    EXPECT_GT(changed, 0U);
    EXPECT_LT(picture.computed(), 128U * 128U / 4U) << "far from the pushes every pixel is as it was measured";
  }
}

TEST(ParticlePicture, ShowsATouchWhereTheTipTouches) {
  const PushSetup setup = setup_of({test::gold()});
  const ParticlePicture picture(setup, {particle_at(0, 0)}, usual_frame());
  for (std::size_t column = 60; column < 70; ++column) {
    const double x_m = -0.5e-6 + static_cast<double>(column) * 1e-6 / 128.0;
    const double touches_m = touching_height(setup.tip, 25_nm, Length(std::abs(x_m))).si;
    EXPECT_NEAR(picture.heights().at(column, 64), touches_m, 1e-20);
  }
  EXPECT_DOUBLE_EQ(picture.heights().at(64, 64), 50e-9);
  EXPECT_EQ(picture.heights().at(10, 10), 0.0);
}

TEST(ParticlePicture, IsMeasuredAgainInABoxAlone) {
  const PushSetup setup = setup_of({test::gold()});
  const std::vector<PlacedParticle> particles{particle_at(0, 0)};
  ParticlePicture picture(setup, particles, usual_frame());
  const ParticlePlace before = place_of(particles[0]);
  ParticlePlace after = before;
  after.position.x = 200_nm;
  picture.move(0, before, std::vector{after});
  const std::size_t computed = picture.computed();
  after.position.y = 15_nm;  // true place
  const PixelBox box{74, 48, kLookLines, kLookLines};
  picture.measure(box, std::vector{after});
  EXPECT_GT(picture.computed(), 0U) << "the old footprint is outside of the box";
  EXPECT_LT(picture.computed(), computed);
  for (std::size_t row = box.first_row; row < box.first_row + box.rows; ++row) {
    for (std::size_t column = box.first_column; column < box.first_column + box.columns; ++column) {
      ASSERT_EQ(picture.source(column, row), ParticlePicture::Source::Measured);
    }
  }
  const double top_m = *std::max_element(picture.heights().height_m.begin(), picture.heights().height_m.end());
  EXPECT_NEAR(top_m, 50e-9, 1e-9);
  EXPECT_NEAR(picture.heights().height_at_m(200e-9, 15e-9), 50e-9, 1e-9);
}

// Pushed off the picture's border, a particle leaves no pixel wrong and none out of bounds.
TEST(ParticlePicture, IsClippedAtItsBorder) {
  const PushSetup setup = setup_of({test::gold()});
  const std::vector<PlacedParticle> particles{particle_at(480, 480)};
  ParticlePicture picture(setup, particles, usual_frame());
  const ParticlePlace before = place_of(particles[0]);
  ParticlePlace after = before;
  after.position = {2_um, 2_um};
  const PixelBox box = picture.move(0, before, std::vector{after});
  EXPECT_EQ(box.first_column + box.columns, 128U);
  EXPECT_EQ(picture.heights().range_m(), 0.0);
  after.position.x = Length(std::numeric_limits<double>::max());
  EXPECT_EQ(picture.move(0, before, std::vector{after}).first_column, box.first_column);
}

}  // namespace particle_picture_test
}  // namespace afm::physics
