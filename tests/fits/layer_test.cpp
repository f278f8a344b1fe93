// SPDX-License-Identifier: Apache-2.0
#include "fits/layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace afm::fits {
namespace layer_test {

struct Row {
  const char* id;
  double strain, factor;
};

// The lab's cases, from 60 Gauss nodes.
TEST(LayerTable, IsTheExactLayer) {
  const LayerTable bonded(Profile::Paraboloid, Base::Bonded, 0.5), sliding(Profile::Paraboloid, Base::Sliding, 0.5),
      cone(Profile::Cone, Base::Bonded, 0.5);
  for (const Row& row : {Row{"P09", 0.09621718018, 1.123544397}, Row{"P11", 0.4172068752, 1.857116758},
                         Row{"P12", 0.5543754078, 2.38120009}, Row{"P13", 0.7479408303, 3.37109831}}) {
    EXPECT_NEAR(bonded.at(row.strain).factor / row.factor, 1.0, 1e-6) << row.id;
  }
  for (const Row& row : {Row{"P15", 0.4435369064, 1.481577436}, Row{"P16", 0.747744445, 1.997487234}}) {
    EXPECT_NEAR(sliding.at(row.strain).factor / row.factor, 1.0, 1e-6) << row.id;
  }
  for (const Row& row : {Row{"P17", 0.2802597311, 1.264346855}, Row{"P19", 0.8775573814, 2.591922686},
                         Row{"P20", 1.04781178, 3.238866259}}) {
    EXPECT_NEAR(cone.at(row.strain).factor / row.factor, 1.0, 1e-6) << row.id;
  }
}

TEST(LayerTable, BeginsWithTheLeadingCoefficient) {
  EXPECT_NEAR(LayerTable(Profile::Paraboloid, Base::Bonded, 0.5).at(0.0).slope, 1.126954999, 3e-4) << "P21";
  for (const double poisson : {0.0, 0.3, 0.5}) {
    EXPECT_NEAR(LayerTable(Profile::Paraboloid, Base::Sliding, poisson).at(0.0).slope, 0.7433024998, 3e-4) << "P21";
  }
}

TEST(LayerTable, StiffensWithTheStrainAndHasItsOwnSlope) {
  for (const Profile profile : {Profile::Paraboloid, Profile::Cone}) {
    for (const BaseName& base : kBases) {
      for (const double poisson : {0.0, 0.2, 0.49, 0.5}) {
        const LayerTable table(profile, base.base, poisson);
        EXPECT_GT(table.largest_strain(), 1.0);
        double before = 1.0;
        for (double strain = 0.01; strain < 1.2 * table.largest_strain(); strain *= 1.1) {
          const double step = 1e-6 * strain, here = table.at(strain).factor;
          EXPECT_GT(here, before);
          before = here;
          const double slope = std::log(table.at(strain + step).factor / table.at(strain - step).factor) / (2.0 * step);
          EXPECT_NEAR(slope, table.at(strain).slope, 1e-5 * slope) << base.name << ", " << strain;
        }
        EXPECT_EQ(table.at(0.0).factor, 1.0);
      }
    }
  }
  EXPECT_THROW(LayerTable(Profile::Cone, Base::Bonded, 0.51), std::invalid_argument);
  EXPECT_THROW(LayerTable(Profile::Cone, Base::Bonded, std::nan("")), std::invalid_argument);
}

}  // namespace layer_test
}  // namespace afm::fits
