// SPDX-License-Identifier: Apache-2.0
#include "physics/branch_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace afm::physics {
namespace branch_table_test {

using namespace literals;

constexpr int kFirstOctave = -34;  // u = 5.8e-11 sqrt(m): |Z - Z_end| = 3.4e-21 m

// A piece with the values and slopes of a function of u.
template <class Force, class Slope>
BranchTable::Piece piece_of(double start, double last_u, Force force, Slope slope) {
  BranchTable::Piece piece{start, kFirstOctave, last_u, {}};
  double u = 0.0;
  for (std::size_t i = 1; u < last_u; ++i) {
    piece.nodes.push_back({force(u), slope(u)});
    u = std::min(BranchTable::node_u(kFirstOctave, i), last_u);
  }
  piece.nodes.push_back({force(u), slope(u)});
  return piece;
}

TEST(BranchTable, IsZeroUnlessFilled) {
  EXPECT_EQ(BranchTable().force(3_nm), 0_nN);
  EXPECT_EQ(BranchTable().force(-1_m), 0_nN);
}

TEST(BranchTable, KeepsAStraightLineExactly) {
  const BranchTable line = BranchTable::straight(2_nN, Stiffness(-0.1));
  for (const double z : {-1.0, -3e-9, 0.0, 14e-9, 1.0}) EXPECT_EQ(line.force(Length(z)).si, 2e-9 - 0.1 * z);
}

TEST(BranchTable, KeepsALineThatIsTabulatedToRounding) {
  const auto force = [](double u) { return -1.4e-9 + 0.1 * u * u; };
  const auto slope = [](double u) { return 0.2 * u; };
  const BranchTable table(14_nm, BranchTable::Side::Below, {piece_of(0.0, 2e-3, force, slope)});
  for (int i = 0; i < 10'000; ++i) {
    const double z = 14e-9 - 5e-6 * i / 10'000.0;  // the last fifth beyond the nodes
    ASSERT_NEAR(table.force(Length(z)).si, -1.4e-9 + 0.1 * (14e-9 - z), 1e-21 + 1e-14 * std::abs(z));
  }
}

TEST(BranchTable, FollowsASquareRootIntoItsFold) {
  const auto force = [](double u) { return -1e-9 - 2e-5 * u; };
  const auto slope = [](double) { return -2e-5; };
  const BranchTable table(3_nm, BranchTable::Side::Above, {piece_of(0.0, 1e-3, force, slope)});
  for (double distance = 1e-24; distance < 1e-7; distance *= 1.7) {
    const double z = 3e-9 + distance;
    ASSERT_NEAR(table.force(Length(z)).si, -1e-9 - 2e-5 * std::sqrt(z - 3e-9), 1e-23) << distance;
  }
}

TEST(BranchTable, KeepsTheForceOfItsEndOnTheOtherSideOfIt) {
  const auto force = [](double u) { return -1e-9 + 2e-5 * u; };
  const auto slope = [](double) { return 2e-5; };
  const BranchTable table(3_nm, BranchTable::Side::Above, {piece_of(0.0, 1e-4, force, slope)});
  EXPECT_EQ(table.force(3_nm).si, -1e-9);
  EXPECT_EQ(table.force(1_nm).si, -1e-9);
}

TEST(BranchTable, GoesOnFarAwayAsThePowerThatItHasThere) {
  // F = -C/Z^2 from the end at Z = 0 on
  const auto force = [](double u) { return -1e-27 / std::pow(u * u + 1e-9, 2.0); };
  const auto slope = [](double u) { return 4e-27 * u / std::pow(u * u + 1e-9, 3.0); };
  const BranchTable table(0_nm, BranchTable::Side::Above, {piece_of(0.0, 1e-3, force, slope)});
  for (const double z : {0.99e-6, 1.01e-6, 2e-6, 1e-5}) {
    EXPECT_NEAR(table.force(Length(z)).si / (-1e-27 / std::pow(z + 1e-9, 2.0)), 1.0, 5e-3) << z;
  }
  EXPECT_NEAR(table.force(1_m).si, 0.0, 1e-24);
}

// A tabulated force cannot continue indefinitely: one that has not begun to fall falls as 1/distance.
TEST(BranchTable, LetsAForceThatDoesNotFallWhereItEndsFallAsTheDistance) {
  const auto flat = [](double) { return -2e-9; };
  const auto level = [](double) { return 0.0; };
  const BranchTable table(0_nm, BranchTable::Side::Above, {piece_of(0.0, 1e-4, flat, level)});
  const double reach_m = 1e-8;
  EXPECT_NEAR(table.force(Length(2.0 * reach_m)).si, -1e-9, 1e-18);
  EXPECT_NEAR(table.force(Length(10.0 * reach_m)).si, -2e-10, 1e-19);
}

TEST(BranchTable, HasAnEdgeWhereTwoPiecesMeet) {
  // flat for a nanometre below the end, then a slope: a kink that no cubic across it could follow
  const auto flat = [](double) { return -1e-9; };
  const auto steep = [](double u) { return -1e-9 + 5.0 * u * u; };
  const auto none = [](double) { return 0.0; };
  const auto slope = [](double u) { return 10.0 * u; };
  const BranchTable table(0_nm, BranchTable::Side::Below,
                          {piece_of(0.0, std::sqrt(1e-9), flat, none), piece_of(1e-9, 1e-3, steep, slope)});
  for (double x = 1e-12; x < 1e-9; x += 1.3e-11) ASSERT_NEAR(table.force(Length(-x)).si, -1e-9, 1e-24);
  for (double x = 1e-9; x < 1e-8; x += 1.3e-11) {
    ASSERT_NEAR(table.force(Length(-x)).si, -1e-9 + 5.0 * (x - 1e-9), 1e-22);
  }
}

TEST(BranchTable, PassesThroughEquallySpacedNodes) {
  const std::vector<BranchTable::Node> nodes{{-2e-9, 1.0}, {-1e-9, 1.0}, {0.0, 1.0}, {1e-9, 1.0}};
  const BranchTable table(5_nm, BranchTable::Side::Below, 1_nm, nodes);
  for (const double z : {5.0, 4.5, 4.0, 3.3, 2.0, 0.0}) {
    EXPECT_NEAR(table.force(Length(z * 1e-9)).si, (3.0 - z) * 1e-9, 1e-22) << z;
  }
  EXPECT_EQ(table.force(7_nm).si, -2e-9);
}

TEST(BranchTable, AnswersWhateverItIsAsked) {
  const auto force = [](double u) { return -1e-9 + 2e-5 * u; };
  const auto slope = [](double) { return 2e-5; };
  const BranchTable table(3_nm, BranchTable::Side::Below, {piece_of(0.0, 1e-4, force, slope)});
  for (const double z : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, -1e300, 5e-324}) table.force(Length(z));
  EXPECT_EQ(table.force(Length(std::nan(""))).si, -1e-9);
}

}  // namespace branch_table_test
}  // namespace afm::physics
