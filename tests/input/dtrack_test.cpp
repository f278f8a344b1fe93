// SPDX-License-Identifier: Apache-2.0
#include "input/dtrack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "support/stereo_cases.h"

namespace afm::input {
namespace dtrack_test {

// The tracker rows of the research's test vectors whose convention is dtrack or dtrack_bad.
std::vector<test::StereoCase> dtrack_rows() {
  std::vector<test::StereoCase> rows = test::stereo_cases("tracker");
  std::erase_if(rows, [](const test::StereoCase& row) { return row.convention.rfind("dtrack", 0) != 0; });
  for (test::StereoCase& row : rows) std::replace(row.input.begin(), row.input.end(), '|', '\n');
  return rows;
}

void append_body(const DtrackBody* body, std::vector<double>& values) {
  values.push_back(body != nullptr && body->tracked ? 1 : 0);
  for (int i = 0; i < 3; ++i) values.push_back(body != nullptr ? body->position_m[i] : 0.0);
}

std::vector<double> parsed(const test::StereoCase& row) {
  const auto frame = parse_dtrack(row.input);
  if (!frame) return {-1.0};
  std::vector<double> values{static_cast<double>(frame->frame)};
  const DtrackBody* const head = frame->body(0);
  append_body(head, values);
  const DtrackFlystick* const stick = frame->flystick(0);
  if (stick == nullptr) return values;
  append_body(&stick->body, values);
  values.insert(values.end(), {static_cast<double>(stick->buttons), stick->joystick[0], stick->joystick[1]});
  if (head == nullptr) return values;
  const glm::dmat3 rotation(head->tracker_from_body);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) values.push_back(rotation[c][r]);
  }
  return values;
}

TEST(ResearchVectors, OfDtrackAreReadAsTheySay) {
  const std::vector<test::StereoCase> rows = dtrack_rows();
  ASSERT_EQ(rows.size(), 4U);
  constexpr std::size_t kFirstOfRotation = 12;
  for (const test::StereoCase& row : rows) {
    const std::vector<double> values = parsed(row);
    ASSERT_EQ(values.size(), row.expected.size()) << row.id;
    for (std::size_t i = 0; i < values.size(); ++i) {
      // a rotation has six digits on the wire and is made a unit quaternion
      EXPECT_NEAR(values[i], row.expected[i], i < kFirstOfRotation ? 1e-9 : 2e-6) << row.id << " value " << i;
    }
  }
}

const std::string kIdentity = "[1 0 0 0 1 0 0 0 1]";

TEST(Dtrack, SkipsLinesThatItDoesNotKnowAndTakesTheLatency) {
  const auto frame =
      parse_dtrack("fr 3\nts 1.5\nts2 100 200 4500\n6dcal 1\n3d 1 [1 1.0][2 3 4]\ngl 0\n6d 1 [5 0.9][1 2 3 0 0 0]" +
                   kIdentity + "\r\n");
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->latency_us, 4500U);
  ASSERT_NE(frame->body(5), nullptr);
  EXPECT_EQ(frame->body(5)->position_m, glm::dvec3(0.001, 0.002, 0.003));
  EXPECT_EQ(frame->body(4), nullptr);
}

TEST(Dtrack, ReadsSixtyFourBodiesAndRefusesMore) {
  const auto packet = [](int count) {
    std::string text = "fr 1\n6d " + std::to_string(count) + " ";
    for (int i = 0; i < count; ++i) text += "[" + std::to_string(i) + " 1.000][0 0 0 0 0 0]" + kIdentity + " ";
    return text;
  };
  EXPECT_TRUE(parse_dtrack(packet(64)));
  EXPECT_FALSE(parse_dtrack(packet(65)));
}

TEST(Dtrack, RefusesWhatContradictsItself) {
  const std::string body = "[0 1.000][1 2 3 0 0 0]" + kIdentity;
  for (const std::string& bad : std::vector<std::string>{
           "",
           "\n\n",
           "6d 0\n",
           "fr\n",
           "fr x\n",
           "fr -1\n",
           "fr 1 2\n",
           "fr 99999999999\n",
           "fr 1\n6d 2 " + body,                                            // fewer than it says
           "fr 1\n6d 1 " + body + body,                                     // more bodies than announced
           "fr 1\n6d 1 [-1 1.000][1 2 3 0 0 0]" + kIdentity,                // negative body number
           "fr 1\n6d 1 [64 1.000][1 2 3 0 0 0]" + kIdentity,                // and beyond the last
           "fr 1\n6d 1 [0 1.000][1 nan 3 0 0 0]" + kIdentity,               // NaN
           "fr 1\n6d 1 [0 inf][1 2 3 0 0 0]" + kIdentity,                   //
           "fr 1\n6d 1 [0 1.000][1 2 3 0 0 0][1 0 0 0 1 0 0 0 -1]",         // reflection
           "fr 1\n6d 1 [0 1.000][1 2 3 0 0 0][2 0 0 0 1 0 0 0 1]",          // stretched
           "fr 1\n6d 1 [0 1.000][1 2 3 0 0 0][1 0 0 0 1 0 0 0",             // cut off
           "fr 1\n6df2 1 1 [0 1.000 99 2][1 2 3]" + kIdentity + "[0 0 0]",  // 99 buttons
           "fr 1\n6df2 1 1 [0 1.000 4 9][1 2 3]" + kIdentity + "[0 0 0 0 0 0 0 0 0 0]",
           "fr 1\n6df2 1 1 [0 1.000 4 2][1 2 3]" + kIdentity + "[0 0.5]",  // one joystick value missing
       }) {
    EXPECT_FALSE(parse_dtrack(bad)) << bad;
  }
}

TEST(Dtrack, KeepsTheJoystickWithinItsRange) {
  const auto frame = parse_dtrack("fr 1\n6df2 1 1 [0 1.0 4 2][0 0 0]" + kIdentity + "[1 7.5 -3]");
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->flystick(0)->joystick[0], 1.0);
  EXPECT_EQ(frame->flystick(0)->joystick[1], -1.0);
}

}  // namespace dtrack_test
}  // namespace afm::input
