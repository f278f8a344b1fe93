// SPDX-License-Identifier: Apache-2.0
#include "app/demo/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/phrases.h"

namespace afm::app {
namespace {

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

// A browser of 400 pixels: the page keeps its width, and what is wider is moved inside its own box.
TEST(Report, LetsWhatIsWideBeMovedInItsOwnBox) {
  const std::string html = report();
  EXPECT_THAT(html, HasSubstr("<meta name=\"viewport\" content=\"width=device-width"));
  EXPECT_EQ(count(html, "<div class=\"wide\""), count(html, "<table") + count(html, "<img") + count(html, "<svg"));
  EXPECT_EQ(count(html, "<div class=\"wide\" tabindex=\"0\"><table"), 2U);
}

}  // namespace
}  // namespace afm::app
