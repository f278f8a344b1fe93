// SPDX-License-Identifier: Apache-2.0
#include "app/commands/curve_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "curves/curve_output.h"
#include "physics/law.h"
#include "support/places.h"

namespace afm::app {
namespace curve_command_test {

using testing::HasSubstr;
using testing::Not;

curves::ContactOptions contact_of(const char* material, const char* model) {
  curves::ContactOptions options;
  options.assets_dir = support::source("assets");
  options.material = material;
  options.model = model;
  return options;
}

core::Result<curves::CurveRun> run_of(const curves::ContactOptions& contact, const curves::PathOptions& path = {}) {
  const auto setup = contact_setup(contact);
  if (!setup) return tl::unexpected(setup.error());
  return curves::run_curve(*setup, path);
}

nlohmann::ordered_json json_of(const curves::ContactOptions& contact, const curves::PathOptions& path = {}) {
  const auto run = run_of(contact, path);
  if (!run) {
    ADD_FAILURE() << run.error().message;
    return {};
  }
  return curves::curve_json(*run);
}

std::string refusal(const curves::ContactOptions& contact, const curves::PathOptions& path = {}) {
  const auto run = run_of(contact, path);
  if (run) return "accepted";
  EXPECT_EQ(run.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_EQ(run.error().message.find('\n'), std::string::npos);
  return run.error().message;
}

// R = 50 nm, W = 50 mJ/m2, E* = 1 GPa: the contact of the JKR cases in docs/physics.md.
curves::ContactOptions soft_contact(const char* model) {
  curves::ContactOptions options = contact_of("", model);
  options.values["tip-radius"] = "50nm";
  options.values["spring-constant"] = "0.1N/m";
  options.values["work-of-adhesion"] = "50mJ/m2";
  options.values["reduced-modulus"] = "1GPa";
  return options;
}

TEST(CurveJson, HoldsTheEventsSignedAndInSi) {
  const auto json = json_of(contact_of("mica", "paper"));
  EXPECT_EQ(json["model"], "paper");
  EXPECT_EQ(json["parameters"]["tip_radius_m"], 5e-8);
  EXPECT_NEAR(json["snap_in"]["z_m"], 2.39752348708e-9, 1e-18);
  EXPECT_EQ(json["snap_in"]["force_before_N"], 0.0);
  EXPECT_NEAR(json["snap_in"]["force_after_N"], -2.39752348708e-10, 1e-19);
  EXPECT_NEAR(json["pull_off"]["z_m"], 1.39989368644e-8, 1e-17);
  EXPECT_NEAR(json["pull_off"]["force_N"], -1.39989368644e-9, 1e-18);
  EXPECT_NEAR(json["loop_energy_J"].get<double>() / 9.51110572311e-18, 1.0, 1e-9);
  EXPECT_NEAR(json["tabor_parameter"].get<double>(), 0.0240, 1e-4);
  EXPECT_TRUE(json["parameters"]["sample_stiffness_N_per_m"].is_null());
  EXPECT_TRUE(json["critical_stiffness_N_per_m"].is_null());
}

TEST(CurveJson, ChoosesTheLawByTheTaborParameterAndSaysWhy) {
  const auto mica = json_of(contact_of("mica", "auto"));
  EXPECT_EQ(mica["model"], "dmt");
  EXPECT_EQ(mica["model_requested"], "auto");
  EXPECT_THAT(mica["law_because"].get<std::string>(), HasSubstr("Tabor parameter"));
  EXPECT_NEAR(mica["snap_in"]["z_m"].get<double>(), 2.39752348708e-9, 1e-15);
  EXPECT_NEAR(mica["snap_in"]["force_before_N"].get<double>(), -7.9917e-11, 1e-14);
  EXPECT_NEAR(mica["snap_in"]["force_after_N"].get<double>(), -2.0339e-10, 1e-14);
  EXPECT_NEAR(mica["critical_stiffness_N_per_m"].get<double>(), 7.33, 0.01);
  EXPECT_EQ(json_of(contact_of("polystyrene-air", "auto"))["model"], "maugis");
  EXPECT_EQ(json_of(contact_of("pdms-air", "auto"))["model"], "jkr");
  EXPECT_EQ(json_of(contact_of("pdms-air", "auto"))["regime"], "jkr");
}

TEST(CurveJson, NamesSourcesAndEstimatesOfTheNumbersThatAct) {
  const auto dmt = json_of(contact_of("mica", "dmt"));
  EXPECT_EQ(dmt["sources"]["hamaker"]["value"], "24.5 zJ");
  EXPECT_EQ(dmt["sources"]["hamaker"]["estimated"], false);
  EXPECT_EQ(dmt["sources"]["sample_modulus"]["estimated"], true);
  const auto& estimated = dmt["estimated"];
  EXPECT_NE(std::find(estimated.begin(), estimated.end(), "atomic_distance"), estimated.end());
  EXPECT_FALSE(dmt["sources"].contains("resonance"));
  EXPECT_FALSE(json_of(contact_of("mica", "jkr"))["sources"].contains("hamaker"));
}

// The curve would have more samples than a file may hold, but the events need none of them.
TEST(CurveJson, NeedsNoSamples) {
  const auto json = json_of(contact_of("mica", "paper"), {.from = "1mm", .step = "1pm", .events_only = true});
  EXPECT_NEAR(json["pull_off"]["force_N"], -1.39989368644e-9, 1e-18);
}

TEST(CurvePath, PressesASoftStickySampleByDefault) {
  const auto run = run_of(contact_of("pdms-air", "auto"), {});
  ASSERT_TRUE(run.has_value()) << run.error().message;
  const auto deepest = std::min_element(run->curve.samples.begin(), run->curve.samples.end(),
                                        [](const auto& a, const auto& b) { return a.z < b.z; });
  EXPECT_GT(deepest->force.si, 0.0);
  EXPECT_LT(run->curve.samples.size(), 50'000U);
  EXPECT_EQ(run_of(contact_of("mica", "paper"), {})->plan.to.si, -5e-9);
  EXPECT_EQ(run_of(contact_of("mica", "paper"), {})->plan.step.si, 1e-11);
}

TEST(CurvePath, SeedsTheNoiseOfDynamicModelsAlone) {
  const auto forces = [](const std::string& seed) {
    std::vector<double> result;
    const auto run = run_of(contact_of("mica", "dynamic-dmt"), {.step = "1nm", .speed = "1mm/s", .seed = seed});
    if (run) {
      for (const auto& sample : run->curve.samples) result.push_back(sample.force.si);
    }
    return result;
  };
  EXPECT_FALSE(forces("7").empty());
  EXPECT_EQ(forces("7"), forces("7"));
  EXPECT_NE(forces("7"), forces("8"));
  EXPECT_TRUE(forces("seven").empty());
  EXPECT_FALSE(run_of(contact_of("mica", "dmt"), {.seed = "7"}).has_value());
}

TEST(CurveJson, LeavesOutWhatTheSweepDidNotReach) {
  const auto json = json_of(contact_of("gold", "paper"), {.from = "20nm"});
  EXPECT_FALSE(json["snap_in"].is_null());
  EXPECT_TRUE(json["pull_off"].is_null());
  EXPECT_TRUE(json["loop_energy_J"].is_null());
}

TEST(CurveJson, HasNoJumpsWhereTheLeverIsTooStiff) {
  curves::ContactOptions contact = contact_of("mica", "dmt");
  contact.values["spring-constant"] = "10N/m";
  const auto json = json_of(contact);
  EXPECT_TRUE(json["snap_in"].is_null());
  EXPECT_TRUE(json["pull_off"].is_null());
  EXPECT_EQ(json["loop_energy_J"], 0.0);
}

TEST(CurveCsv, HasAHeaderWithEveryParameterAndEqualRows) {
  curves::ContactOptions contact = contact_of("mica", "paper");
  contact.values["spring-constant"] = "0.2N/m";
  const auto run = run_of(contact, {.step = "1nm"});
  ASSERT_TRUE(run.has_value()) << run.error().message;
  std::istringstream csv(curves::curve_csv(*run));
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
  for (const char* parameter :
       {"# tip_radius_m: 5e-08\n", "# spring_constant_N_per_m: 0.2\n", "# sample_stiffness_N_per_m: inf\n",
        "# hamaker_J: 2.45e-20\n", "# model: paper\n",
        "# source of spring_constant: 0.2N/m, --spring-constant on the command line\n",
        "# source of sample_modulus: 60 GPa, muscovite across its layers, typical (estimated)\n"}) {
    EXPECT_THAT(header, HasSubstr(parameter));
  }
  EXPECT_THAT(header, Not(HasSubstr("experiment")));
  EXPECT_THAT(header, Not(HasSubstr("temperature")));
}

TEST(CurveCommand, OverridesTheMaterialsNumbers) {
  curves::ContactOptions contact = contact_of("mica", "paper");
  contact.values["work-of-adhesion"] = "8.912mJ/m2";
  contact.values["sample-stiffness"] = "0.1N/m";
  const auto json = json_of(contact);
  EXPECT_NEAR(json["pull_off"]["force_N"], 2 * -1.39989368644e-9, 1e-18);
  EXPECT_NEAR(json["snap_in"]["z_m"], 3.02069030899e-9, 1e-18);
}

TEST(CurveCommand, PutsAProbeUnderTheMaterialAndOverridesOnTop) {
  curves::ContactOptions contact = contact_of("mica-air", "auto");
  contact.probe = "ppp-contr";
  auto json = json_of(contact);
  EXPECT_EQ(json["parameters"]["tip_radius_m"], 7e-9);
  EXPECT_EQ(json["parameters"]["spring_constant_N_per_m"], 0.2);
  contact.values["spring-constant"] = "0.3N/m";
  json = json_of(contact);
  EXPECT_EQ(json["parameters"]["spring_constant_N_per_m"], 0.3);
  contact.probe = "tweezers";
  EXPECT_THAT(refusal(contact), HasSubstr("unknown probe \"tweezers\"; choose mlct-c"));
}

TEST(CurveCommand, NeedsNoMaterialWhereEveryNumberIsGiven) {
  const auto json = json_of(soft_contact("jkr"));
  const double unit = std::numbers::pi * 0.05 * 5e-8;
  EXPECT_NEAR(json["pull_off"]["force_N"].get<double>() / unit, -1.49997, 2e-5);
  EXPECT_EQ(json["parameters"]["material"], "none");

  curves::ContactOptions missing = soft_contact("auto");
  EXPECT_EQ(refusal(missing),
            "model auto without --material also needs --hamaker; a material supplies them: --material gold");
  missing.values["tip-radius"] = "";
  EXPECT_EQ(
      refusal(missing),
      "model auto without --material also needs --tip-radius, --hamaker; a material supplies them: --material gold");
}

TEST(CurveCommand, KnowsEveryModel) {
  std::vector<std::string> models{"paper-rule"};
  for (const physics::Law law : physics::laws_with(&physics::LawTraits::computed)) models.emplace_back(name_of(law));
  for (const std::string& model : models) {
    const auto json = json_of(contact_of("gold-air", model.c_str()), {.step = "1nm"});
    EXPECT_EQ(json["model"], model);
    EXPECT_EQ(json["model_requested"], model);
  }
  EXPECT_THAT(refusal(contact_of("mica", "magic")), HasSubstr("unknown model \"magic\"; choose auto, paper"));
  EXPECT_THAT(refusal(contact_of("mica", "dynamic-paper")), HasSubstr("choose auto"));
  EXPECT_THAT(refusal(contact_of("mica", "measured")), HasSubstr("choose auto"));
}

TEST(CurveCommand, MovesAMassWithTheDynamicModels) {
  curves::ContactOptions contact = contact_of("mica", "dynamic-dmt");
  contact.values["temperature"] = "0K";
  const auto json = json_of(contact, {.step = "0.1nm", .speed = "1um/s"});
  EXPECT_EQ(json["model"], "dynamic-dmt");
  EXPECT_EQ(json["parameters"]["resonance_Hz"], 12e3);
  EXPECT_EQ(json["parameters"]["temperature_K"], 0.0);
  EXPECT_EQ(json["parameters"]["speed_m_per_s"], 1e-6);
  EXPECT_GE(json["slow_motion"].get<double>(), 1.0);
  // a real ramp overshoots the fold, by less than 0.2 nm here
  EXPECT_NEAR(json["snap_in"]["z_m"].get<double>(), 2.3975e-9, 0.2e-9);
  EXPECT_NEAR(json["pull_off"]["force_N"].get<double>(), -1.4e-9, 0.05e-9);
}

TEST(CurveCommand, RefusesANumberThatDoesNotAct) {
  const auto with = [](const char* model, const char* option, const char* value) {
    curves::ContactOptions contact = contact_of("mica", model);
    contact.values[option] = value;
    return contact;
  };
  EXPECT_EQ(refusal(with("jkr", "hamaker", "10zJ")), "--hamaker has no effect on model jkr; remove it");
  EXPECT_THAT(refusal(with("dmt", "quality-factor", "3")), HasSubstr("--quality-factor has no effect"));
  EXPECT_THAT(refusal(with("paper", "humidity", "40%")), HasSubstr("--humidity has no effect"));
  EXPECT_THAT(refusal(contact_of("mica", "dmt"), {.speed = "1um/s"}), HasSubstr("--speed has no effect"));
  curves::ContactOptions exact = contact_of("mica", "jkr");
  exact.exact_sphere = true;
  EXPECT_THAT(refusal(exact), HasSubstr("--exact-sphere has no effect"));
}

TEST(CurveCommand, RefusesWhatCannotBe) {
  EXPECT_THAT(refusal(contact_of("butter", "auto")), HasSubstr("choose mica, gold, si3n4"));
  const auto with = [](const char* option, const char* value) {
    curves::ContactOptions contact = contact_of("mica", "dmt");
    contact.values[option] = value;
    return contact;
  };
  EXPECT_THAT(refusal(with("tip-radius", "50")), HasSubstr("--tip-radius: cannot read \"50\" as a length"));
  EXPECT_THAT(refusal(with("tip-radius", "-50nm")), HasSubstr("tip radius -50 nm is not within"));
  EXPECT_THAT(refusal(with("spring-constant", "0N/m")), HasSubstr("spring constant 0 N/m is not within"));
  EXPECT_THAT(refusal(with("reduced-modulus", "1e30Pa")), HasSubstr("reduced modulus 1e+18 TPa is not within"));
  EXPECT_THAT(refusal(with("hamaker", "nanzJ")), HasSubstr("--hamaker: cannot read \"nanzJ\""));
  EXPECT_THAT(refusal(contact_of("mica", "paper"), {.step = "0.00001pm"}), HasSubstr("more than 10000000 samples"));
  EXPECT_THAT(refusal(contact_of("mica", "paper"), {.from = "1nm"}), HasSubstr("below jump-to-contact at 2.3975 nm"));
  curves::ContactOptions fast = contact_of("mica", "dynamic-dmt");
  EXPECT_THAT(refusal(fast, {.speed = "0um/s"}), HasSubstr("--speed: 0um/s is not positive"));
}

TEST(CurveCommand, ShowsTheDirectionRuleForComparison) {
  const auto json = json_of(contact_of("mica", "paper-rule"), {.step = "0.5nm"});
  // the jump lies at a sample, below the threshold
  EXPECT_LT(json["snap_in"]["z_m"], 2.39e-9);
}

TEST(CurvePlot, MarksBothJumps) {
  const auto run = run_of(contact_of("mica", "dmt"));
  ASSERT_TRUE(run.has_value());
  const curves::SvgPlot plot = curves::curve_plot(*run);
  ASSERT_EQ(plot.marks.size(), 2U);
  EXPECT_EQ(plot.marks[0].text, "snap-in: 2.398 nm, \u22120.2034 nN");
  EXPECT_NEAR(plot.marks[1].at.y, -1.4, 0.001);
  // the turn belongs to both lines
  EXPECT_EQ(plot.lines[0].points.back().x, plot.lines[1].points.front().x);
}

}  // namespace curve_command_test
}  // namespace afm::app
