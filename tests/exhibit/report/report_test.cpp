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

}  // namespace report_test
}  // namespace afm::exhibit
