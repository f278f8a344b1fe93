// SPDX-License-Identifier: Apache-2.0
// Invariant: every request to `touchafm serve` is answered on one line, and a refused one changes nothing
#include "instrument/json_door.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base64.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/curve_file.h"
#include "curves/image_file.h"
#include "instrument/simulated_instrument.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::instrument {
namespace json_door_test {

using nlohmann::json;
using testing::HasSubstr;

class JsonDoorTest : public testing::Test {
 protected:
  std::vector<std::string> lines_for(const std::string& request) {
    std::vector<std::string> lines;
    then_ = door_.answer(request, [&](std::string_view line) {
      EXPECT_EQ(line.find('\n'), line.size() - 1);
      lines.emplace_back(line.substr(0, line.size() - 1));
      return true;
    });
    return lines;
  }
  json answer_to(const std::string& request) { return json::parse(lines_for(request).back()); }
  std::string refusal_of(const std::string& request) {
    const json answer = answer_to(request);
    EXPECT_EQ(answer.at("ok"), false) << request;
    return answer.value("error", "");
  }

  support::ScratchFolder folder_;
  SimulatedInstrument instrument_ = std::move(SimulatedInstrument::create(support::source("assets"), 1)).value();
  JsonDoor door_{instrument_, folder_.file("")};
  JsonDoor::Then then_ = JsonDoor::Then::GoOn;
};

TEST_F(JsonDoorTest, SaysWhoItIsAndWhatItCanDo) {
  const json answer = answer_to(R"({"id": "a", "do": "hello"})");
  EXPECT_EQ(answer["id"], "a");
  EXPECT_EQ(answer["ok"], true);
  EXPECT_EQ(answer["software"], "TouchAFM");
  EXPECT_EQ(answer["protocol"], 1);
  EXPECT_EQ(answer["verbs"].size(), 16U);
}

TEST_F(JsonDoorTest, TakesBackEverySettingThatItLists) {
  const json values = answer_to(R"({"do": "get"})")["values"];
  EXPECT_GT(values.size(), 30U);
  EXPECT_EQ(values["material"], "mica");
  for (const auto& [key, value] : values.items()) {
    // a number of the contact without effect in this law is refused as on the command line
    const json answer = answer_to(json{{"do", "set"}, {"values", {{key, value}}}}.dump());
    if (answer["ok"] == false) {
      EXPECT_THAT(answer.value("error", ""), HasSubstr("no effect")) << key;
    }
  }
}

TEST_F(JsonDoorTest, ChangesAllSettingsOrNone) {
  EXPECT_THAT(refusal_of(R"({"do": "set", "values": {"pixels": 32, "line_rate_Hz": -1}})"), HasSubstr("line_rate_Hz"));
  EXPECT_EQ(answer_to(R"({"do": "get"})")["values"]["pixels"], 64);
  EXPECT_THAT(refusal_of(R"({"do": "set", "values": {"pixels": 32, "material": "cheese"}})"), HasSubstr("cheese"));
  EXPECT_EQ(answer_to(R"({"do": "get"})")["values"]["pixels"], 64);
  EXPECT_EQ(answer_to(R"({"do": "set", "values": {"pixels": 32, "material": "gold"}})")["ok"], true);
  EXPECT_EQ(answer_to(R"({"do": "get"})")["values"]["material"], "gold");
}

TEST_F(JsonDoorTest, RefusesAPartOfAPixelLineOrSeed) {
  EXPECT_THAT(refusal_of(R"({"do": "set", "values": {"pixels": 32.5}})"), HasSubstr("\"pixels\": give a whole number"));
  EXPECT_THAT(refusal_of(R"({"do": "set", "values": {"lines": 0.5}})"), HasSubstr("\"lines\": give a whole number"));
  EXPECT_THAT(refusal_of(R"({"do": "hello", "seed": 1.5})"), HasSubstr("\"seed\": give a whole number"));
  EXPECT_EQ(answer_to(R"({"do": "set", "values": {"pixels": 32.0}})")["ok"], true);
}

TEST_F(JsonDoorTest, MovesTheBaseWithoutFeedback) {
  EXPECT_THAT(refusal_of(R"({"do": "set_z"})"), HasSubstr("\"z_m\": give the height"));
  EXPECT_THAT(refusal_of(R"({"do": "set_z", "z_m": 1})"), HasSubstr("\"z_m\""));
  answer_to(R"({"do": "approach"})");
  const json pressed = answer_to(R"({"do": "set_z", "z_m": -1e-7, "speed_m_per_s": 1e-6})");
  EXPECT_EQ(pressed["z_m"], -1e-7);
  EXPECT_EQ(pressed["engaged"], false);
  EXPECT_GT(pressed["force_N"], 9e-9);
  EXPECT_EQ(answer_to(R"({"do": "truth"})")["touching"], true);
}

TEST_F(JsonDoorTest, StreamsAnImageLineByLine) {
  EXPECT_THAT(refusal_of(R"({"do": "scan"})"), HasSubstr("approach"));
  EXPECT_EQ(answer_to(R"({"do": "approach"})")["engaged"], true);
  answer_to(R"({"do": "set", "values": {"lines": 5}})");
  const std::vector<std::string> lines = lines_for(R"({"id": 7, "do": "scan"})");
  ASSERT_EQ(lines.size(), 6U);
  for (std::size_t i = 0; i < 5; ++i) {
    const json line = json::parse(lines[i]);
    EXPECT_EQ(line["id"], 7);
    EXPECT_EQ(line["line"], i);
    EXPECT_EQ(line["trace"]["height_m"].size(), 64U);
    EXPECT_EQ(line["retrace"]["lateral_N"].size(), 64U);
  }
  EXPECT_EQ(json::parse(lines.back())["rows"], 5);
}

TEST_F(JsonDoorTest, EndsAScanThatTheNextRequestStops) {
  answer_to(R"({"do": "approach"})");
  std::size_t looks = 0;
  std::string meanwhile;
  door_.look_with([&]() -> std::string_view {
    if (++looks == 5) meanwhile = "{\"id\": 8, \"do\": \"stop\"}\n";
    return meanwhile;
  });
  const std::vector<std::string> lines = lines_for(R"({"id": 7, "do": "scan"})");
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(json::parse(lines.back())["stopped"], true);
  EXPECT_EQ(json::parse(lines.back())["rows"], 64);
  EXPECT_EQ(answer_to(meanwhile)["ok"], true);

  // any other request, or a part of one, waits
  for (const char* other : {"{\"do\": \"stop\"}", "{\"do\": \"get\"}\n{\"do\": \"stop\"}\n", "[\"stop\"]\n", "\n"}) {
    door_.look_with([other] { return std::string_view(other); });
    EXPECT_EQ(lines_for(R"({"do": "scan"})").size(), 65U) << other;
  }
}

TEST_F(JsonDoorTest, EndsAScanThatNobodyReads) {
  answer_to(R"({"do": "approach"})");
  int sent = 0;
  door_.answer(R"({"do": "scan"})", [&](std::string_view) { return ++sent < 3; });
  EXPECT_LE(sent, 4);
}

TEST_F(JsonDoorTest, GivesACurveWithItsBranches) {
  const json answer = answer_to(R"({"do": "curve", "points": 100, "z_from_m": 3e-8, "z_to_m": -5e-9})");
  EXPECT_EQ(answer["z_m"].size(), answer["force_N"].size());
  EXPECT_GE(answer["approach_points"], 100);
  EXPECT_LT(answer["z_m"][answer["approach_points"].get<std::size_t>() - 1], -4.9e-9);
  EXPECT_EQ(answer.contains("work_of_adhesion"), false);
}

TEST_F(JsonDoorTest, PacksArraysWhereTheRequestAsksForIt) {
  const std::string request = R"({"do": "curve", "points": 20, "z_from_m": 3e-8, "z_to_m": -5e-9, "arrays": )";
  const json numbers = answer_to(request + R"("numbers"})"), packed = answer_to(request + R"("base64"})");
  for (const char* array : {"z_m", "force_N"}) {
    const auto values = numbers[array].get<std::vector<double>>();
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()), 8 * values.size());
    EXPECT_EQ(packed[array], (json{{"base64", core::base64(bytes)}})) << array;
  }
  EXPECT_EQ(packed["approach_points"], numbers["approach_points"]);
  EXPECT_EQ(answer_to(request + "null}")["z_m"], numbers["z_m"]) << "as without the member";
  EXPECT_THAT(refusal_of(request + R"("base32"})"), HasSubstr(R"("arrays": give "numbers" or "base64")"));
  EXPECT_THAT(refusal_of(R"({"do": "get", "arrays": 3})"), HasSubstr("\"arrays\""));
  EXPECT_EQ(answer_to(R"({"do": "hello"})")["arrays"], (json{"numbers", "base64"}));
}

TEST_F(JsonDoorTest, PacksTheLinesOfAnImageAndASpectrum) {
  answer_to(R"({"do": "approach"})");
  answer_to(R"({"do": "set", "values": {"lines": 2, "pixels": 3}})");
  const json line = json::parse(lines_for(R"({"do": "scan", "arrays": "base64"})").front());
  EXPECT_EQ(line["trace"]["height_m"]["base64"].get<std::string>().size(), 32U);
  EXPECT_EQ(line["retrace"]["lateral_N"]["base64"].get<std::string>().size(), 32U);
  EXPECT_TRUE(answer_to(R"({"do": "thermal", "points": 30, "arrays": "base64"})")["frequency_Hz"].contains("base64"));
}

TEST_F(JsonDoorTest, TakesTheUsualPathOfTheContactThatIsThere) {
  const std::string request = R"({"do": "curve", "points": 20})";
  const json mica = answer_to(request)["z_m"];
  EXPECT_EQ(answer_to(request)["z_m"], mica);
  answer_to(R"({"do": "set", "values": {"material": "gold"}})");
  EXPECT_NE(answer_to(request)["z_m"][0], mica[0]);
  answer_to(R"({"do": "set", "values": {"material": "mica"}})");
  EXPECT_EQ(answer_to(request)["z_m"], mica);
}

TEST_F(JsonDoorTest, GivesATappingCurve) {
  const json set = answer_to(R"({"do": "set", "values": {"law": "dmt", "spring_constant_N_per_m": 40,
                              "quality_factor": 400, "resonance_Hz": 300e3, "free_amplitude_m": 2e-8}})");
  ASSERT_EQ(set["ok"], true) << set.dump();
  EXPECT_EQ(answer_to(R"({"do": "get"})")["values"]["quality_factor"], 400);
  const json answer = answer_to(R"({"do": "tapping_curve", "z_from_m": 3e-8, "z_to_m": 1e-8, "points": 50})");
  ASSERT_EQ(answer["ok"], true) << answer.dump();
  EXPECT_EQ(answer["amplitude_m"].size(), answer["phase_rad"].size());
  EXPECT_NEAR(answer["amplitude_m"][0].get<double>(), 2e-8, 1e-9);
  EXPECT_TRUE(answer["figures"].contains("jumps"));
  const json usual = answer_to(R"({"do": "tapping_curve", "points": 11})");
  EXPECT_GE(usual["z_m"].size(), 22U) << "also between the usual heights, with those of jumps";
  EXPECT_LE(usual["z_m"].size(), 30U);
  EXPECT_NEAR(usual["z_m"][0].get<double>(), 22e-9, 1e-15);
}

TEST_F(JsonDoorTest, CountsTheHeightsOfATappingCurveAndEndsIt) {
  const std::string request = R"({"id": 7, "do": "tapping_curve", "points": 5)";
  const std::vector<std::string> lines = lines_for(request + R"(, "progress": true})");
  ASSERT_EQ(lines.size(), 10U) << "down, up again, and the answer";
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(json::parse(lines[static_cast<std::size_t>(i)]), (json{{"id", 7}, {"done", i + 1}, {"of", 9}}));
  }
  EXPECT_EQ(lines_for(request + "}"), (std::vector{lines.back()})) << "unless it is asked for";
  EXPECT_THAT(refusal_of(request + R"(, "progress": 1})"), HasSubstr("\"progress\": give true or false"));

  std::size_t looks = 0;
  door_.look_with([&] { return std::string_view(++looks == 3 ? "{\"do\": \"stop\"}\n" : ""); });
  EXPECT_EQ(refusal_of(request + "}"), "the tapping curve was ended after 3 of 9 heights");
  door_.look_with({});
  int sent = 0;
  door_.answer(request + R"(, "progress": true})", [&](std::string_view) { return ++sent < 3; });
  EXPECT_EQ(sent, 4) << "nobody reads: the refusal alone comes after the third line";
  EXPECT_EQ(lines_for(request + "}"), (std::vector{lines.back()})) << "nothing has changed";
}

TEST_F(JsonDoorTest, StreamsAnImageOfASwing) {
  EXPECT_THAT(refusal_of(R"({"do": "set", "values": {"mode": "lift"}})"), HasSubstr("contact"));
  answer_to(R"({"do": "set", "values": {"mode": "tapping", "law": "dmt", "spring_constant_N_per_m": 40,
                "quality_factor": 400, "resonance_Hz": 300e3, "amplitude_setpoint": 0.8, "pixels": 8, "lines": 2}})");
  EXPECT_EQ(answer_to(R"({"do": "get"})")["values"]["mode"], "tapping");
  answer_to(R"({"do": "approach"})");
  const std::vector<std::string> lines = lines_for(R"({"do": "scan"})");
  ASSERT_EQ(lines.size(), 3U) << lines.back();
  const json trace = json::parse(lines.front())["trace"];
  for (const char* channel : {"height_m", "error_m", "phase_deg", "energy_J", "peak_force_N"}) {
    EXPECT_EQ(trace[channel].size(), 8U) << channel;
  }
  EXPECT_FALSE(trace.contains("lateral_N"));
  const json conventions = json::parse(lines.back())["conventions"];
  EXPECT_EQ(conventions["amplitude"], "zero-to-peak");
  EXPECT_THAT(conventions["phase"].get<std::string>(), HasSubstr("lag"));
  json truth = answer_to(R"({"do": "truth"})");
  EXPECT_EQ(truth["state_flips"], 0);
  EXPECT_FALSE(truth["sources"]["tip_radius"]["source"].get<std::string>().empty());
  EXPECT_FALSE(truth["sources"]["law"]["source"].get<std::string>().empty());
}

TEST_F(JsonDoorTest, SavesTheNewestImageAndCurve) {
  EXPECT_THAT(refusal_of(R"({"do": "save", "file": "a.gwy"})"), HasSubstr("no image"));
  answer_to(R"({"do": "approach"})");
  lines_for(R"({"do": "scan"})");
  answer_to(R"({"do": "curve", "points": 60})");
  EXPECT_EQ(answer_to(R"({"do": "save", "file": "a.gwy"})")["ok"], true);
  EXPECT_EQ(answer_to(R"({"do": "save", "file": "a.tab"})")["ok"], true);
  const std::string image = core::read_file(folder_.file("a.gwy")).value();
  EXPECT_THAT(image, testing::AllOf(HasSubstr(core::written_by()), HasSubstr("Line rate"), HasSubstr("mica")));
  EXPECT_TRUE(curves::load_image(folder_.file("a.gwy")));
  const auto curve = curves::load_curve(folder_.file("a.tab"));
  ASSERT_TRUE(curve);
  EXPECT_TRUE(curve->metadata.parameters.empty()) << "the file has no truth";
  EXPECT_THAT(refusal_of(R"({"do": "save", "file": "a.tab"})"), HasSubstr("already"));
}

TEST_F(JsonDoorTest, WritesNowhereElse) {
  answer_to(R"({"do": "curve", "points": 10})");
  for (const char* name : {"../a.tab", "/tmp/a.tab", ".a.tab", "a/b.tab", "", "a b.tab"}) {
    EXPECT_THAT(refusal_of(json{{"do", "save"}, {"file", name}}.dump()), HasSubstr("give a name")) << name;
  }
  JsonDoor nowhere(instrument_, "");
  std::string line;
  nowhere.answer(R"({"do": "save", "file": "a.tab"})", [&](std::string_view text) {
    line = text;
    return true;
  });
  EXPECT_THAT(line, HasSubstr("--out"));
}

TEST_F(JsonDoorTest, RefusesWhatItDoesNotUnderstand) {
  const std::string deep = R"({"do": )" + std::string(100'000, '[') + "}";
  for (const std::string& request : {std::string(),
                                     std::string("{"),
                                     std::string("[]"),
                                     std::string("7"),
                                     std::string(R"({"do": 7})"),
                                     deep,
                                     std::string("\xff\xfe{}"),
                                     std::string(R"({"id": {"a": 1}, "do": "hello"})"),
                                     std::string(R"({"do": "fly"})"),
                                     std::string(R"({"do": "wait"})"),
                                     std::string(R"({"do": "wait", "time_s": -1})"),
                                     std::string(R"({"do": "wait", "time_s": 1e99})"),
                                     std::string(R"({"do": "wait", "time_s": "long"})"),
                                     std::string(R"({"do": "curve", "points": 1.5})"),
                                     std::string(R"({"do": "curve", "point": 10})"),
                                     std::string(R"({"do": "curve", "z_from_m": 1e-9, "z_to_m": 2e-9})"),
                                     std::string(R"({"do": "set", "values": 3})"),
                                     std::string(R"({"do": "set", "values": {"colour": 3}})"),
                                     std::string(R"({"do": "set", "values": {"quality_factor": 0}})"),
                                     std::string(R"({"do": "set", "values": {"resonance_Hz": 1e12}})"),
                                     std::string(R"({"do": "thermal", "points": 1e9})")}) {
    EXPECT_NE(refusal_of(request), "") << request.substr(0, 80);
    EXPECT_EQ(then_, JsonDoor::Then::GoOn);
  }
  EXPECT_EQ(answer_to(R"({"do": "hello"})")["ok"], true);
}

TEST_F(JsonDoorTest, SaysWhyALineIsNoRequest) {
  EXPECT_THAT(refusal_of(R"({"do": "wait", "time_s": 1e400})"), HasSubstr("1e400"));
  EXPECT_THAT(refusal_of(R"({"do": "wait", "time_s": NaN})"), HasSubstr("column"));
  EXPECT_THAT(refusal_of(R"({"id": "\ud800", "do": "get"})"), HasSubstr("surrogate"));
  EXPECT_THAT(refusal_of(R"({"do": "get", "do": "quit"})"), HasSubstr("\"do\" is given twice"));
  EXPECT_THAT(refusal_of(R"({"do": "set", "values": {"pixels": 8, "lines": 8, "pixels": 9}})"),
              HasSubstr("\"pixels\" is given twice"));
  EXPECT_LT(refusal_of("{\"do\": " + std::string(500'000, 'x') + "}").size(), 400U);
  EXPECT_EQ(answer_to(R"({"do": "set", "values": {"do": null}, "id": 3})")["id"], 3) << "a name at two levels";
}

TEST_F(JsonDoorTest, RepeatsAnIdWithAllItsDigitsOrRefusesIt) {
  for (const char* id : {"18446744073709551615", "-9223372036854775808", "0.1", "-7", "\"\\u0041\\ud83d\\ude00\""}) {
    EXPECT_EQ(answer_to(fmt::format(R"({{"id": {}, "do": "truth"}})", id))["id"], json::parse(id));
  }
  EXPECT_THAT(refusal_of(R"({"id": 123456789012345678901, "do": "truth"})"), HasSubstr("\"id\""));
}

TEST_F(JsonDoorTest, EndsWhenAskedTo) {
  EXPECT_EQ(answer_to(R"({"do": "quit"})")["ok"], true);
  EXPECT_EQ(then_, JsonDoor::Then::Quit);
}

TEST_F(JsonDoorTest, GivesTheSameBytesForTheSameRequests) {
  const auto run = [this] {
    std::string bytes;
    for (const char* request : {R"({"do": "hello", "seed": 4})",
                                R"({"do": "set", "values": {"pixels": 8, "noise_m": 1e-11, "force_noise_N": 1e-11}})",
                                R"({"do": "curve", "points": 30})", R"({"do": "approach"})", R"({"do": "scan"})",
                                R"({"do": "thermal", "points": 20, "averages": 2})", R"({"do": "truth"})"}) {
      for (const std::string& line : lines_for(request)) bytes += line + "\n";
    }
    return bytes;
  };
  const std::string first = run();
  EXPECT_EQ(first, run());
}

}  // namespace json_door_test
}  // namespace afm::instrument
