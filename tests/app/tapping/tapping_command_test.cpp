// SPDX-License-Identifier: Apache-2.0
#include "app/tapping/tapping_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

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

nlohmann::json json_of(const curves::TappingChoice& choice) {
  const auto text = tapping_text(choice, tapped(), {}, "json");
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
}

TEST(TappingCommand, RefusesOptionsWithoutEffect) {
  curves::TappingChoice contact;
  contact.numbers.free_amplitude = "20nm";
  EXPECT_THAT(refusal(contact), HasSubstr("--free-amplitude has no effect on --mode contact"));
  curves::TappingChoice fm = tapping();
  fm.mode = "fm";
  EXPECT_THAT(refusal(fm), HasSubstr("--free-amplitude has no effect on --mode fm"));
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
