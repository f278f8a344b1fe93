// SPDX-License-Identifier: Apache-2.0
#include "curves/fitting/map_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace afm::curves {
namespace map_reading_test {

using testing::HasSubstr;

MapReading whole() {
  MapReading reading;
  reading.fit.shape = fits::Shape::Jkr;
  reading.fit.radius_m = 1e-7 / 3.0;
  reading.fit.poisson = 0.4;
  reading.fit.atomic_distance_m = 0.2e-9;
  reading.fit.most_force_n = 1e-9 / 7.0;
  reading.fit.most_depth_m = 3e-8;
  reading.calibration.spring_constant = physics::Stiffness(0.2 / 3.0);
  reading.calibration.sensitivity_m_per_v = 6e-8 / 7.0;
  return reading;
}

TEST(MapReadingText, GivesTheReadingAgainBitForBit) {
  const auto read = map_reading_of(text_of(whole()));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->fit.shape, fits::Shape::Jkr);
  EXPECT_EQ(read->fit.radius_m, whole().fit.radius_m);
  EXPECT_EQ(read->fit.poisson, 0.4);
  EXPECT_EQ(read->fit.atomic_distance_m, 0.2e-9);
  EXPECT_EQ(read->fit.most_force_n, whole().fit.most_force_n);
  EXPECT_EQ(read->fit.most_depth_m, 3e-8);
  EXPECT_EQ(read->calibration.spring_constant->si, 0.2 / 3.0);
  EXPECT_EQ(read->calibration.sensitivity_m_per_v, whole().calibration.sensitivity_m_per_v);
}

TEST(MapReadingText, LeavesOutWhatIsNotGiven) {
  MapReading reading;
  reading.fit.shape = fits::Shape::Paraboloid;
  reading.fit.radius_m = 30e-9;
  const auto read = map_reading_of(text_of(reading));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->fit.atomic_distance_m);
  EXPECT_TRUE(std::isinf(read->fit.most_force_n));
  EXPECT_FALSE(read->calibration.spring_constant);
  EXPECT_FALSE(read->calibration.sensitivity_m_per_v);
}

// A pixel is felt by its curve: the map need not be fitted, or by a shape that is no law of force.
TEST(MapReadingText, MayHaveNoFitOrThatOfALayer) {
  const auto bare = map_reading_of(text_of(MapReading{}));
  ASSERT_TRUE(bare) << bare.error().message;
  EXPECT_FALSE(bare->fit.shape);
  MapReading layer;
  layer.fit.shape = fits::Shape::LayerExactCone;
  layer.fit.half_angle_rad = 0.31;
  layer.fit.layer_m = 3e-7;
  layer.fit.base = fits::Base::Sliding;
  auto read = map_reading_of(text_of(layer));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->fit.half_angle_rad, 0.31);
  EXPECT_EQ(read->fit.layer_m, 3e-7);
  EXPECT_EQ(read->fit.base, fits::Base::Sliding);
  EXPECT_TRUE(prepare(read->fit));
}

TEST(MapReadingText, IsRefusedIfItIsDamaged) {
  const auto refusal = [](const std::string& text) {
    const auto read = map_reading_of(text);
    return read ? std::string("accepted") : read.error().message;
  };
  EXPECT_THAT(refusal("no"), HasSubstr("the reading of its force map is damaged: "));
  EXPECT_THAT(refusal(R"({"fit":3})"), HasSubstr("damaged"));
  EXPECT_THAT(refusal(R"({"base":"sticky"})"), HasSubstr("there is no base \"sticky\""));
  EXPECT_THAT(refusal(R"({"fit":"cube"})"), HasSubstr("there is no fit \"cube\""));
  EXPECT_THAT(refusal(R"({"fit":"jkr","radius_m":1.0})"), HasSubstr("radius_m: 1.0 is outside 100pm to 1mm"));
  EXPECT_THAT(refusal(R"({"fit":"jkr","radius_m":"wide"})"), HasSubstr("damaged"));
  EXPECT_THAT(refusal(R"({"fit":"jkr","spring_constant_N_per_m":-1})"), HasSubstr("spring_constant_N_per_m is -1"));
  EXPECT_THAT(refusal(R"({"fit":"jkr","sensitivity_m_per_V":0})"), HasSubstr("sensitivity_m_per_V is 0"));
  EXPECT_EQ(refusal(R"({"fit":"jkr","radius_m":3e-8,"later":1})"), "accepted");
}

}  // namespace map_reading_test
}  // namespace afm::curves
