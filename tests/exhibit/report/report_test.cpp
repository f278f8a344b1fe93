// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "curves/curve_file.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace report_test {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::string report() {
  DemoResult result;
  result.servo.wake_us[7] = 90;
  result.servo.wake_us.back() = 10;
  result.servo.wake_max_us = 11490;
  result.frame_ms = {1250.0, 1250.0};
  return report_html(result, {{.caption = "a picture", .png = "PNG"}}, "<svg></svg>", test::english());
}

TEST(Report, GivesTimesInTheUnitThatFits) {
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<td>8 \u00b5s</td>"));
  EXPECT_THAT(html, HasSubstr("<td>11.49 ms</td>"));
  EXPECT_THAT(html, HasSubstr("<td>1.25 s</td>"));
  EXPECT_THAT(html, Not(HasSubstr("e+0")));
}

// A recorded curve that the tip touches without a jump: zero is no height of a snap-in, and no error either.
TEST(Report, GivesNoFiguresOfASnapInThatWasNotRecorded) {
  Measurement m;
  m.material = "measured";
  m.hysteretic = m.recorded = m.pulls_off = true;
  m.snaps_in = false;
  m.measured = {.f_attr_n = 0.0, .f_ad_n = 1e-9, .z_jtc_m = -24e-9, .z_joc_m = 16e-9};
  m.calculation = {.f_attr_n = 0.0, .f_ad_n = 1e-9, .z_jtc_m = 0.0, .z_joc_m = 16e-9};
  DemoResult result;
  result.measurements.push_back(m);
  result.sessions.emplace_back().material = "measured";
  result.sessions.front().sources = R"({"tip_radius":{"estimated":true,"source":"a data sheet","value":"20 nm"}})";
  const nlohmann::json json = summary_json(result)["materials"]["measured"];
  EXPECT_EQ(json["sources"]["tip_radius"]["source"], "a data sheet");
  EXPECT_EQ(json["estimated"][0], "tip_radius");
  EXPECT_TRUE(json["parameters"].contains("tip_radius_m"));
  EXPECT_TRUE(json["f_attr_N"].is_null());
  EXPECT_TRUE(json["z_jtc_m"].is_null()) << json;
  EXPECT_TRUE(json["error_vs_calculation"]["z_jtc"].is_null()) << json;
  EXPECT_TRUE(json["error_vs_calculation"]["f_attr"].is_null()) << json;
  EXPECT_EQ(json["error_vs_calculation"]["f_ad"], 0.0);
}

// The hand lifts the tip, goes down and up again, and comes back a little; the file is a curve like any other.
TEST(SessionCsv, IsReadAsACurve) {
  servo::RecordedSession session;
  session.material = "gold";
  session.parameters.contact.spring_constant = physics::Stiffness(0.5);
  constexpr int kLift = 100, kWay = 1000, kBack = 50;
  constexpr double kStepNm = 0.05, kTopNm = 40.0;
  const auto add = [&session](double z_nm) {
    scene::TipSample sample;
    sample.time_ns = static_cast<std::int64_t>(session.samples.size()) * 1'000'000;
    sample.tip.z_m = z_nm * 1e-9;
    sample.tip.force_n = std::fmax(0.0, -0.2 * sample.tip.z_m);
    session.samples.push_back(sample);
  };
  for (int i = 0; i < kLift; ++i) add(kTopNm - kStepNm * (kLift - i));
  for (int i = 0; i <= kWay; ++i) add(kTopNm - kStepNm * i);
  for (int i = 1; i <= kWay; ++i) add(kTopNm - kStepNm * (kWay - i));
  for (int i = 1; i <= kBack; ++i) add(kTopNm - kStepNm * i);
  session.sources = R"({"spring_constant":{"estimated":true,"source":"a data sheet","value":"0.5 N/m"}})";
  const std::string csv = session_csv(session);
  EXPECT_THAT(csv, HasSubstr("\n# source of spring_constant: 0.5 N/m, a data sheet (estimated)\n"));
  EXPECT_EQ(count(csv, "\n"), count(csv, "# ") + 1 + session.samples.size());
  const auto curve = curves::parse_curve(csv, "curve-gold.csv");
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_EQ(curve->points.size(), 2U * kWay + 1U);
  EXPECT_NEAR(curve->points.front().z.si, kTopNm * 1e-9, 1e-15);
  EXPECT_NEAR(curve->points.back().z.si, kTopNm * 1e-9, 1e-15);
  EXPECT_EQ(curve->points[kWay].branch, physics::Branch::Approach);
  EXPECT_EQ(curve->points[kWay + 1].branch, physics::Branch::Retract);
  EXPECT_EQ(curve->metadata.spring_constant, physics::Stiffness(0.5));
  EXPECT_EQ(curve->metadata.curve_id, "gold");
  // a file that ends early is noticed
  EXPECT_FALSE(curves::parse_curve(csv.substr(0, csv.rfind('\n', csv.size() * 3 / 4) + 1), "curve-gold.csv"));
  EXPECT_FALSE(curves::parse_curve(session_csv(servo::RecordedSession{}), "curve-none.csv"));
}

// In a browser 400 pixels wide the page keeps its width, and wider contents scroll inside their own box.
TEST(Report, LetsWhatIsWideBeMovedInItsOwnBox) {
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<meta name=\"viewport\" content=\"width=device-width"));
  EXPECT_EQ(count(html, "<div class=\"wide\""), count(html, "<table") + count(html, "<img") + count(html, "<svg"));
  EXPECT_EQ(count(html, "<div class=\"wide\" tabindex=\"0\"><table"), 2U);
}

// A plot of a phone's width can be read in one piece; a pair of pictures cannot.
TEST(Report, FitsThePlotsIntoANarrowBrowser) {
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<div class=\"fits\"><figure><div class=\"wide\" tabindex=\"0\"><svg>"));
  const std::size_t narrow = html.find("@media (max-width: 760px)");
  ASSERT_NE(narrow, std::string::npos);
  EXPECT_GT(html.find(".fits .wide svg { width: 100%; min-width: 0; }"), html.find(".wide svg { width: auto"))
      << "the later rule of two with the same weight counts";
}

TEST(Report, BeginsWithAPictureForOneEyeAndTheForces) {
  Measurement gold;
  gold.title = "Gold";
  gold.measured = {.f_attr_n = 0.4071e-9, .f_ad_n = 9.9997e-9, .z_jtc_m = 5e-9, .z_joc_m = 100e-9};
  Measurement stiff;
  stiff.title = "Mica";
  stiff.hysteretic = false;
  DemoResult result;
  result.measurements = {gold, stiff};
  result.eye_width = 960;
  result.eye_height = 720;
  const std::string html =
      report_html(result, {{.caption = "choosing", .png = "A"}, {test::english()[Phrase::CaptionAdhesion], "B"}},
                  "<svg></svg>", test::english());
  const std::string head = html.substr(0, html.find("<svg"));
  EXPECT_THAT(head, HasSubstr("<b>Gold</b>: 0.407 / 10.000 nN"));
  EXPECT_THAT(head, HasSubstr("<b>Mica</b>: " + test::english()[Phrase::NoJumps]));
  EXPECT_THAT(head, HasSubstr("aspect-ratio: 960 / 720"));
  EXPECT_THAT(head, HasSubstr("base64,Qg==")) << "that of the adhesion";
  EXPECT_EQ(count(html, "<div class=\"wide\""), count(html, "<table") + count(html, "<img") + count(html, "<svg"));
}

}  // namespace report_test
}  // namespace afm::exhibit
