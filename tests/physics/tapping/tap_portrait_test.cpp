// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_portrait.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/tapped_sample.h"

namespace afm::physics {
namespace tap_portrait_test {

struct Portrayed {
  explicit Portrayed(const TappedSample& sample, double z_nm)
      : surface(sample.surface()),
        flow(surface, sample.lever()),
        z(z_nm * 1e-9),
        portrait(tap_portrait(surface, sample.lever(), z, 1.15 * sample.lever().free_amplitude)) {}

  std::vector<TapState> stable() {
    std::vector<TapState> states;
    for (const RestingTap& tap : flow.resting_at(z)) {
      if (tap.stable) states.push_back(tap.state);
    }
    return states;
  }

  // Index of the state in which a swing ends that begins here.
  std::size_t end_of(double u, double v) {
    const TapState from{Length(std::hypot(u, v)), std::atan2(v, u)};
    TapState state = from;
    for (int i = 0; i < 3000; ++i) flow.step(state, z, 0.1 * flow.longest_step());
    const auto distance = [&](const TapState& end) {
      return std::hypot(end.amplitude.si * std::cos(end.phase) - state.amplitude.si * std::cos(state.phase),
                        end.amplitude.si * std::sin(end.phase) - state.amplitude.si * std::sin(state.phase));
    };
    const auto nearest =
        std::min_element(portrait.states.begin(), portrait.states.end(),
                         [&](const TapState& a, const TapState& b) { return distance(a) < distance(b); });
    EXPECT_LT(distance(*nearest), 0.1e-9) << "from " << u * 1e9 << ", " << v * 1e9 << " nm";
    return static_cast<std::size_t>(nearest - portrait.states.begin());
  }

  std::shared_ptr<const TapSurface> surface;
  AveragedFlow flow;
  Length z;
  TapPortrait portrait;
};

// At the resonance and beside it, with and without loss, and the island of row T45, which no slow path reaches.
const std::array kTwoStates{std::pair{TappedSample{}, 17.4149}, std::pair{TappedSample{}, 18.4},
                            std::pair{TappedSample{.ratio = 300.1 / 300.0}, 17.0},
                            std::pair{TappedSample{.eta_w0_mpa = 20.0}, 17.6},
                            std::pair{TappedSample{.a0_nm = 10.0}, 7.5}};

TEST(TapPortrait, HasTheStableStatesOfTheFlow) {
  for (const auto& [sample, z_nm] : kTwoStates) {
    Portrayed tapped(sample, z_nm);
    const std::vector<TapState> stable = tapped.stable();
    ASSERT_EQ(tapped.portrait.states.size(), stable.size()) << z_nm;
    EXPECT_EQ(stable.size(), 2U) << z_nm;
    EXPECT_EQ(tapped.portrait.edges.size(), 2U) << z_nm;
    for (std::size_t i = 0; i < stable.size(); ++i) {
      EXPECT_NEAR(nm_of(tapped.portrait.states[i].amplitude), nm_of(stable[i].amplitude), 1e-3) << z_nm;
      EXPECT_NEAR(degrees_of(tapped.portrait.states[i].phase), degrees_of(stable[i].phase), 0.01) << z_nm;
    }
  }
}

TEST(TapPortrait, HasNoEdgeWhereOneStateExists) {
  for (const double z_nm : {5.0, 12.0, 25.0, 60.0}) {
    Portrayed tapped({}, z_nm);
    EXPECT_EQ(tapped.portrait.states.size(), 1U) << z_nm;
    EXPECT_TRUE(tapped.portrait.edges.empty()) << z_nm;
  }
  for (const double z_nm : {-3.0, 0.1}) EXPECT_TRUE(Portrayed({}, z_nm).portrait.states.empty()) << z_nm;
}

// The flow itself, without the table, decides on both sides of the edge.
TEST(TapPortrait, DividesTheSwingsByTheStateInWhichTheyEnd) {
  for (const auto& [sample, z_nm] : kTwoStates) {
    Portrayed tapped(sample, z_nm);
    const double beside = 0.01 * sample.a0_nm * 1e-9, inside = sample.a0_nm * 1e-9;
    int judged = 0;
    for (const std::vector<SwingPoint>& edge : tapped.portrait.edges) {
      for (std::size_t i = 5; i + 1 < edge.size(); i += 25) {
        const double u = edge[i].u.si, v = edge[i].v.si;
        if (std::hypot(u, v) > inside) continue;
        const double along_u = edge[i + 1].u.si - u, along_v = edge[i + 1].v.si - v;
        const double share = beside / std::hypot(along_u, along_v);
        const std::size_t left = tapped.end_of(u - share * along_v, v + share * along_u);
        const std::size_t right = tapped.end_of(u + share * along_v, v - share * along_u);
        EXPECT_NE(left, right) << z_nm << " at " << u * 1e9 << ", " << v * 1e9;
        ++judged;
      }
    }
    EXPECT_GT(judged, 4) << z_nm;
  }
}

}  // namespace tap_portrait_test
}  // namespace afm::physics
