// SPDX-License-Identifier: Apache-2.0
// Invariant: every HID report is parsed or refused
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "input/dualsense.h"
#include "input/hid_catalog.h"
#include "input/hid_mapping.h"
#include "input/joycon.h"
#include "input/psmove.h"
#include "input/spacemouse.h"
#include "input/wand.h"
#include "input/wiimote.h"
#include "support/hex_report.h"
#include "support/places.h"
#include "support/stereo_cases.h"

namespace afm::input {
namespace hid_parsers_test {

using test::from_hex;
using test::Report;
constexpr double kRadPerDegree = std::numbers::pi / 180.0;

// ---- the rows hid_* of the research's test vectors ----

struct Row {
  std::string convention;
  Report report;
  std::vector<long> expected;
};

std::vector<Row> hid_rows() {
  std::vector<Row> rows;
  for (const test::StereoCase& row : test::stereo_cases("hid")) {
    rows.push_back({row.convention, from_hex(row.input), {row.expected.begin(), row.expected.end()}});
  }
  return rows;
}

std::vector<long> parsed(const Row& row) {
  const auto refused = std::vector<long>{-1};
  if (row.convention.rfind("spacemouse", 0) == 0) {
    const auto report = parse_spacemouse(row.report);
    if (!report) return refused;
    std::vector<long> values{row.report[0]};
    for (const auto& triple : {report->translation, report->rotation}) {
      if (triple) values.insert(values.end(), triple->begin(), triple->end());
    }
    if (report->buttons) values.push_back(static_cast<long>(*report->buttons));
    return values;
  }
  if (row.convention.rfind("wiimote", 0) == 0) {
    const auto report = parse_wiimote(row.report);
    return report ? std::vector<long>{report->buttons} : refused;
  }
  const auto report = parse_dualsense(row.report);
  if (!report) return refused;
  const DualSenseReport& r = *report;
  return {r.left_stick[0],   r.left_stick[1],   r.right_stick[0],  r.right_stick[1],
          r.triggers[0],     r.triggers[1],     r.sequence,        r.buttons[0] & 15,
          r.buttons[0] >> 4, r.gyro[0],         r.gyro[1],         r.gyro[2],
          r.acceleration[0], r.acceleration[1], r.acceleration[2], static_cast<long>(r.ticks)};
}

TEST(ResearchVectors, OfHidReportsAreReadAsTheySay) {
  const std::vector<Row> rows = hid_rows();
  ASSERT_EQ(rows.size(), 6U);
  for (const Row& row : rows) EXPECT_EQ(parsed(row), row.expected) << row.convention;
}

// ---- SpaceMouse ----

TEST(SpaceMouse, OfTheWirelessKindSaysAllSixAxesInOneReport) {
  const auto report = parse_spacemouse(from_hex("01 5e 01 a2 fe 10 00 f4 ff 00 00 5d 01"));
  ASSERT_TRUE(report && report->translation && report->rotation);
  EXPECT_EQ(*report->translation, (std::array<std::int16_t, 3>{350, -350, 16}));
  EXPECT_EQ(*report->rotation, (std::array<std::int16_t, 3>{-12, 0, 349}));
}

TEST(SpaceMouse, RefusesReportsOfAnyOtherLength) {
  for (const std::size_t size : {0U, 1U, 2U, 6U, 8U, 12U}) {
    Report report(size, 0);
    if (size > 0) report[0] = 1;
    EXPECT_FALSE(parse_spacemouse(report)) << size;
    if (size > 0) report[0] = 2;
    EXPECT_FALSE(parse_spacemouse(report)) << size;
  }
  EXPECT_FALSE(parse_spacemouse(from_hex("03")));
  EXPECT_FALSE(parse_spacemouse(from_hex("17 00 00 00 00 00 00")));
}

TEST(SpaceMouse, MovesThingsAlongTheRoomsAxes) {
  const auto driver = spacemouse_driver();
  // pushed to the right, towards the user, and pressed down
  const auto push = driver->read(from_hex("01 5e 01 5e 01 5e 01"));
  ASSERT_TRUE(push && push->push);
  EXPECT_EQ(*push->push, glm::dvec3(1.0, -1.0, 1.0));
  // beyond the nominal stop
  EXPECT_EQ(*driver->read(from_hex("02 f4 01 00 00 00 00"))->turn, glm::dvec3(1.0, 0.0, 0.0));
}

TEST(SpaceMouse, HasAMeaningForEveryButton) {
  const auto driver = spacemouse_driver();
  EXPECT_EQ(driver->read(from_hex("03 01 00"))->buttons, bit(WandButton::Select));
  EXPECT_EQ(driver->read(from_hex("03 02 00"))->buttons, bit(WandButton::Grab));
  EXPECT_EQ(driver->read(from_hex("03 03 00"))->buttons, bit(WandButton::Scale));
  EXPECT_EQ(driver->read(from_hex("03 04 00"))->buttons, bit(WandButton::Home));
  EXPECT_EQ(driver->read(from_hex("03 00 00"))->buttons, 0U);
}

// ---- Wii Remote ----

TEST(WiiRemote, SaysWhichWayIsUpInTenBits) {
  // flat on a table: x and y at rest, z at one g, 512 + 104 = 616 = 154 * 4
  const auto report = parse_wiimote(from_hex("31 00 00 80 80 9a"));
  ASSERT_TRUE(report && report->acceleration);
  EXPECT_EQ(*report->acceleration, (std::array<std::uint16_t, 3>{512, 512, 616}));
  // the low bits are among the buttons
  const auto fine = parse_wiimote(from_hex("31 60 60 80 80 9a"));
  EXPECT_EQ(*fine->acceleration, (std::array<std::uint16_t, 3>{515, 514, 618}));
  EXPECT_EQ(fine->buttons, 0U);
}

TEST(WiiRemote, SeesDotsInBothLayouts) {
  // x = 0x2a1, y = 0x1b2
  const auto extended = parse_wiimote(from_hex("33 00 00 80 80 9a a1 b2 65 ff ff ff ff ff ff ff ff ff"));
  ASSERT_TRUE(extended && extended->dots[0]);
  EXPECT_EQ(extended->dots[0]->x, 0x2a1);
  EXPECT_EQ(extended->dots[0]->y, 0x1b2);
  EXPECT_FALSE(extended->dots[1] || extended->dots[2] || extended->dots[3]);
  const auto basic = parse_wiimote(from_hex("37 00 00 80 80 9a a1 b2 65 11 22 ff ff ff ff ff 00 00 00 00 00 00"));
  ASSERT_TRUE(basic && basic->dots[0] && basic->dots[1]);
  EXPECT_EQ(basic->dots[0]->x, 0x2a1);
  EXPECT_EQ(basic->dots[0]->y, 0x1b2);
  EXPECT_EQ(basic->dots[1]->x, 0x111);
  EXPECT_EQ(basic->dots[1]->y, 0x122);
  EXPECT_FALSE(basic->dots[2] || basic->dots[3]);
}

TEST(WiiRemote, RefusesShortReports) {
  for (const int id : {0x30, 0x31, 0x33, 0x37}) {
    const std::size_t whole = id == 0x30 ? 3 : id == 0x31 ? 6 : id == 0x33 ? 18 : 22;
    Report report(whole, 0);
    report[0] = static_cast<std::uint8_t>(id);
    EXPECT_TRUE(parse_wiimote(report)) << id;
    report.pop_back();
    EXPECT_FALSE(parse_wiimote(report)) << id;
  }
}

// ---- Joy-Con ----

Report joycon_report() {
  Report report(49, 0);
  report[0] = 0x30;
  report[3] = 0x08;  // A
  report[5] = 0x04;  // right arrow
  for (const std::size_t stick : {6U, 9U}) {
    report[stick] = 0x00;
    report[stick + 1] = 0x08;  // x = 0x800
    report[stick + 2] = 0x80;  // y = 0x800
  }
  for (std::size_t i = 0; i < 3; ++i) {
    report[13 + 12 * i + 5] = 0x10;  // 4096 along its z
    report[19 + 12 * i + 4] = 100;   // 100 about its z
  }
  return report;
}

TEST(JoyCon, SaysThreeReadingsAReportAndWhichWayIsUp) {
  const auto left = joycon_driver(JoyConSide::Left)->read(joycon_report());
  ASSERT_TRUE(left);
  EXPECT_EQ(left->imu_count, 3U);
  EXPECT_NEAR(left->imu[2].acceleration_g.y, 1.0, 1e-12);
  EXPECT_NEAR(left->imu[2].rate_rad_per_s.y, 100.0 / 14.247 * kRadPerDegree, 1e-12);
  EXPECT_NEAR(glm::length(*left->push), 0.0, 1e-12);
  EXPECT_EQ(left->buttons, bit(WandButton::Select));
  // the right one's sensor is mounted upside down
  const auto right = joycon_driver(JoyConSide::Right)->read(joycon_report());
  EXPECT_NEAR(right->imu[0].acceleration_g.y, -1.0, 1e-12);
  EXPECT_EQ(right->buttons, bit(WandButton::Select));
}

TEST(JoyCon, RefusesOtherReports) {
  Report report = joycon_report();
  report.pop_back();
  EXPECT_FALSE(parse_joycon(report));
  report.push_back(0);
  report[0] = 0x3f;
  EXPECT_FALSE(parse_joycon(report));
}

// ---- a device of one's own ----

HidMapping mapping_of_a_stick() {
  HidMapping mapping;
  mapping.name = "stick";
  mapping.vendor = 0x1234;
  mapping.product = 0x5678;
  mapping.axes.push_back({.quantity = HidMapping::Quantity::Push,
                          .axis = 0,
                          .report = 1,
                          .byte = 1,
                          .bit = 4,
                          .bits = 12,
                          .is_signed = false,
                          .center = 2048,
                          .scale = -2047,
                          .dead_zone = 0.1});
  mapping.buttons.push_back({.button = WandButton::Grab, .report = 1, .byte = 3, .bit = 7});
  return mapping;
}

TEST(MappedWand, ReadsTwelveBitsAcrossTwoBytesTurnedRoundWithADeadZone) {
  const auto driver = mapped_driver(mapping_of_a_stick());
  EXPECT_TRUE(driver->steered());
  EXPECT_EQ(driver->read(from_hex("01 f0 ff 80"))->push->x, -1.0);
  EXPECT_EQ(driver->read(from_hex("01 f0 ff 80"))->buttons, bit(WandButton::Grab));
  EXPECT_EQ(driver->read(from_hex("01 00 80 00"))->push->x, 0.0);
  EXPECT_EQ(driver->read(from_hex("01 00 88 00"))->push->x, 0.0) << "within the dead zone";
  EXPECT_NEAR(driver->read(from_hex("01 10 00 00"))->push->x, 1.0, 1e-12);
}

TEST(MappedWand, ReadsSignedNumbers) {
  HidMapping mapping = mapping_of_a_stick();
  mapping.axes[0] = {.quantity = HidMapping::Quantity::Turn,
                     .axis = 2,
                     .report = 0,
                     .byte = 0,
                     .bit = 0,
                     .bits = 16,
                     .is_signed = true,
                     .center = 0,
                     .scale = 350,
                     .dead_zone = 0};
  mapping.buttons.clear();
  EXPECT_EQ(mapped_driver(mapping)->read(from_hex("a2 fe"))->turn->z, -1.0);
  EXPECT_NEAR(mapped_driver(mapping)->read(from_hex("af 00"))->turn->z, 0.5, 1e-12);
}

TEST(MappedWand, RefusesShortAndForeignReports) {
  const auto driver = mapped_driver(mapping_of_a_stick());
  EXPECT_FALSE(driver->read(from_hex("01 f0 ff")));
  EXPECT_FALSE(driver->read(from_hex("02 f0 ff 80")));
  EXPECT_FALSE(driver->read({}));
}

// ---- recognition of devices ----

TEST(Catalog, KnowsWandsAndWhatOnlyLooksLikeOne) {
  EXPECT_TRUE(identify({0x046d, 0xc626, 1, 8}, {})->make);
  EXPECT_TRUE(identify({0x256f, 0xc635, 1, 8}, {})->make);
  EXPECT_FALSE(identify({0x256f, 0xc652, 1, 2}, {})->make) << "the mouse in a receiver";
  constexpr std::array<std::uint16_t, 7> kMice{0xc650, 0xc651, 0xc653, 0xc658, 0xc664, 0xc665, 0xc668};
  for (const std::uint16_t mouse : kMice) {
    const auto known = identify({0x256f, mouse, 1, 2}, {});
    ASSERT_TRUE(known) << mouse;
    EXPECT_FALSE(known->make) << mouse;
  }
  EXPECT_TRUE(identify({0x256f, 0xc699, 1, 8}, {})->make) << "a cap that is built later";
  EXPECT_FALSE(identify({0x256f, 0xc699, 1, 2}, {}));
  EXPECT_FALSE(identify({0x1234, 0x5678, 1, 4}, {}));
  const std::vector<HidMapping> mappings{mapping_of_a_stick()};
  EXPECT_EQ(identify({0x1234, 0x5678, 1, 4}, mappings)->name, "stick");
}

// The rules' keys are those of USB (idVendor) or of the HID core (KERNELS=="*:vendor:product.*"), with * for the rest.
bool is_readable(const std::string& rules, const HidModel& model) {
  const std::string vendor = fmt::format("ATTRS{{idVendor}}==\"{:04x}\", ", model.vendor);
  return rules.find(fmt::format("KERNELS==\"*:{:04X}:{:04X}.*\"", model.vendor, model.product)) != std::string::npos ||
         rules.find(vendor + "TAG") != std::string::npos ||
         rules.find(fmt::format("{}ATTRS{{idProduct}}==\"{:02x}*\"", vendor, model.product >> 8)) != std::string::npos;
}

TEST(Catalog, EveryWandIsInTheUdevRules) {
  std::ifstream file(support::source("assets/wands/70-touchafm-wands.rules"));
  const std::string rules{std::istreambuf_iterator<char>(file), {}};
  for (const HidModel& model : hid_models()) {
    EXPECT_TRUE(model.make == nullptr || is_readable(rules, model)) << model.name;
  }
}

TEST(Catalog, NamesEachDeviceOnce) {
  std::set<std::pair<std::uint16_t, std::uint16_t>> seen;
  for (const HidModel& model : hid_models()) {
    EXPECT_TRUE(seen.emplace(model.vendor, model.product).second) << model.name;
  }
}

TEST(EveryDriver, SurvivesWhateverBytesComeAndStaysFinite) {
  std::vector<std::unique_ptr<HidDriver>> drivers;
  std::set<std::unique_ptr<HidDriver> (*)()> makers;
  for (const HidModel& model : hid_models()) {
    if (model.make != nullptr && makers.insert(model.make).second) drivers.push_back(model.make());
  }
  ASSERT_GE(drivers.size(), 8U);
  drivers.push_back(mapped_driver(mapping_of_a_stick()));
  std::mt19937 random(11);
  int taken = 0;
  for (int i = 0; i < 20'000; ++i) {
    Report report(random() % 90);
    for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(random());
    constexpr std::array<std::uint8_t, 9> kNumbers{0x01, 0x02, 0x03, 0x30, 0x31, 0x33, 0x37, 0x10, 0x05};
    if (!report.empty()) report[0] = kNumbers[random() % kNumbers.size()];
    for (const auto& driver : drivers) {
      const auto input = driver->read(report);
      if (!input) continue;
      ++taken;
      EXPECT_LE(glm::length(input->push.value_or(glm::dvec3(0.0))), std::sqrt(3.0) + 1e-12);
      for (std::size_t k = 0; k < input->imu_count; ++k) {
        EXPECT_TRUE(std::isfinite(glm::length(input->imu[k].rate_rad_per_s)));
      }
    }
  }
  EXPECT_GT(taken, 1000);
}

}  // namespace hid_parsers_test
}  // namespace afm::input
