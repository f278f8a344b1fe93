// SPDX-License-Identifier: Apache-2.0
// What a computed curve was made from: written into every format, and read back.
// Invariant: every input of a computed curve is read back from every format
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/options/contact_options.h"
#include "curves/curve_file.h"
#include "curves/curve_output.h"
#include "curves/curve_report.h"
#include "curves/curve_run.h"
#include "support/places.h"

namespace afm::curves {
namespace curve_parameters_test {

using testing::HasSubstr;
using testing::Not;

// A law with the lever's dynamics, so that every parameter acts.
CurveRun dynamic_run() {
  curves::ContactOptions options;
  options.assets_dir = support::source("assets");
  options.material = "mica";
  options.model = "dynamic-maugis";
  options.values = {{"spring-constant", "1N/m"},
                    {"sample-stiffness", "50N/m"},
                    {"atomic-distance", "3.1\u00c5"},
                    {"temperature", "21\u00b0C"}};
  PathOptions path;
  path.from = "20nm";
  path.to = "-2nm";
  path.step = "0.1nm";
  path.speed = "30um/s";
  path.seed = "77";
  auto run = run_curve(curves::contact_setup(options).value(), path);
  EXPECT_TRUE(run.has_value()) << run.error().message;
  return *std::move(run);
}

using Parameters = std::map<std::string, std::string>;

Parameters parameters_of(const RecordedCurve& curve) {
  return {curve.metadata.parameters.begin(), curve.metadata.parameters.end()};
}

// Expects all numbers of the setup under their JSON keys.
void expect_every_number(const CurveRun& run, const RecordedCurve& read) {
  const Parameters found = parameters_of(read);
  int numbers = 0;
  for (const ContactParameter& parameter : contact_parameters()) {
    const auto value = parameter.get(run.setup);
    if (!value || !acts(parameter, run.setup.model)) continue;
    ++numbers;
    const auto entry = found.find(std::string(parameter.json_key));
    ASSERT_NE(entry, found.end()) << parameter.json_key;
    EXPECT_EQ(number_of(entry->second), *value) << parameter.json_key;
  }
  EXPECT_GE(numbers, 9);
  const std::map<std::string, double> path{{"from_m", run.plan.from.si},
                                           {"to_m", run.plan.to.si},
                                           {"step_m", run.plan.step.si},
                                           {"speed_m_per_s", 30e-6},
                                           {"seed", 77.0},
                                           {"tabor_parameter", run.place->tabor},
                                           {"maugis_lambda", run.place->maugis}};
  for (const auto& [key, value] : path) EXPECT_EQ(number_of(found.at(key)), value) << key;
  EXPECT_EQ(found.at("model"), "dynamic-maugis");
  EXPECT_EQ(found.at("medium"), "water");
}

class ParametersIn : public testing::TestWithParam<CurveFormat> {};

TEST_P(ParametersIn, AreAllReadBack) {
  const CurveRun run = dynamic_run();
  const RecordedCurve written = recorded_curve(run);
  const auto bytes = curve_bytes(GetParam(), written);
  ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
  const auto read = parse_curve(*bytes, "mica");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  expect_every_number(run, *read);
  EXPECT_EQ(parameters_of(*read).size(), parameters_of(written).size());
  EXPECT_NEAR(read->metadata.spring_constant->si, 1.0, 1e-15);
  EXPECT_EQ(read->metadata.approach_speed, written.metadata.approach_speed);
  EXPECT_EQ(read->metadata.retract_speed, written.metadata.retract_speed);
  EXPECT_EQ(read->metadata.curve_id, "mica");
  EXPECT_EQ(read->metadata.instrument, "TouchAFM");
  EXPECT_EQ(read->metadata.software, "TouchAFM");
  EXPECT_EQ(read->metadata.software_version, written.metadata.software_version);
}

INSTANTIATE_TEST_SUITE_P(CurveFiles, ParametersIn,
                         testing::Values(CurveFormat::Tab, CurveFormat::Hdf5, CurveFormat::AfmWorkshop));

TEST(ParametersInCsv, AreAllReadBackAndPrinted) {
  const CurveRun run = dynamic_run();
  const auto read = parse_curve(curve_csv(run), "mica");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  expect_every_number(run, *read);
  EXPECT_EQ(parameters_of(*read), parameters_of(recorded_curve(run)));
  const auto analysed_curve = analysed("mica", *read);
  ASSERT_TRUE(analysed_curve.has_value());
  const nlohmann::ordered_json json = features_json(*analysed_curve, nullptr);
  EXPECT_EQ(json["parameters"]["seed"], 77.0);
  EXPECT_EQ(json["parameters"]["tip"], "Si3N4");
}

CurveRun run_of_events(const char* model, const char* step, bool events_only) {
  curves::ContactOptions options;
  options.assets_dir = support::source("assets");
  options.material = "mica";
  options.model = model;
  PathOptions path;
  path.from = "20nm";
  path.to = "-5nm";
  path.step = step;
  path.events_only = events_only;
  auto run = run_curve(curves::contact_setup(options).value(), path);
  EXPECT_TRUE(run.has_value()) << run.error().message;
  return run ? *std::move(run) : CurveRun{};
}

// Ten times the largest number of samples of a curve; none of them is requested.
TEST(EventsAlone, AreNotRefusedForSamples) {
  for (const char* model : {"dmt", "paper-rule"}) {
    const auto json = curve_json(run_of_events(model, "0.0005pm", true));
    EXPECT_FALSE(json["snap_in"].is_null()) << model;
    EXPECT_FALSE(json["pull_off"].is_null()) << model;
  }
  EXPECT_EQ(run_of_events("dmt", "0.0005pm", true).plan.step.si, 0.0005e-12);
  const CurveRun coarse = run_of_events("dmt", "50pm", false), events = run_of_events("dmt", "50pm", true);
  EXPECT_EQ(curve_json(coarse), curve_json(events));
}

TEST(Parameters, OfAStrangeFileStayOnOneLineAndFew) {
  CurveMetadata metadata;
  add_parameter("tip: a\n# END METADATA\t\x1b[2J\xff", metadata);
  ASSERT_EQ(metadata.parameters.size(), 1U);
  for (const char* control : {"\n", "\t", "\x1b", "\xff"}) {
    EXPECT_THAT(metadata.parameters[0].second, Not(HasSubstr(control)));
  }
  for (const char* none : {"no colon", ": no key", "no value: ", ""}) add_parameter(none, metadata);
  add_parameter("long: " + std::string(5000, 'x'), metadata);
  EXPECT_EQ(metadata.parameters.size(), 1U);
  for (int i = 0; i < 1000; ++i) add_parameter("key: value", metadata);
  EXPECT_EQ(metadata.parameters.size(), 200U);
}

TEST(Parameters, DoNotHideWhatAFormatIsKnownBy) {
  RecordedCurve curve = recorded_curve(dynamic_run());
  for (int i = 0; i < 300; ++i) add_parameter("BEGIN METADATA " + std::string(1900, 'x') + ": \xff", curve.metadata);
  for (int i = 0; i < 300; ++i) add_parameter("END METADATA: " + std::string(90, '\xff'), curve.metadata);
  for (const CurveFormat format : {CurveFormat::Tab, CurveFormat::Hdf5, CurveFormat::AfmWorkshop}) {
    const auto read = parse_curve(curve_bytes(format, curve).value(), "mica");
    EXPECT_TRUE(read.has_value()) << read.error().message;
  }
}

// Lines of instruments that look like ours, with anything in them.
TEST(Parameters, AnotherFilesLinesAreReadOrRefused) {
  const RecordedCurve curve = recorded_curve(dynamic_run());
  std::string bytes = curve_bytes(CurveFormat::AfmWorkshop, curve).value();
  const std::size_t place = bytes.find("TouchAFM ");
  for (const char* line : {"TouchAFM \r\n", "TouchAFM made from \r\n", "TouchAFM made from :\t\r\n",
                           "TouchAFM setpoint:\tred\r\n", "TouchAFM imaging mode:\tcreep\r\n"}) {
    const auto read = parse_curve(std::string(bytes).insert(place, line), "mica");
    if (read) continue;
    EXPECT_THAT(read.error().message, HasSubstr("cannot read the curve mica: "));
  }
}

}  // namespace curve_parameters_test
}  // namespace afm::curves
