// SPDX-License-Identifier: Apache-2.0
#include "app/curve_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace afm::app {
namespace {

using testing::HasSubstr;

CurveOptions options_for(const char* material) {
  CurveOptions options;
  options.materials_file = AFM_SOURCE_DIR "/assets/materials.toml";
  options.material = material;
  return options;
}

nlohmann::ordered_json json_of(const CurveOptions& options) {
  const auto run = run_curve(options);
  if (!run) {
    ADD_FAILURE() << run.error().message;
    return {};
  }
  return curve_json(*run);
}

std::string refusal(const CurveOptions& options) {
  const auto run = run_curve(options);
  if (run) return "accepted";
  EXPECT_EQ(run.error().category, core::ErrorCategory::WrongUsage);
  return run.error().message;
}

TEST(CurveJson, HoldsTheEventsSignedAndInSi) {
  const auto json = json_of(options_for("mica"));
  EXPECT_EQ(json["model"], "paper");
  EXPECT_EQ(json["parameters"]["tip_radius_m"], 5e-8);
  EXPECT_NEAR(json["snap_in"]["z_m"], 2.39752348708e-9, 1e-18);
  EXPECT_EQ(json["snap_in"]["force_before_N"], 0.0);
  EXPECT_NEAR(json["snap_in"]["force_after_N"], -2.39752348708e-10, 1e-19);
  EXPECT_NEAR(json["pull_off"]["z_m"], 1.39989368644e-8, 1e-17);
  EXPECT_NEAR(json["pull_off"]["force_N"], -1.39989368644e-9, 1e-18);
  EXPECT_NEAR(json["loop_energy_J"].get<double>() / 9.51110572311e-18, 1.0, 1e-9);
  EXPECT_TRUE(json["tabor_parameter"].is_null());
  EXPECT_TRUE(json["regime"].is_null());
}

TEST(CurveJson, LeavesOutWhatTheSweepDidNotReach) {
  CurveOptions options = options_for("gold");
  options.from = "20nm";
  const auto json = json_of(options);
  EXPECT_FALSE(json["snap_in"].is_null());
  EXPECT_TRUE(json["pull_off"].is_null());
  EXPECT_TRUE(json["loop_energy_J"].is_null());
}

TEST(CurveCsv, HasAHeaderWithEveryParameterAndEqualRows) {
  CurveOptions options = options_for("mica");
  options.step = "1nm";
  options.spring_constant = "0.2N/m";
  const auto run = run_curve(options);
  ASSERT_TRUE(run.has_value()) << run.error().message;
  std::istringstream csv(curve_csv(*run));
  std::string header;
  std::size_t rows = 0;
  for (std::string line; std::getline(csv, line);) {
    if (line.starts_with('#')) {
      header += line + "\n";
    } else {
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), 7) << line;
      ++rows;
    }
  }
  EXPECT_EQ(rows, run->curve.samples.size() + 1);
  for (const char* parameter : {"# tip_radius_m: 5e-08\n", "# spring_constant_N_per_m: 0.2\n",
                                "# sample_stiffness_N_per_m: inf\n", "# hamaker_J: 2.45e-20\n", "# model: paper\n",
                                "# source of spring_constant: 0.2N/m, --spring-constant on the command line\n"}) {
    EXPECT_THAT(header, HasSubstr(parameter));
  }
}

TEST(CurveCommand, OverridesTheMaterialsNumbers) {
  CurveOptions options = options_for("mica");
  options.work_of_adhesion = "8.912mJ/m2";
  options.sample_stiffness = "0.1N/m";
  const auto json = json_of(options);
  EXPECT_NEAR(json["pull_off"]["force_N"], 2 * -1.39989368644e-9, 1e-18);
  EXPECT_NEAR(json["snap_in"]["z_m"], 3.02069030899e-9, 1e-18);
}

TEST(CurveCommand, RefusesWhatCannotBe) {
  EXPECT_THAT(refusal(options_for("butter")), HasSubstr("known are mica, gold, si3n4"));
  CurveOptions options = options_for("mica");
  options.tip_radius = "50";
  EXPECT_THAT(refusal(options), HasSubstr("--tip-radius: cannot read \"50\" as a length"));
  options.tip_radius = "-50nm";
  EXPECT_THAT(refusal(options), HasSubstr("tip radius -50 nm is not within"));
  options = options_for("mica");
  options.step = "0.00001pm";
  EXPECT_THAT(refusal(options), HasSubstr("more than 10000000 samples"));
  options = options_for("mica");
  options.from = "1nm";
  EXPECT_THAT(refusal(options), HasSubstr("below jump-to-contact at 2.3975 nm"));
  options = options_for("mica");
  options.model = "jkr";
  EXPECT_THAT(refusal(options), HasSubstr("known are paper, paper-rule"));
}

TEST(CurveCommand, ShowsTheDirectionRuleForComparison) {
  CurveOptions options = options_for("mica");
  options.model = "paper-rule";
  options.step = "0.5nm";
  const auto json = json_of(options);
  // its jump lies at a sample, below the threshold
  EXPECT_LT(json["snap_in"]["z_m"], 2.39e-9);
}

}  // namespace
}  // namespace afm::app
