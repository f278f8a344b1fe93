// SPDX-License-Identifier: Apache-2.0
#include "app/tapping/tapping_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/places.h"

namespace afm::app {
namespace tapping_command_test {

using testing::HasSubstr;

curves::ContactOptions tapped(const char* model = "dmt") {
  curves::ContactOptions options;
  options.assets_dir = support::source("assets");
  options.model = model;
  options.values["tip-radius"] = "20nm";
  options.values["spring-constant"] = "40N/m";
  options.values["hamaker"] = "64zJ";
  options.values["reduced-modulus"] = "1.5GPa";
  options.values["resonance"] = "300kHz";
  options.values["quality-factor"] = "400";
  return options;
}

curves::TappingChoice tapping() {
  curves::TappingChoice choice;
  choice.mode = "tapping";
  choice.numbers.free_amplitude = "20nm";
  choice.contact_gap = "0.165nm";
  return choice;
}

TEST(TappedModels, AreTheLawsWhoseSwingsCanBeAveraged) {
  EXPECT_EQ(curves::known_models(curves::ModelUse::Tapped), "auto, hertz, dmt, jkr, maugis");
  for (const char* model : {"paper-rule", "hao"}) {
    const auto refused = tapping_text(tapping(), tapped(model), {}, "json");
    ASSERT_FALSE(refused) << model;
    EXPECT_THAT(refused.error().message, HasSubstr("choose auto, hertz, dmt, jkr, maugis")) << model;
  }
}

nlohmann::json json_of(const curves::TappingChoice& choice, const curves::ContactOptions& contact = tapped()) {
  const auto text = tapping_text(choice, contact, {}, "json");
  return text ? nlohmann::json::parse(*text) : nlohmann::json(text.error().message);
}

std::string refusal(const curves::TappingChoice& choice, const curves::ContactOptions& contact = tapped(),
                    const curves::PathOptions& path = {}, const std::string& format = "csv") {
  if (const auto checked = check_tapping_options(choice); !checked) return checked.error().message;
  const auto text = tapping_text(choice, contact, path, format);
  return text ? "accepted" : text.error().message;
}

TEST(TappingCommand, PrintsJumpsLoopsAndConventions) {
  const auto json = json_of(tapping());
  EXPECT_EQ(json["conventions"]["amplitude"], "zero-to-peak");
  EXPECT_THAT(json["conventions"]["phase"].get<std::string>(), HasSubstr("lag"));
  // row T05 of the cases
  EXPECT_NEAR(json["drive"]["base_amplitude_m"].get<double>(), 5e-11, 5e-20);
  EXPECT_NEAR(json["drive"]["force_N"].get<double>(), 2e-9, 2e-18);
  EXPECT_NEAR(json["drive"]["free_air_loss_W"].get<double>(), 3.769911184e-11, 3.8e-20);
  EXPECT_NEAR(json["parameters"]["work_of_adhesion_J_per_m2"].get<double>(), 0.0623564, 1e-6);
  ASSERT_EQ(json["jumps"].size(), 2u);
  EXPECT_NEAR(json["jumps"][0]["z_m"].get<double>(), 16.568e-9, 0.05e-9);
  EXPECT_NEAR(json["jumps"][1]["z_m"].get<double>(), 18.826e-9, 0.05e-9);
  EXPECT_GT(json["work_on_hand_by_mean_force_J"].get<double>(), 0.0);
  EXPECT_LT(json["loop_of_amplitude_reduction_m2"].get<double>(), 0.0);
}

TEST(TappingCommand, PrintsEveryStateAtAHeight) {
  curves::TappingChoice choice = tapping();
  choice.numbers.at = "17.4149nm";
  const auto json = json_of(choice);
  ASSERT_EQ(json["states"].size(), 3u);
  EXPECT_EQ(json["states"][1]["stable"], false);
  EXPECT_EQ(json["states"][1]["found_by"], "averaging");
}

// A soft lever over a stiff contact that adheres.
TEST(TappingCommand, CompletesTheStatesByDirectIntegrationUnlessAskedToAverage) {
  curves::ContactOptions contact = tapped();
  contact.values["spring-constant"] = "0.858385N/m";
  contact.values["tip-radius"] = "48.3545nm";
  contact.values["hamaker"] = "18.9712zJ";
  contact.values["reduced-modulus"] = "91.647GPa";
  contact.values["quality-factor"] = "273.88495";
  curves::TappingChoice choice = tapping();
  choice.numbers.free_amplitude = "9.374816nm";
  choice.numbers.at = "7.711918nm";
  const auto states = json_of(choice, contact)["states"];
  ASSERT_EQ(states.size(), 2u) << states;
  EXPECT_EQ(states[0]["found_by"], "averaging");
  EXPECT_EQ(states[1]["found_by"], "direct integration");
  EXPECT_EQ(states[1]["state"], "repulsive");
  EXPECT_NEAR(states[1]["amplitude_m"].get<double>(), 7.52454e-9, 1e-12);
  EXPECT_GT(states[1]["harmonics_m"].size(), 3u);
  choice.numbers.method = "averaged";
  EXPECT_EQ(json_of(choice, contact)["states"].size(), 1u);
}

nlohmann::json swept(const std::vector<std::string>& sweeps, const curves::ContactOptions& contact = tapped()) {
  const auto text = tapping_sweep_text(tapping(), contact, sweeps, "json");
  return text ? nlohmann::json::parse(*text)["points"] : nlohmann::json(text.error().message);
}

void expect_state(const nlohmann::json& point, const std::string& state, double amplitude_nm, double phase_deg,
                  double tolerance = 1e-3) {
  EXPECT_NEAR(point[state + "_amplitude_m"].get<double>() * 1e9, amplitude_nm, tolerance * amplitude_nm) << point;
  EXPECT_NEAR(point[state + "_phase_deg"].get<double>(), phase_deg, 0.2) << point;
}

// Rows T42 and T45 of the cases.
// A contact far stiffer than the lever, without adhesion: averages gave 207 jumps that direct integration has not
TEST(TappingCommand, IntegratesDirectlyWhereNoAveragesFollowTheSwing) {
  curves::ContactOptions contact;
  contact.assets_dir = support::source("assets");
  contact.material = "gold";
  contact.model = "hertz";
  contact.values = {{"spring-constant", "0.278N/m"}, {"resonance", "75kHz"}, {"quality-factor", "120"}};
  curves::TappingChoice choice;
  choice.mode = "tapping";
  choice.numbers.free_amplitude = "3.24nm";
  const curves::PathOptions path{.from = "3.4nm", .to = "2nm", .step = "0.1nm"};
  const auto curve = nlohmann::json::parse(tapping_text(choice, contact, path, "json").value());
  EXPECT_EQ(curve["method"], "direct");
  EXPECT_NEAR(curve["averages_lost_at_m"].get<double>(), 3.25e-9, 0.02e-9);
  EXPECT_TRUE(curve["jumps"].empty()) << curve["jumps"];
  choice.numbers.method = "averaged";
  EXPECT_THAT(refusal(choice, contact, path), HasSubstr("no averages follow the swing at 3.2"));
}

// Pressed into the sample, Newton's method went on by 1e-15 m at a time, without an end
TEST(TappingCommand, GivesUpAveragesThatAreFollowedInTooSmallSteps) {
  curves::ContactOptions contact;
  contact.assets_dir = support::source("assets");
  contact.material = "mica";
  contact.model = "dmt";
  contact.values = {{"spring-constant", "40N/m"}, {"resonance", "300kHz"}, {"quality-factor", "400"}};
  curves::TappingChoice choice;
  choice.mode = "tapping";
  choice.numbers.free_amplitude = "20nm";
  choice.numbers.method = "averaged";
  const curves::PathOptions path{.from = "2.2e-08 m", .to = "-2e-08 m", .step = "2.2105263157894737e-09 m"};
  EXPECT_THAT(refusal(choice, contact, path), HasSubstr("no averages follow the swing at "));
}

// A drive 6 % above the resonance, and a tip that sticks: no state for which a name would be true
TEST(TappingCommand, NamesTheHeightsAtWhichTheSwingDoesNotRepeat) {
  curves::ContactOptions contact = tapped("jkr");
  contact.values = {{"tip-radius", "50nm"},    {"spring-constant", "0.872N/m"}, {"reduced-modulus", "80GPa"},
                    {"resonance", "12.97kHz"}, {"quality-factor", "403.5"},     {"work-of-adhesion", "58.5mJ/m2"}};
  curves::TappingChoice choice = tapping();
  choice.contact_gap.clear();
  choice.numbers.free_amplitude = "95.4nm";
  choice.numbers.drive = "13.75kHz";
  const curves::PathOptions path{.from = "96nm", .to = "76nm", .step = "4nm"};
  const auto json = nlohmann::json::parse(tapping_text(choice, contact, path, "json").value());
  EXPECT_EQ(json["method"], "direct");
  ASSERT_FALSE(json["restless"].empty());
  EXPECT_EQ(json["restless"][0]["branch"], "approach");
  EXPECT_GE(json["restless"][0]["from_z_m"], json["restless"][0]["to_z_m"]);
  EXPECT_TRUE(json["jumps"].empty()) << json["jumps"];
  EXPECT_THAT(json["conventions"]["energy_lost"].get<std::string>(), HasSubstr("1e-4 k A0^2"));
  EXPECT_THAT(tapping_text(choice, contact, path, "csv").value(), HasSubstr(",approach,restless\n"));
  EXPECT_TRUE(json_of(tapping())["restless"].empty());
}

TEST(TappingSweep, MapsTheStatesOverFreeAmplitudeAndHeight) {
  const auto points = swept({"free-amplitude=10nm:20nm:2", "z=5nm:17.4149nm:2"});
  ASSERT_EQ(points.size(), 4U) << points;
  EXPECT_EQ(points[0]["regime"], "both");
  expect_state(points[0], "attractive", 4.819, 151.19);
  expect_state(points[0], "repulsive", 6.345, 39.38, 4e-3);  // the case has the mean deflection without harmonics
  EXPECT_EQ(points[1]["regime"], "attractive") << "out of reach of the sample";
  EXPECT_NEAR(points[1]["attractive_amplitude_m"].get<double>(), 10e-9, 1e-12);
  EXPECT_TRUE(points[1]["repulsive_amplitude_m"].is_null());
  EXPECT_EQ(points[3]["regime"], "both");
  EXPECT_DOUBLE_EQ(points[3]["z_m"].get<double>(), 17.4149e-9);
  expect_state(points[3], "attractive", 17.4935, 118.99);
  expect_state(points[3], "repulsive", 18.8572, 70.54);
}

// Without attraction the free swing has no virial at all.
TEST(TappingSweep, CallsTheFreeSwingOfAnElasticContactFree) {
  auto elastic = tapped("hertz");
  elastic.values.erase("hamaker");
  curves::TappingChoice choice = tapping();
  choice.contact_gap.clear();
  const auto text = tapping_sweep_text(choice, elastic, {"z=17nm:25nm:2"}, "json");
  ASSERT_TRUE(text) << text.error().message;
  const auto points = nlohmann::json::parse(*text)["points"];
  EXPECT_EQ(points[0]["regime"], "repulsive");
  EXPECT_EQ(points[1]["regime"], "attractive") << "or free: above the sample";
  EXPECT_NEAR(points[1]["attractive_amplitude_m"].get<double>(), 20e-9, 1e-12);
  EXPECT_TRUE(points[1]["repulsive_amplitude_m"].is_null());
}

// Rows T43 and T45 of the cases: the same numbers as those of a single curve.
TEST(TappingSweep, FindsTheJumpsOfEachCurve) {
  const auto points = swept({"free-amplitude=10nm:20nm:2"});
  ASSERT_EQ(points.size(), 2U) << points;
  EXPECT_EQ(points[0]["regime"], "attractive");
  EXPECT_TRUE(points[0]["jump_in_z_m"].is_null());
  EXPECT_GE(points[0]["islands"], 1);
  EXPECT_EQ(points[1]["regime"], "hysteresis");
  const auto curve = json_of(tapping());
  EXPECT_EQ(points[1]["jump_in_z_m"], curve["jumps"][0]["z_m"]);
  EXPECT_EQ(points[1]["jump_off_z_m"], curve["jumps"][1]["z_m"]);
  EXPECT_EQ(points[1]["hysteresis_width_m"], curve["hysteresis_width_m"]);
  const auto near = [&](const char* key, double nm) {
    EXPECT_NEAR(points[1][key].get<double>() * 1e9, nm, 3e-3 * nm) << key;
  };
  near("jump_in_z_m", 16.568);
  near("jump_off_z_m", 18.826);
  near("amplitude_before_jump_in_m", 16.9);
  near("amplitude_after_jump_in_m", 18.07);
  near("amplitude_before_jump_off_m", 20.0);
  near("amplitude_after_jump_off_m", 18.72);
}

TEST(TappingSweep, KeepsTheContactGapWhereTheAttractionIsSwept) {
  auto weak = tapped();
  weak.values["hamaker"] = "32zJ";
  const auto text = tapping_text(tapping(), weak, {}, "json");
  ASSERT_TRUE(text);
  const auto points = swept({"hamaker=32zJ:64zJ:2"});
  ASSERT_EQ(points.size(), 2U) << points;
  EXPECT_NEAR(points[0]["jump_in_z_m"].get<double>(), nlohmann::json::parse(*text)["jumps"][0]["z_m"].get<double>(),
              1e-15);
}

TEST(TappingSweep, SaysWhyAPointHasNoSwing) {
  const auto points = swept({"quality-factor=50:400:2"});
  ASSERT_EQ(points.size(), 2U) << points;
  EXPECT_THAT(points[0]["refusal"].get<std::string>(),
              HasSubstr("quality factor of at least 100, not 50; take direct, or in place of a sweep"));
  EXPECT_TRUE(points[0]["regime"].is_null());
  EXPECT_EQ(points[1]["regime"], "hysteresis");
}

TEST(TappingSweep, IsDrawnAndPrinted) {
  const std::vector<std::string> grid{"free-amplitude=10nm:20nm:2", "z=5nm:17.4149nm:2"};
  const auto csv = tapping_sweep_text(tapping(), tapped(), grid, "csv");
  ASSERT_TRUE(csv);
  EXPECT_THAT(*csv, HasSubstr("free_amplitude_m,z_m,regime,attractive_amplitude_m,"));
  EXPECT_THAT(*csv, HasSubstr("\n1e-08,5e-09,both,"));
  EXPECT_THAT(*csv, HasSubstr("# phase: lag of the tip"));
  EXPECT_THAT(*csv, HasSubstr("# regime both: "));
  for (const auto& sweeps : {grid, std::vector<std::string>{"free-amplitude=10nm:20nm:2"}}) {
    const auto svg = tapping_sweep_text(tapping(), tapped(), sweeps, "svg");
    ASSERT_TRUE(svg);
    EXPECT_THAT(*svg, HasSubstr("free amplitude (nm)"));
  }
}

TEST(TappingSweep, RefusesWithTheReason) {
  EXPECT_THAT(swept({"colour=1nm:2nm:3"}).get<std::string>(), HasSubstr("it has free-amplitude, z, tip-radius"));
  EXPECT_THAT(swept({"z=1nm:2nm:3", "z=1nm:2nm:3"}).get<std::string>(),
              HasSubstr("z: this parameter is swept already"));
  EXPECT_THAT(swept({"z=1nm:2nm:9999", "free-amplitude=9nm:20nm:9999"}).get<std::string>(),
              HasSubstr("at most 1000000"));
  curves::TappingChoice direct = tapping();
  direct.numbers.method = "direct";
  const auto refused = tapping_sweep_text(direct, tapped(), {"z=1nm:2nm:3"}, "csv");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("--method direct has no effect with --sweep"));
}

TEST(TappingCommand, RefusesOptionsWithoutEffect) {
  curves::TappingChoice contact;
  contact.numbers.free_amplitude = "20nm";
  EXPECT_THAT(refusal(contact), HasSubstr("--free-amplitude has no effect on --mode contact"));
  curves::TappingChoice fm = tapping();
  fm.mode = "fm";
  EXPECT_THAT(
      refusal(fm),
      HasSubstr("--free-amplitude has no effect on --mode fm; give --amplitude instead, or take --mode tapping"));
  EXPECT_THAT(refusal(tapping(), tapped(), {.seed = "3"}), HasSubstr("--seed has no effect"));
  EXPECT_THAT(refusal(tapping(), tapped(), {}, "h5"), HasSubstr("csv, json or svg"));
}

TEST(TappingCommand, RefusesLawsThatGiveNoForceOfAHeight) {
  for (const char* model : {"paper", "paper-rule", "hao", "measured"}) {
    EXPECT_THAT(refusal(tapping(), tapped(model)), HasSubstr("does not give; choose")) << model;
  }
  EXPECT_THAT(refusal(tapping(), tapped("dynamic-dmt")), HasSubstr("write --model dmt"));
}

TEST(TappingCommand, RefusesUnphysicalNumbersWithTheirRange) {
  curves::TappingChoice choice = tapping();
  choice.numbers.free_amplitude = "1m";
  EXPECT_EQ(refusal(choice), "free amplitude 1 m is not within 10 pm to 10 um");
  choice = tapping();
  choice.numbers.drive = "1MHz";
  EXPECT_EQ(refusal(choice), "drive 1 MHz is not within 150 kHz to 450 kHz");
  choice = tapping();
  choice.contact_gap = "1m";
  EXPECT_THAT(refusal(choice), HasSubstr("not within 10 pm to 5 nm"));
}

}  // namespace tapping_command_test
}  // namespace afm::app
