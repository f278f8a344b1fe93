// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/tapped_cycle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "curves/curve_file.h"
#include "exhibit/report/measurement.h"
#include "exhibit/report/report.h"
#include "physics/contact_phase.h"
#include "support/phrases.h"
#include "support/samples/tapped_sample.h"

namespace afm::exhibit {
namespace tapped_cycle_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kA0 = 20e-9, kTop = 22e-9, kBottom = 10e-9;
constexpr double kAttracted = 2.0, kRepelled = 0.7;  // rad

// Goes down with an amplitude of Z - 1 nm and up with one of Z in the repulsive state, below 18 nm; the jumps are
// `shift_m` above those of the law.
servo::RecordedSession cycle(const curves::SampleModel& sample, double shift_m = 0.0) {
  servo::RecordedSession session;
  session.material = "mica";
  session.parameters = sample.parameters;
  const double in_m = sample.figures().z_jtc.si + shift_m, out_m = sample.figures().z_joc.si + shift_m;
  constexpr int kWay = 1200;
  bool repelled = false;
  const auto add = [&](double z_m) {
    scene::TipSample tick;
    tick.time_ns = static_cast<std::int64_t>(session.samples.size()) * 1'000'000;
    tick.servo_state = scene::ServoState::Running;
    tick.phase = repelled ? physics::Phase::Attached : physics::Phase::Free;
    tick.tip.z_m = z_m;
    tick.tip.force_n = repelled ? 0.4e-9 : -0.5e-9;
    tick.swing.amplitude_m = std::fmin(kA0, repelled ? z_m : z_m - 1e-9);
    tick.swing.phase_rad = repelled ? kRepelled : kAttracted;
    session.samples.push_back(tick);
  };
  const auto jump = [&](physics::EventKind kind, double z_m) {
    scene::TipEvent event;
    event.kind = kind;
    event.time_ns = session.samples.back().time_ns;
    event.z_m = z_m;
    session.events.push_back(event);
    repelled = !repelled;
  };
  const double step_m = (kTop - kBottom) / kWay;
  for (int i = 0; i <= kWay; ++i) {
    add(kTop - step_m * i);
    if (!repelled && session.samples.back().tip.z_m <= in_m) jump(physics::EventKind::JumpToRepulsion, in_m);
  }
  for (int i = 1; i <= kWay; ++i) {
    add(kBottom + step_m * i);
    if (repelled && session.samples.back().tip.z_m >= out_m) jump(physics::EventKind::JumpToAttraction, out_m);
  }
  return session;
}

const curves::SampleModel& sample() {
  static const curves::SampleModel model = test::tapped_sample();
  return model;
}

TEST(TappedCycle, HasBothJumpsWithTheSwingsBesideThemAndBothLoops) {
  const servo::RecordedSession session = cycle(sample());
  const TappedCycle found = tapped_cycle(session);
  EXPECT_EQ(found.free_amplitude_m, kA0);
  EXPECT_EQ(found.drive_hz, 300e3);
  ASSERT_TRUE(found.to_repulsion && found.to_attraction);
  const double in_m = sample().figures().z_jtc.si, out_m = sample().figures().z_joc.si;
  EXPECT_EQ(found.to_repulsion->z_m, in_m);
  EXPECT_NEAR(found.to_repulsion->before.amplitude_m, in_m - 1e-9, 0.1e-9);
  EXPECT_EQ(found.to_repulsion->before.phase_rad, kAttracted);
  EXPECT_NEAR(found.to_repulsion->after.amplitude_m, in_m, 0.1e-9);
  EXPECT_EQ(found.to_attraction->before.phase_rad, kRepelled);
  EXPECT_EQ(found.to_attraction->after.phase_rad, kAttracted);
  EXPECT_NEAR(found.hysteresis_width_m(), out_m - in_m, 1e-15);
  // between the jumps the amplitude differs by 1 nm, and the force by 0.9 nN
  EXPECT_NEAR(found.reduction_loop_m2, -1e-9 * (out_m - in_m), 0.03e-18);
  EXPECT_NEAR(found.mean_force_work_j, 0.9e-9 * (out_m - in_m), 0.03e-18);
}

TEST(TappedCycle, HasNoLoopWithoutForce) {
  servo::RecordedSession session = cycle(sample());
  for (scene::TipSample& tick : session.samples) tick.servo_state = scene::ServoState::Disarmed;
  session.events.clear();
  const TappedCycle found = tapped_cycle(session);
  EXPECT_EQ(found.reduction_loop_m2, 0.0);
  EXPECT_EQ(found.mean_force_work_j, 0.0);
  EXPECT_FALSE(found.to_repulsion);
  EXPECT_EQ(found.hysteresis_width_m(), 0.0);
}

TEST(TappedMeasurement, JudgesTheHeightsOfTheJumps) {
  const auto exact = measure(cycle(sample()), sample());
  ASSERT_TRUE(exact) << exact.error().message;
  EXPECT_EQ(exact->law, "tapping-dmt");
  EXPECT_LT(exact->worst_error(), 1e-12);
  EXPECT_TRUE(check_accuracy(*exact));
  // a hand at its largest speed shifts them by less
  EXPECT_TRUE(check_accuracy(measure(cycle(sample(), 0.4e-9), sample()).value()));
  EXPECT_FALSE(check_accuracy(measure(cycle(sample(), 0.6e-9), sample()).value()));
  servo::RecordedSession half = cycle(sample());
  half.events.pop_back();
  const auto none = measure(half, sample());
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("no jump to attraction"));
}

TEST(TappedMeasurement, IsWrittenWithItsConventions) {
  DemoResult result;
  result.measurements.push_back(measure(cycle(sample()), sample()).value());
  const nlohmann::json json = summary_json(result)["materials"]["mica"];
  EXPECT_EQ(json["law"], "tapping-dmt");
  EXPECT_EQ(json["conventions"]["amplitude"], "zero-to-peak");
  EXPECT_THAT(json["conventions"]["phase"].get<std::string>(), HasSubstr("90 degrees for a free lever"));
  ASSERT_EQ(json["jumps"].size(), 2U);
  EXPECT_EQ(json["jumps"][0]["branch"], "approach");
  EXPECT_NEAR(json["jumps"][1]["before"]["phase_deg"].get<double>(), kRepelled * 180.0 / std::numbers::pi, 1e-9);
  EXPECT_LT(json["loop_of_amplitude_reduction_m2"].get<double>(), 0.0);
  EXPECT_GT(json["work_on_hand_by_mean_force_J"].get<double>(), 0.0);
  EXPECT_GT(json["loop_energy_J"].get<double>(), 0.0);
  EXPECT_EQ(json["error_vs_calculation"]["z_to_repulsion"], 0.0);
  EXPECT_FALSE(json.contains("f_ad_N")) << "no force of adhesion was felt";
  const std::string html = report_html(result, {}, "<svg></svg>", test::english());
  EXPECT_THAT(html, HasSubstr("Z of the jumps, down / up"));
  EXPECT_THAT(html, HasSubstr("\u03c6 114.6\u00b0 \u2192 40.1\u00b0"));
  EXPECT_THAT(html, Not(HasSubstr("F_ad")));
}

TEST(TappedSessionCsv, HasTheSwingAndIsReadAsACurve) {
  const std::string csv = session_csv(cycle(sample()));
  EXPECT_THAT(csv, HasSubstr("# free_amplitude_m: 2e-08\n"));
  EXPECT_THAT(csv, HasSubstr("# convention of the amplitude: zero-to-peak\n"));
  EXPECT_THAT(csv, HasSubstr(",hand_force_N,amplitude_m,phase_deg,servo_state,"));
  EXPECT_THAT(csv, HasSubstr(",2.000000000e-08,114.5916,"));
  const auto curve = curves::parse_curve(csv, "curve-mica.csv");
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_NEAR(curve->points.front().z.si, kTop, 1e-15);
}

}  // namespace tapped_cycle_test
}  // namespace afm::exhibit
