// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/commands/scan_command.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace tapping_scan_command_test {

using testing::HasSubstr;

ScanOptions tapping_options() {
  ScanOptions options;
  options.contact.assets_dir = support::source("assets");
  options.contact.material = "mica";
  options.contact.values["spring-constant"] = "40N/m";
  options.contact.values["resonance"] = "300kHz";
  options.contact.values["quality-factor"] = "400";
  options.tapping.mode = "tapping";
  options.tapping.numbers.free_amplitude = "20nm";
  options.amplitude_setpoint = "0.8";
  options.pixels = 8;
  return options;
}

std::string refusal(const ScanOptions& options) {
  const auto scan = imaging::take_scan(options);
  return scan ? "taken" : scan.error().message;
}

TEST(TappingScanCommand, SaysWhatItDidWithItsConventions) {
  const auto scan = imaging::take_scan(tapping_options());
  ASSERT_TRUE(scan) << scan.error().message;
  const nlohmann::json json = imaging::scan_json(*scan);
  EXPECT_DOUBLE_EQ(json["tapping"]["setpoint_m"].get<double>(), 16e-9);
  EXPECT_THAT(json["tapping"]["conventions"]["phase"].get<std::string>(), HasSubstr("lag of the tip"));
  EXPECT_EQ(json["tapping"]["conventions"]["amplitude"], "zero-to-peak");
  EXPECT_EQ(json["tapping"]["method"], "averaged");
  EXPECT_EQ(json["tapping"]["regime_changes"], 0);
  EXPECT_EQ(json["tapping"]["attractive_share"], 0.0);
  EXPECT_GT(json["tapping"]["largest_peak_force_N"].get<double>(), 1e-9);
  EXPECT_FALSE(json["settings"].contains("setpoint_N"));
  EXPECT_EQ(json["channels"].size(), 10U);
}

TEST(TappingScanCommand, IntegratesALeverInWaterDirectly) {
  ScanOptions options = tapping_options();
  options.contact.values["spring-constant"] = "2N/m";
  options.contact.values["resonance"] = "30kHz";
  options.contact.values["quality-factor"] = "5";
  const auto scan = imaging::take_scan(options);
  ASSERT_TRUE(scan) << scan.error().message;
  const nlohmann::json json = imaging::scan_json(*scan);
  EXPECT_EQ(json["tapping"]["method"], "direct");
  EXPECT_EQ(json["metadata"]["Method"], "direct");
  // mica is level under a tip of 50 nm but for its steps
  EXPECT_NEAR(json["channels"][2]["mean"].get<double>(), 0.0, 1e-9);
  EXPECT_GT(json["tapping"]["largest_peak_force_N"].get<double>(), 1e-10);
}

// The share of a channel's values that lie above the phase of a free lever at its resonance.
double share_above_90(const physics::ScanImage& image, const std::string& name) {
  const auto channel = std::find_if(image.channels.begin(), image.channels.end(),
                                    [&](const physics::ImageChannel& one) { return one.name == name; });
  const auto above = std::count_if(channel->values.begin(), channel->values.end(), [](double deg) { return deg > 90; });
  return static_cast<double>(above) / static_cast<double>(channel->values.size());
}

TEST(TappingScanCommand, NamesWhatEachPassWas) {
  ScanOptions options = tapping_options();
  // over steps, at a setpoint at which both states exist
  options.contact.model = "dmt";
  options.contact.values["tip-radius"] = "20nm";
  options.contact.values["hamaker"] = "64zJ";
  options.contact.values["work-of-adhesion"] = "62.4mJ/m2";
  options.contact.values["reduced-modulus"] = "1.5GPa";
  options.amplitude_setpoint = "0.85";
  const auto set = [&](std::string_view option, double si) {
    const auto* const field = std::find_if(physics::kScanFields.begin(), physics::kScanFields.end(),
                                           [&](const physics::ScanField& each) { return each.option == option; });
    options.settings.emplace_back(field, si);
  };
  set("integral-gain", 500.0);
  set("rate", 10.0);
  options.pixels = 32;
  const auto scan = imaging::take_scan(options);
  ASSERT_TRUE(scan) << scan.error().message;
  const nlohmann::json tapping = imaging::scan_json(*scan)["tapping"];
  EXPECT_EQ(tapping["attractive_share"], share_above_90(scan->image, "Phase"));
  EXPECT_EQ(tapping["attractive_share_retrace"], share_above_90(scan->image, "Phase (retrace)"));
  EXPECT_NE(tapping["attractive_share"], tapping["attractive_share_retrace"]);
  EXPECT_NE(tapping["largest_peak_force_N"], tapping["largest_peak_force_retrace_N"]);
  EXPECT_NE(tapping["regime_changes"], tapping["regime_changes_retrace"]);
}

TEST(TappingScanCommand, TakesALengthForTheSetpointToo) {
  ScanOptions options = tapping_options();
  const auto share = imaging::take_scan(options);
  options.amplitude_setpoint = "16nm";
  const auto length = imaging::take_scan(options);
  ASSERT_TRUE(share && length);
  EXPECT_EQ(share->image.channels[0].values, length->image.channels[0].values);
}

TEST(TappingScanCommand, RefusesWithTheReason) {
  ScanOptions damped = tapping_options();
  damped.contact.values["quality-factor"] = "0.3";
  EXPECT_THAT(refusal(damped), HasSubstr("quality factor"));
  for (const char* model : {"paper", "hao"}) {
    ScanOptions options = tapping_options();
    options.contact.model = model;
    EXPECT_THAT(refusal(options), HasSubstr("needs the force as a function of the tip's height")) << model;
  }
  ScanOptions high = tapping_options();
  high.amplitude_setpoint = "1.2";
  EXPECT_THAT(refusal(high), HasSubstr("setpoint"));
  ScanOptions contact = tapping_options();
  contact.tapping = {};
  EXPECT_THAT(refusal(contact), HasSubstr("in contact mode it is a force"));
  ScanOptions sticky = tapping_options();
  sticky.settings.emplace_back(&physics::kScanFields[10], 1e-9);
  ASSERT_EQ(physics::kScanFields[10].name, "adhesion");
  EXPECT_THAT(refusal(sticky), HasSubstr("--adhesion has no effect on --mode tapping"));
}

}  // namespace tapping_scan_command_test
}  // namespace afm::app
