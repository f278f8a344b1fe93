// SPDX-License-Identifier: Apache-2.0
#include "physics/units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

namespace afm::physics {
namespace units_test {

using namespace literals;

TEST(Units, AddExponentsInProductsAndQuotients) {
  static_assert(std::is_same_v<decltype(Stiffness() * Length()), Force>);
  static_assert(std::is_same_v<decltype(Force() * Length()), Energy>);
  static_assert(std::is_same_v<decltype(Energy() / Area()), SurfaceEnergy>);
  static_assert(std::is_same_v<decltype(Length() / Time()), Velocity>);
  static_assert(std::is_same_v<decltype(Mass() * Length() / (Time() * Time())), Force>);
}

TEST(Units, LeavePlainNumbersWhereDimensionsCancel) {
  static_assert(std::is_same_v<decltype(Length() / Length()), double>);
  EXPECT_DOUBLE_EQ(1_um / 1_nm, 1000.0);
}

TEST(Units, KnowThatStiffnessAndSurfaceEnergyAreOneDimension) {
  static_assert(std::is_same_v<Stiffness, SurfaceEnergy>);
}

TEST(Units, TakeRootsOnlyOfFittingDimensions) {
  static_assert(std::is_same_v<decltype(cbrt(Volume())), Length>);
  static_assert(std::is_same_v<decltype(sqrt(Area())), Length>);
  EXPECT_DOUBLE_EQ(cbrt(Volume(27e-27)).si, 3e-9);
  EXPECT_DOUBLE_EQ(sqrt(Area(16e-18)).si, 4e-9);
}

TEST(Units, OrderByValue) {
  EXPECT_LT(1_nm, 1_um);
  EXPECT_EQ(1000_nm, 1_um);
  EXPECT_EQ(std::max(1_nm, 1_pm), 1_nm);
  EXPECT_EQ(abs(-3_nN), 3_nN);
}

TEST(Units, ReadTheSameWhetherWrittenWholeOrWithAPoint) {
  EXPECT_EQ(50_nm, 50.0_nm);
  EXPECT_DOUBLE_EQ((24.5_zJ).si, 2.45e-20);
  EXPECT_DOUBLE_EQ((2.228_mJ_per_m2).si, 2.228e-3);
  EXPECT_DOUBLE_EQ((1.4_nN).si, 1.4e-9);
}

TEST(Units, TravelAsCheaplyAsTheirNumber) {
  static_assert(std::is_trivially_copyable_v<Force>);
  static_assert(sizeof(Force) == sizeof(double));
}

}  // namespace units_test
}  // namespace afm::physics
