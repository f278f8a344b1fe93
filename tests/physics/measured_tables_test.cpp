// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "physics/force_model.h"
#include "physics/law_tables.h"

namespace afm::physics {
namespace measured_tables_test {

using namespace literals;
using testing::HasSubstr;

const ContactParameters kMica{50_nm, 0.1_N_per_m, Stiffness(std::numeric_limits<double>::infinity()), 24.5_zJ,
                              2.228_mJ_per_m2};

struct Recording {
  std::vector<MeasuredPoint> approach;
  std::vector<MeasuredPoint> retract;
};

// What an instrument would record of the paper's mica, every 0.05 nm from -5 to 25 nm, through a drift that lifts the
// whole curve a little.
Recording recording_of_mica() {
  const auto tables = build_law_tables(Law::Paper, kMica);
  Recording recording;
  for (int i = 0; i <= 600; ++i) {
    const Length z(-5e-9 + 0.05e-9 * i);
    const Force drift(1e-13 * std::sin(0.1 * i));
    const auto at = [&](Length jump) { return (z <= jump ? tables->attached : tables->free).force(z) + drift; };
    recording.approach.push_back({z, at(tables->figures.z_jtc)});
    recording.retract.push_back({z, at(tables->figures.z_joc)});
  }
  return recording;
}

TEST(MeasuredTables, JumpWhereTheRecordingDoes) {
  const Recording recording = recording_of_mica();
  const auto tables = measured_law_tables(recording.approach, recording.retract, kMica);
  const CycleFigures expected = build_law_tables(Law::Paper, kMica)->figures;
  const CycleFigures& figures = tables->figures;
  EXPECT_EQ(tables->law, Law::Measured);
  EXPECT_NEAR(figures.z_jtc.si, expected.z_jtc.si, 0.05e-9);
  EXPECT_NEAR(figures.z_joc.si, expected.z_joc.si, 0.05e-9);
  EXPECT_NEAR(figures.force_before_joc / expected.force_before_joc, 1.0, 0.005);
  EXPECT_NEAR(figures.force_after_jtc / expected.force_after_jtc, 1.0, 0.05);
  EXPECT_NEAR(figures.loop_energy / expected.loop_energy, 1.0, 0.01);
}

TEST(MeasuredTables, PassThroughThePoints) {
  const Recording recording = recording_of_mica();
  const auto tables = measured_law_tables(recording.approach, recording.retract, kMica);
  std::size_t free = 0, attached = 0;
  for (const MeasuredPoint& point : recording.approach) {
    if (point.z < tables->figures.z_jtc) continue;
    ++free;
    EXPECT_NEAR(tables->free.force(point.z).si, point.force.si, 2e-14);
  }
  for (const MeasuredPoint& point : recording.retract) {
    if (point.z > tables->figures.z_joc) continue;
    ++attached;
    EXPECT_NEAR(tables->attached.force(point.z).si, point.force.si, 2e-14);
  }
  EXPECT_GT(free, recording.approach.size() / 4);
  EXPECT_GT(attached, recording.retract.size() / 4);
}

// A node at the end of a branch may lie beyond it by a rounding error.
TEST(MeasuredTables, TakeNothingFromBesideTheirPoints) {
  const MeasuredPoint poison{Length(0), Force(std::nan(""))};
  for (int i = 0; i < 200; ++i) {
    Recording recording = recording_of_mica();
    for (auto* branch : {&recording.approach, &recording.retract}) {
      for (MeasuredPoint& point : *branch) point.z = (1.0 + 1e-4 * i) * point.z;
      branch->insert(branch->begin(), poison);
      branch->push_back(poison);
    }
    const auto inside = [](const std::vector<MeasuredPoint>& all) { return std::span(all).subspan(1, all.size() - 2); };
    const auto approach = inside(recording.approach), retract = inside(recording.retract);
    const auto tables = measured_law_tables(approach, retract, kMica);
    EXPECT_TRUE(isfinite(tables->attached.force(retract.front().z))) << i;
    EXPECT_TRUE(isfinite(tables->free.force(approach.back().z))) << i;
  }
}

TEST(MeasuredTables, DriveTheLatch) {
  const Recording recording = recording_of_mica();
  ApproachRetractModel model(measured_law_tables(recording.approach, recording.retract, kMica));
  EXPECT_EQ(model.step(5_nm).phase, Phase::WaitForLift);
  EXPECT_EQ(model.step(20_nm).phase, Phase::Free);
  EXPECT_EQ(model.step(1_nm).events[0].kind, EventKind::JumpToContact);
  EXPECT_NEAR(model.step(10_nm).force.si, -1e-9, 1e-12);
  EXPECT_EQ(model.step(20_nm).events[0].kind, EventKind::JumpOffContact);
}

std::string refusal(std::span<const MeasuredPoint> approach, std::span<const MeasuredPoint> retract) {
  try {
    measured_law_tables(approach, retract, kMica);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeasuredTables, RefuseWhatCannotBeFelt) {
  const Recording good = recording_of_mica();
  EXPECT_THAT(refusal({}, good.retract), HasSubstr("the approach of the curve has 0 points; it needs 8 to 65536"));
  Recording bad = good;
  bad.retract[17].force = Force(std::nan(""));
  EXPECT_THAT(refusal(good.approach, bad.retract), HasSubstr("point 18 of the curve's retract is not finite"));
  bad = good;
  std::swap(bad.approach[3], bad.approach[4]);
  EXPECT_THAT(refusal(bad.approach, good.retract), HasSubstr("does not lie above the one before"));
  // the branches in each other's place, and one branch twice
  EXPECT_THAT(refusal(good.retract, good.approach), HasSubstr("the curve has no loop that could be felt"));
  EXPECT_THAT(refusal(good.approach, good.approach), HasSubstr("no loop"));
}

TEST(MeasuredTables, NeedALever) {
  const Recording good = recording_of_mica();
  ContactParameters none = kMica;
  none.spring_constant = Stiffness();
  EXPECT_THROW(measured_law_tables(good.approach, good.retract, none), UnphysicalValue);
}

}  // namespace measured_tables_test
}  // namespace afm::physics
