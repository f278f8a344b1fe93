// SPDX-License-Identifier: Apache-2.0
#include "curves/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/options/contact_options.h"
#include "physics/contact.h"
#include "support/places.h"

namespace afm::curves {
namespace sweep_test {

using testing::HasSubstr;

ContactSetup setup_of(const char* material, const char* model) {
  curves::ContactOptions options;
  options.assets_dir = support::source("assets");
  options.material = material;
  options.model = model;
  return curves::contact_setup(options).value();
}

SweepAxis axis(const std::string& text, const char* model = "dmt") {
  const auto parsed = parse_sweep_axis(text, ModelName::parse(model).value());
  EXPECT_TRUE(parsed.has_value()) << parsed.error().message;
  return parsed.value_or(SweepAxis{});
}

std::string refusal(const std::string& text, const char* model = "dmt") {
  const auto parsed = parse_sweep_axis(text, ModelName::parse(model).value());
  if (parsed) return "accepted";
  EXPECT_EQ(parsed.error().category, core::ErrorCategory::WrongUsage);
  return parsed.error().message;
}

TEST(SweepAxis, HoldsBothEndsExactly) {
  const SweepAxis linear = axis("tip-radius=10nm:100nm:10");
  EXPECT_EQ(linear.value(0), 10e-9);
  EXPECT_DOUBLE_EQ(linear.value(1), 20e-9);
  EXPECT_EQ(linear.value(9), 100e-9);
  const SweepAxis ratios = axis("spring-constant=0.01N/m:100N/m:5:log");
  EXPECT_EQ(ratios.value(0), 0.01);
  EXPECT_DOUBLE_EQ(ratios.value(2), 1.0);
  EXPECT_EQ(ratios.value(4), 100.0);
}

TEST(SweepAxis, RefusesWhatIsNone) {
  EXPECT_THAT(refusal("tip-radius"), HasSubstr("write key=from:to:count"));
  EXPECT_THAT(refusal("tip-radius=1nm:2nm"), HasSubstr("write key=from:to:count"));
  EXPECT_THAT(refusal("tip-radius=1nm:2nm:3:cubic"), HasSubstr("write key=from:to:count"));
  EXPECT_THAT(refusal("colour=1nm:2nm:3"), HasSubstr("\"colour\" is not a number of the model dmt; it has tip-radius"));
  EXPECT_THAT(refusal("resonance=1kHz:2kHz:3"), HasSubstr("is not a number of the model dmt"));
  EXPECT_THAT(refusal("tip-radius=1:2:3"), HasSubstr("it has no unit"));
  EXPECT_THAT(refusal("tip-radius=1nm:2nm:1"), HasSubstr("not a whole number from 2 to 1000000"));
  EXPECT_THAT(refusal("tip-radius=1nm:2nm:1e3"), HasSubstr("not a whole number"));
  EXPECT_THAT(refusal("tip-radius=1nm:2nm:1000000000"), HasSubstr("not a whole number from 2 to 1000000"));
  EXPECT_THAT(refusal("tip-radius=1nm:2nm:99999999999999999999"), HasSubstr("not a whole number"));
  EXPECT_THAT(refusal("tip-radius=-1nm:2nm:5:log"), HasSubstr("two positive ends"));
  EXPECT_THAT(refusal("sample-stiffness=1N/m:inf N/m:5"), HasSubstr("must be finite"));
}

TEST(Sweep, GivesTheClosedFormsOfThePaperAtEveryPoint) {
  const ContactSetup setup = setup_of("mica", "paper");
  const auto rows = run_sweep(setup, {axis("tip-radius=10nm:100nm:91", "paper")}, {});
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  ASSERT_EQ(rows->size(), 91U);
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const SweepRow& row = (*rows)[i];
    physics::ContactParameters contact = setup.material.contact;
    contact.tip_radius = physics::Length(row.at[0]);
    const auto events = physics::approach_retract_events(contact);
    EXPECT_NEAR(row.at[0], (10.0 + static_cast<double>(i)) * 1e-9, 1e-18);
    EXPECT_NEAR(row.snap_in_z_m / events.z_jtc.si, 1.0, 1e-12);
    EXPECT_NEAR(row.pull_off_force_n / -events.f_ad.si, 1.0, 1e-12);
  }
}

TEST(Sweep, SeesHysteresisVanishAtTheCriticalStiffness) {
  const auto rows = run_sweep(setup_of("mica", "dmt"), {axis("spring-constant=5N/m:10N/m:51")}, {});
  ASSERT_TRUE(rows.has_value());
  for (const SweepRow& row : *rows) {
    EXPECT_NEAR(row.critical_stiffness_n_per_m, 7.33, 0.01);
    const bool jumps = row.at[0] < row.critical_stiffness_n_per_m;
    EXPECT_EQ(std::isnan(row.snap_in_z_m), !jumps) << row.at[0];
    EXPECT_EQ(row.loop_energy_j > 0.0, jumps) << row.at[0];
  }
}

TEST(Sweep, RunsTheGridWithTheLastAxisFastest) {
  const auto rows =
      run_sweep(setup_of("mica", "auto"),
                {axis("reduced-modulus=1MPa:100GPa:3:log", "auto"), axis("tip-radius=20nm:50nm:2", "auto")}, {});
  ASSERT_TRUE(rows.has_value());
  ASSERT_EQ(rows->size(), 6U);
  EXPECT_EQ((*rows)[0].at[0], 1e6);
  EXPECT_EQ((*rows)[0].at[1], 20e-9);
  EXPECT_EQ((*rows)[1].at[1], 50e-9);
  EXPECT_EQ((*rows)[5].at[0], 1e11);
  EXPECT_EQ((*rows)[0].model, "jkr");
  EXPECT_EQ((*rows)[5].model, "dmt");
  EXPECT_GT((*rows)[0].tabor, (*rows)[5].tabor);
}

TEST(Sweep, SaysWhichPointsHaveNoCurve) {
  const ContactSetup setup = setup_of("mica", "paper");
  const auto rows = run_sweep(setup, {axis("work-of-adhesion=0.01mJ/m2:4mJ/m2:5", "paper")}, {});
  ASSERT_TRUE(rows.has_value());
  EXPECT_FALSE(rows->front().refusal.empty());
  EXPECT_TRUE(std::isnan(rows->front().snap_in_z_m));
  EXPECT_TRUE(rows->back().refusal.empty());

  const auto none = run_sweep(setup, {axis("tip-radius=-5nm:-1nm:5", "paper")}, {});
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(none.error().message, HasSubstr("no point of the sweep has a curve; the first: tip radius -5 nm"));
}

TEST(Sweep, RefusesAGridThatIsTooLarge) {
  const auto rows =
      run_sweep(setup_of("mica", "dmt"), {axis("tip-radius=1nm:9nm:100000"), axis("hamaker=1zJ:9zJ:100000")}, {});
  ASSERT_FALSE(rows.has_value());
  EXPECT_THAT(rows.error().message, HasSubstr("10000000000 points; at most 1000000"));
}

TEST(SweepTable, HasAColumnForEveryNumberAndALineForEveryPoint) {
  const ContactSetup setup = setup_of("gold", "auto");
  const std::vector<SweepAxis> axes{axis("spring-constant=0.1N/m:0.4N/m:4", "auto")};
  const auto rows = run_sweep(setup, axes, {}).value();
  std::istringstream csv(sweep_csv(setup, axes, rows));
  std::size_t lines = 0;
  std::string header, names;
  for (std::string line; std::getline(csv, line);) {
    if (line.starts_with('#')) {
      header += line + "\n";
      continue;
    }
    if (lines++ == 0) names = line;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(names.begin(), names.end(), ',')) << line;
  }
  EXPECT_EQ(lines, 5U);
  EXPECT_TRUE(names.starts_with("spring_constant_N_per_m,model,regime,tabor_parameter"));
  EXPECT_TRUE(header.starts_with("# TouchAFM sweep\n# software: TouchAFM ")) << header;
  EXPECT_THAT(header, HasSubstr("source of hamaker"));
  EXPECT_THAT(header, HasSubstr("# swept: spring_constant_N_per_m from 0.1 to 0.4, 4 values\n"));
  EXPECT_THAT(header, testing::Not(HasSubstr("source of spring_constant")));

  const auto json = sweep_json(setup, axes, rows);
  ASSERT_EQ(json["points"].size(), 4U);
  EXPECT_EQ(json["points"][3]["spring_constant_N_per_m"], 0.4);
  EXPECT_FALSE(json["parameters"].contains("spring_constant_N_per_m"));
  EXPECT_FALSE(json["sources"].contains("spring_constant"));
  EXPECT_FALSE(json["sources"]["hamaker"]["source"].get<std::string>().empty());
}

}  // namespace sweep_test
}  // namespace afm::curves
