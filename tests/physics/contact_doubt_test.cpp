// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "gel_curve.h"
#include "physics/curve_analysis.h"

// Gels of 0.3 to 100 kPa with typical disturbances of the contact point: tilt, laser waves, no baseline.
namespace contact_doubt_test {

using namespace afm::physics;
using namespace afm::test;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random(seed) {}
  double even(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  double ratio(double low, double high) { return std::exp(even(std::log(low), std::log(high))); }

  // Pushed by 0.3 nN to 15 nN.
  Gel gel() {
    Gel drawn;
    drawn.modulus_pa = ratio(300.0, 100e3);
    const double push_n = std::min(force_n(drawn.modulus_pa, even(200e-9, 2e-6)), even(0.3e-9, 15e-9));
    drawn.depth_m = std::pow(push_n / force_n(drawn.modulus_pa, 1.0), 2.0 / 3.0) + push_n / kSpring;
    drawn.outside_m = even(0.5e-6, 3e-6);
    drawn.period_m = even(200e-9, 800e-9);
    drawn.phase = even(0.0, 6.28);
    drawn.points = static_cast<int>(even(500.0, 4000.0));
    return drawn;
  }

  std::mt19937_64 random;
};

struct Judged {
  CurveFeatures features;
  double error_m = 0.0;  // error of the contact point
  bool off = false;      // true: true contact point outside the stated range
};

Judged judged(const Gel& gel, std::mt19937_64& random) {
  Judged result{analyse(gel_cycle(gel, random))};
  const auto& found = result.features;
  result.error_m = found.contact_point ? found.contact_point->si - kContactM : HUGE_VAL;
  result.off =
      !found.contact_range || found.contact_range->low.si > kContactM || found.contact_range->high.si < kContactM;
  return result;
}

TEST(ContactPointOfAGel, IsRightAndNotDoubtfulOnCleanAndTiltedCurves) {
  Draw draw(1);
  std::vector<double> errors_m;
  for (int i = 0; i < 40; ++i) {
    Gel gel = draw.gel();
    gel.outside_m = std::max(gel.outside_m, 0.4 * gel.depth_m);
    if (i % 2 == 1) gel.tilt = draw.even(-1e-3, 1e-3);
    const Judged found = judged(gel, draw.random);
    EXPECT_FALSE(found.features.contact_doubtful)
        << gel.modulus_pa << " Pa, " << gel.depth_m << " m, " << found.error_m;
    EXPECT_FALSE(found.off) << gel.modulus_pa << " Pa, " << gel.depth_m << " m, " << found.error_m;
    EXPECT_LT(std::abs(found.error_m), 0.02 * gel.depth_m + 3e-9) << gel.modulus_pa << " Pa, " << gel.depth_m << " m";
    errors_m.push_back(std::abs(found.error_m));
  }
  std::nth_element(errors_m.begin(), errors_m.begin() + 20, errors_m.end());
  EXPECT_LT(errors_m[20], 3e-9);
}

// Off by more than the stated range, or by a tenth of the depth.
TEST(ContactPointOfAGel, IsDoubtfulWhereItIsOffByMoreThanItsRange) {
  Draw draw(2);
  std::size_t off = 0, far = 0, doubted_off = 0, doubted_far = 0;
  for (int i = 0; i < 160; ++i) {
    Gel gel = draw.gel();
    if (i % 4 >= 2) gel.tilt = draw.even(-1e-3, 1e-3);
    if (i % 3 != 1) gel.wave_n = draw.even(10e-12, 150e-12);
    if (i % 2 == 1) gel.outside_m = draw.even(-0.2, 0.05) * gel.depth_m;
    const Judged found = judged(gel, draw.random);
    if (!found.features.contact_point) continue;  // curve without a push above the waves
    const bool is_far = std::abs(found.error_m) > 0.1 * gel.depth_m, doubted = found.features.contact_doubtful;
    off += found.off ? 1 : 0;
    far += is_far ? 1 : 0;
    doubted_off += found.off && doubted ? 1 : 0;
    doubted_far += is_far && doubted ? 1 : 0;
  }
  EXPECT_GE(doubted_off, off - off / 10) << "of " << off;
  EXPECT_GE(far, 30U) << "curves that are too easy";
  EXPECT_GE(doubted_far, far - far / 10) << "of " << far;
}

}  // namespace contact_doubt_test
