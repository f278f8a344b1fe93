// SPDX-License-Identifier: Apache-2.0
#include "physics/contact_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string_view>
#include <vector>

#include "physics/curve_analysis.h"

namespace afm::physics {
namespace contact_point_test {

using namespace literals;

constexpr double kDepth_m = 500e-9, kFar_m = 2e-6, kPush_n = 4e-9;
const Stiffness kLever = 0.05_N_per_m;

// A sphere on a soft sample with contact at Z = 0; `added` gives what an instrument adds to the force at Z, in newtons.
template <class Added>
std::vector<CurvePoint> hertz_approach(Added added) {
  std::vector<CurvePoint> points;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const double indentation = -kFar_m + (kFar_m + kDepth_m) * i / (kCount - 1);
    const Force force(indentation > 0 ? kPush_n * std::pow(indentation / kDepth_m, 1.5) : 0.0);
    const Length z = Length(-indentation) - force / kLever;
    points.push_back({z, force + Force(added(z.si)), Branch::Approach});
  }
  return points;
}

double noise_n(std::mt19937_64& random) { return std::normal_distribution<double>(0.0, 0.002 * kPush_n)(random); }

const Length kPushed = Length(kDepth_m) + Force(kPush_n) / kLever;

class EachMethod : public testing::TestWithParam<ContactMethodName> {};

TEST_P(EachMethod, FindsASoftContactThroughNoise) {
  std::mt19937_64 random(3);
  const auto found = contact_point(hertz_approach([&](double) { return noise_n(random); }), GetParam().method);
  ASSERT_TRUE(found);
  // the kink of two straight lines lies deeper than the contact of a curved force
  const double bound = GetParam().method == ContactMethod::FitLine ? 0.3 : 0.1;
  EXPECT_NEAR(*found / kPushed, 0.0, bound);
}

TEST_P(EachMethod, FindsARigidContact) {
  std::vector<CurvePoint> points;
  for (int i = 0; i <= 1000; ++i) {
    const Length z(1e-6 - 1.2e-9 * i);
    points.push_back({z, std::max(Force(), -z * 0.1_N_per_m), Branch::Approach});
  }
  const auto found = contact_point(points, GetParam().method);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->si, 0.0, 0.05 * 200e-9);
}

INSTANTIATE_TEST_SUITE_P(ContactPoint, EachMethod, testing::ValuesIn(kContactMethods), [](const auto& test) {
  std::string name(test.param.name);
  std::erase(name, '-');
  return name;
});

TEST(ContactPoint, IsNotMovedByAnUndulatingBaseline) {
  const auto points = hertz_approach([](double z) { return 0.01 * kPush_n * std::sin(z / 30e-9); });
  const CurveFeatures found = analyse(points);
  ASSERT_TRUE(found.contact_point);
  EXPECT_EQ(found.contact_method, ContactMethod::FitPolynomial);
  EXPECT_NEAR(*found.contact_point / kPushed, 0.0, 0.05);
  EXPECT_FALSE(found.contact_doubtful);
}

TEST(ContactPoint, IsNotMovedByALongTail) {
  const auto points =
      hertz_approach([](double z) { return z > 0 ? 0.02 * kPush_n * std::exp(-z / 500e-9) : 0.02 * kPush_n; });
  const CurveFeatures by_default = analyse(points);
  ASSERT_TRUE(by_default.contact_point);
  EXPECT_NEAR(*by_default.contact_point / kPushed, 0.0, 0.15);
  // the zero of the force runs out along the tail
  const CurveFeatures by_zero = analyse(points, ForceZero::Instrument, ContactMethod::ZeroForce);
  ASSERT_TRUE(by_zero.contact_point);
  EXPECT_GT(*by_zero.contact_point / kPushed, 0.5);
}

TEST(ContactPoint, IsDoubtfulWhereTheMethodsDisagree) {
  std::vector<CurvePoint> points;
  std::mt19937_64 random(5);
  for (int i = 0; i <= 4000; ++i) {
    const double z = 4e-6 - 1e-9 * i;
    points.push_back(
        {Length(z), Force(1e-9 * 40e-9 / (z + 40e-9) + 1e-12 * noise_n(random) / kPush_n), Branch::Approach});
  }
  const CurveFeatures found = analyse(points);
  ASSERT_TRUE(found.contact_point);
  EXPECT_TRUE(found.contact_doubtful);
}

// An analysis finds them all together, from profiles that they share.
TEST(ContactPoint, OfAnAnalysisIsThatOfEachMethodAlone) {
  std::mt19937_64 random(7);
  const auto points = hertz_approach([&](double) { return noise_n(random); });
  const CurveFeatures found = analyse(points, ForceZero::True);
  for (std::size_t i = 0; i < kContactMethods.size(); ++i) {
    const auto alone = contact_point(points, kContactMethods[i].method);
    ASSERT_TRUE(alone && found.contact_estimates[i]) << kContactMethods[i].name;
    EXPECT_EQ(found.contact_estimates[i]->si, alone->si) << kContactMethods[i].name;
  }
}

// Points that fall, as recorded, are only turned around; all others are sorted.
TEST(ContactPoint, DoesNotDependOnTheOrderOfThePoints) {
  std::mt19937_64 random(9);
  const auto falling = hertz_approach([&](double) { return noise_n(random); });
  std::vector<CurvePoint> rising(falling.rbegin(), falling.rend()), shuffled(falling);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  for (const ContactMethodName& each : kContactMethods) {
    if (each.method == ContactMethod::ZeroForce) continue;  // method that moves along the recording
    const auto as_recorded = contact_point(falling, each.method);
    ASSERT_TRUE(as_recorded) << each.name;
    for (const auto& other : {rising, shuffled}) {
      EXPECT_NEAR(contact_point(other, each.method)->si, as_recorded->si, 1e-15) << each.name;
    }
  }
}

// Samples from one that yields far more than the lever to one that hardly yields.
TEST(ContactPoint, OfAnyShareOfTheLeverIsFound) {
  for (const double softer : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    std::vector<CurvePoint> points;
    for (int i = 0; i <= 400; ++i) {
      const double depth = (i - 200) / 200.0;  // depth of the tip, relative to the largest
      const double force = depth > 0.0 ? std::pow(depth, 1.5) : 0.0;
      points.push_back({Length(-1e-6 * (depth + softer * force)), Force(1e-9 * force), Branch::Approach});
    }
    const auto found = contact_point(points, ContactMethod::FitPolynomial);
    ASSERT_TRUE(found) << softer;
    EXPECT_NEAR(found->si / (1e-6 * (1.0 + softer)), 0.0, 0.02) << softer;
  }
}

TEST(ContactPoint, HasAMethodForEachName) {
  std::set<std::string_view> names;
  for (const ContactMethodName& each : kContactMethods) {
    EXPECT_EQ(name_of(each.method), each.name);
    names.insert(each.name);
  }
  EXPECT_EQ(names.size(), kContactMethods.size());
}

}  // namespace contact_point_test
}  // namespace afm::physics
