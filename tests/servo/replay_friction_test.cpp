// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "servo/recorded_servo.h"
#include "servo/session_file.h"
#include "servo/session_friction.h"
#include "support/paper_model.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_friction_test {

using scene::TipSample;

TEST(Replay, GivesTheFrictionAgain) {
  for (const auto law :
       {physics::FrictionLaw::Amontons, physics::FrictionLaw::ContactArea, physics::FrictionLaw::Lattice}) {
    auto model = test::paper_model();
    scene::SharedContact& mica = model.materials[test::kMica];
    mica.law = physics::Law::Dmt;
    mica.contact.reduced_modulus = physics::Pressure(5.15e10);
    mica.friction = {.law = law,
                     .lattice = physics::LatticeKind::Hexagonal,
                     .coefficient = 0.1,
                     .shear_strength = physics::Pressure(1e8),
                     .period = physics::Length(0.52e-9),
                     .corrugation = physics::Length(5e-12),
                     .lateral_stiffness = physics::Stiffness(1.0)};
    Recording recording(model);
    recording.choose(test::kMica);
    recording.arm();
    recording.aim(-0.006, 0.5);
    recording.run(800);
    recording.aim(-0.006, 0.4, false, 0.020);
    recording.run(600);
    recording.aim(0.065, 0.7);
    recording.run(900);
    const support::ScratchFolder folder;
    const std::string path = folder.file("friction.afms");
    ASSERT_TRUE(save_session(recording.sessions.front(), path));
    const auto loaded = load_session(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    double strongest = 0.0;
    for (const TipSample& sample : loaded->samples) {
      strongest = std::max(strongest, std::hypot(sample.lateral_force_n[0], sample.lateral_force_n[1]));
    }
    EXPECT_GT(strongest, 1e-11);
    expect_same(*loaded);
  }
}

// Half width, offset and slope of a loop that the hand drew, within 1 % of what the numbers of the material say.
TEST(SessionFriction, IsMeasuredFromARecording) {
  auto model = test::paper_model();
  scene::SharedContact& mica = model.materials[test::kMica];
  mica.law = physics::Law::Dmt;
  mica.contact.reduced_modulus = physics::Pressure(5.15e10);
  mica.friction.law = physics::FrictionLaw::Amontons;
  mica.friction.coefficient = 0.1;
  mica.friction.lateral_stiffness = physics::Stiffness(1.0);
  Recording recording(model);
  recording.choose(test::kMica);
  recording.arm();
  recording.aim(-0.006, 0.5);
  recording.run(1200);
  for (const double x : {0.020, -0.020, 0.020, -0.020}) {
    recording.aim(-0.006, 0.8, false, x);
    recording.run(1100);
  }
  const RecordedSession& session = recording.sessions.front();
  const auto loop = friction_loop(session);
  ASSERT_TRUE(loop);
  const double load_n = session.samples.back().tip.force_n + 4.0 * M_PI * 50e-9 * 2.228e-3;
  EXPECT_NEAR(loop->half_width.si, 0.1 * load_n, 0.01 * 0.1 * load_n);
  EXPECT_NEAR(loop->offset.si, 0.0, 0.01 * 0.1 * load_n);
  EXPECT_NEAR(loop->slope.si, 1.0, 0.01);

  RecordedSession without = session;
  for (TipSample& sample : without.samples) sample.lateral_force_n = {};
  EXPECT_FALSE(friction_loop(without));
  without.samples.clear();
  EXPECT_FALSE(friction_loop(without));
}

}  // namespace replay_friction_test
}  // namespace afm::servo
