// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

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
  const nlohmann::json json = summary_json(result)["materials"]["measured"];
  EXPECT_TRUE(json["f_attr_N"].is_null());
  EXPECT_TRUE(json["z_jtc_m"].is_null()) << json;
  EXPECT_TRUE(json["error_vs_calculation"]["z_jtc"].is_null()) << json;
  EXPECT_TRUE(json["error_vs_calculation"]["f_attr"].is_null()) << json;
  EXPECT_EQ(json["error_vs_calculation"]["f_ad"], 0.0);
}

// A browser of 400 pixels: the page keeps its width, and what is wider is moved inside its own box.
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
