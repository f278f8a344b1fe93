// SPDX-License-Identifier: Apache-2.0
// Invariant: every tracker packet is parsed or refused
#include "input/dtrack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <iterator>
#include <string>
#include <vector>

#include "support/places.h"
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

TEST(Dtrack, ReadsSixtyFourBodiesAndLeavesOutWhatHasNoNumber) {
  const auto packet = [](int count) {
    std::string text = "fr 1\n6d " + std::to_string(count) + " ";
    for (int i = 0; i < count; ++i) text += "[" + std::to_string(i) + " 1.000][0 0 0 0 0 0]" + kIdentity + " ";
    return text;
  };
  EXPECT_EQ(parse_dtrack(packet(64))->body_count, 64U);
  EXPECT_EQ(parse_dtrack(packet(64))->faults.count, 0U);
  EXPECT_EQ(parse_dtrack(packet(67))->body_count, 64U);
  EXPECT_EQ(parse_dtrack(packet(67))->faults.count, 3U);
}

// A datagram recorded for the research.
std::string datagram(const std::string& name) {
  std::ifstream file(support::source("tests/fuzz/corpus/dtrack/" + name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const glm::dvec3 kHead(0.120, -2.400, 1.660), kHand(0.300, -1.500, 1.200);

void expect_at(const DtrackBody* body, const glm::dvec3& place_m) {
  ASSERT_NE(body, nullptr);
  EXPECT_TRUE(body->tracked);
  EXPECT_LT(glm::distance(body->position_m, place_m), 1e-9);
}

TEST(Dtrack, ReadsAHybridBodyOfDtrack3) {
  const auto frame = parse_dtrack(datagram("hybrid-head-6di"));
  ASSERT_TRUE(frame);
  expect_at(frame->body(0), kHead);
  expect_at(&frame->flystick(0)->body, kHand);
  EXPECT_EQ(frame->faults.count, 0U);
  const auto lost =
      parse_dtrack("fr 1\n6di 1 [0 0 0.000][0 0 0][0 0 0 0 0 0 0 0 0]\n6d 1 [0 1][1 2 3 0 0 0]" + kIdentity);
  expect_at(lost->body(0), {0.001, 0.002, 0.003});
  EXPECT_EQ(lost->body_count, 1U) << "once, by the line that has a pose";
  EXPECT_EQ(lost->faults.count, 0U);
}

TEST(Dtrack, ReadsTheFirstFlystickWithItsHatSwitch) {
  const auto frame = parse_dtrack(datagram("flystick1-6df"));
  ASSERT_TRUE(frame);
  expect_at(frame->body(0), kHead);
  expect_at(&frame->flystick(0)->body, kHand);
  EXPECT_EQ(frame->flystick(0)->buttons, 1U);
  const auto hat = [](unsigned buttons) {
    const auto f = parse_dtrack("fr 1\n6df 1 [3 1.0 " + std::to_string(buttons) + "][0 0 0 0 0 0]" + kIdentity);
    return std::pair(f->flystick(3)->joystick[0], f->flystick(3)->joystick[1]);
  };
  EXPECT_EQ(hat(0x20), std::pair(-1.0, 0.0));
  EXPECT_EQ(hat(0x80), std::pair(1.0, 0.0));
  EXPECT_EQ(hat(0x10), std::pair(0.0, -1.0));
  EXPECT_EQ(hat(0x42), std::pair(0.0, 1.0));
}

struct BadBody {
  std::string body;
  std::string_view reason;
};

// Bad bodies, each with a good head in the same line and a good Flystick in the next one.
TEST(Dtrack, LeavesOutOnlyTheBodyThatCannotBeRead) {
  const std::string matrix(kIdentity), pose = "[1 2 3 0 0 0]";
  for (const BadBody& bad : std::vector<BadBody>{
           {"[4 1.000][0 0 0 0 0 0][0 0 0 0 0 0 0 0 0]", "its matrix is not a rotation"},
           {"[4 1.000]" + pose + "[2 0 0 0 1 0 0 0 1]", "its matrix is not a rotation"},
           {"[4 1.000]" + pose + "[1 0 0 0.1 1 0 0 0 1]", "its matrix is not a rotation"},
           {"[4 1.000]" + pose + "[1 0 0 0 1 0 0 0 -1]", "its matrix is a reflection"},
           {"[4 1.000]" + pose + "[1 0 0 0 nan 0 0 0 1]", "its rotation matrix does not consist of nine numbers"},
           {"[4 1.000]" + pose + "[]", "its rotation matrix does not consist of nine numbers"},
           {"[4 1.000][1 nan 3 0 0 0]" + matrix, "its position does not consist of numbers"},
           {"[4 1.000][inf 2 3 0 0 0]" + matrix, "its position does not consist of numbers"},
           {"[4 1.000][]" + matrix, "its position does not consist of numbers"},
           {"[64 1.000]" + pose + matrix, "its number is not one of 0 to 63"},
           {"[-1 1.000]" + pose + matrix, "its number is not one of 0 to 63"},
           {"[4 nan]" + pose + matrix, "its quality is not a number"},
           {"[4 1.000" + pose + matrix, "it is incomplete"},
           {"[4 1.000]" + pose + "[1 0 0 0 1 0 0 0 1", "it is incomplete"},
       }) {
    const std::string good = "[0 1.000][120 -2400 1660 0 0 0]" + matrix;
    for (const std::string& line : {good + " " + bad.body, bad.body + " " + good}) {
      const auto frame =
          parse_dtrack("fr 1\n6d 2 " + line + "\n6df2 1 1 [0 1 4 2][300 -1500 1200]" + matrix + "[1 0 0]\n");
      ASSERT_TRUE(frame) << line;
      expect_at(frame->body(0), kHead);
      EXPECT_EQ(frame->body(4), nullptr) << line;
      expect_at(&frame->flystick(0)->body, kHand);
      ASSERT_EQ(frame->faults.count, 1U) << line;
      const DtrackFault& fault = frame->faults.first[0];
      EXPECT_EQ(fault.line, "6d");
      EXPECT_EQ(fault.subject, "body");
      EXPECT_EQ(fault.reason, bad.reason) << line;
      EXPECT_EQ(std::string(fault.text.data()).substr(0, 2), bad.body.substr(0, 2));
    }
  }
}

TEST(Dtrack, LeavesOutOnlyTheFlystickThatCannotBeRead) {
  const auto stick = [](int id) {
    return "[" + std::to_string(id) + " 1 4 2][300 -1500 1200]" + kIdentity + "[1 0 0]";
  };
  std::string ten = "fr 1\n6df2 10 10 ";
  for (int i = 0; i < 10; ++i) ten += stick(i);
  EXPECT_EQ(parse_dtrack(ten)->flystick_count, 10U);
  for (const std::string& bad : std::vector<std::string>{
           "[1 1 99 2][1 2 3]" + kIdentity + "[0 0 0]", "[1 1 4 9][1 2 3]" + kIdentity + "[0 0 0]",
           "[1 1 4 2][1 2 3]" + kIdentity + "[0 0]", "[1 1 4 2][1 2 3][0 0 0 0 0 0 0 0 0][0 0 0]"}) {
    const auto frame = parse_dtrack("fr 1\n6df2 2 2 " + bad + " " + stick(0));
    ASSERT_TRUE(frame) << bad;
    expect_at(&frame->flystick(0)->body, kHand);
    EXPECT_EQ(frame->flystick(1), nullptr);
    EXPECT_EQ(frame->faults.count, 1U);
  }
}

TEST(Dtrack, LeavesOutALineThatContradictsItsCountAndKeepsTheOthers) {
  const std::string body = "[0 1.000][1 2 3 0 0 0]" + kIdentity;
  const std::string stick = "\n6df2 1 1 [0 1 4 2][300 -1500 1200]" + kIdentity + "[1 0 0]";
  for (const std::string& line :
       std::vector<std::string>{"6d 2 " + body, "6d 1 " + body + body, "6d 4000000000 " + body, "6d x " + body,
                                "6d -1 " + body, "ts2 1 2 x"}) {
    const auto frame = parse_dtrack("fr 1\n" + line + stick);
    ASSERT_TRUE(frame) << line;
    EXPECT_EQ(frame->body_count, 0U) << line;
    expect_at(&frame->flystick(0)->body, kHand);
    ASSERT_EQ(frame->faults.count, 1U) << line;
    EXPECT_EQ(frame->faults.first[0].subject, "");
    EXPECT_EQ(frame->latency_us, 0U);
  }
}

TEST(Dtrack, LosesOneBodyOfZerosOrWithoutANumberAndNotTheHead) {
  for (const char* name : {"one-body-of-zeros", "body-64"}) {
    const auto frame = parse_dtrack(datagram(name));
    ASSERT_TRUE(frame) << name;
    expect_at(frame->body(0), kHead);
    expect_at(&frame->flystick(0)->body, kHand);
    EXPECT_EQ(frame->faults.count, 1U);
  }
}

TEST(Dtrack, NamesWhatAPacketLacks) {
  DtrackFaults faults;
  EXPECT_FALSE(parse_dtrack("<html>\x1b[2J", &faults));
  ASSERT_EQ(faults.count, 1U);
  EXPECT_EQ(faults.first[0].reason, "it has no line \"fr NUMBER\"");
  EXPECT_STREQ(faults.first[0].text.data(), "<html>?[2J");
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
           "fr 1\n6d 2 " + body,                                            // fewer bodies than announced
           "fr 1\n6d 1 " + body + body,                                     // more bodies than announced
           "fr 1\n6d 1 [-1 1.000][1 2 3 0 0 0]" + kIdentity,                // negative body number
           "fr 1\n6d 1 [64 1.000][1 2 3 0 0 0]" + kIdentity,                // body number beyond the last
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
