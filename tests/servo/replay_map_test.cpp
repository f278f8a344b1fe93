// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/whole_file.h"
#include "haptics/law_family.h"
#include "scene/shared/map_vibration.h"
#include "servo/recorded_servo.h"
#include "servo/session_file.h"
#include "support/deep.h"
#include "support/paper_model.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_map_test {

using scene::TipSample;

// Mica's place with a rubber whose modulus and adhesion rise from left to right.
scene::SharedModel model_with_map() {
  scene::SharedModel model = test::paper_model();
  scene::SharedContact& rubber = model.materials[test::kMica];
  rubber.law = physics::Law::Jkr;
  rubber.law_map = 1;
  rubber.contact.tip_radius = physics::Length(30e-9);
  rubber.contact.spring_constant = physics::Stiffness(0.2);
  rubber.contact = haptics::contact_with(rubber.contact, physics::Pressure(2e6), 40e-3);
  scene::SharedLawMap& map = model.law_map;
  map.columns = 32;
  map.rows = 24;
  map.spacing_m = 10e-9;
  for (std::uint32_t cell = 0; cell < map.columns * map.rows; ++cell) {
    const double share = 0.5 - 0.5 * std::cos(M_PI * (cell % map.columns) / (map.columns - 1.0));
    map.ln_modulus[cell] = static_cast<float>(std::log(1e6) + share * std::log(4.0));
    map.adhesion_j_per_m2[cell] = static_cast<float>(30e-3 + 30e-3 * share);
  }
  return model;
}

// Presses the tip on it and slides to the right.
RecordedSession slid(bool viscous = false, scene::MapVibration vibration = scene::MapVibration::None) {
  scene::SharedModel model = model_with_map();
  model.materials[test::kMica].viscous_map = viscous ? 1 : 0;
  model.materials[test::kMica].map_vibration = vibration;
  Recording recording(model);
  recording.choose(test::kMica);
  recording.arm();
  recording.aim(-0.012, 0.6);
  recording.run(800);
  recording.aim(-0.012, 0.5, false, 0.030);
  recording.run(700);
  recording.aim(0.065, 0.7);
  recording.run(900);
  return recording.sessions.front();
}

TEST(ReplayOfAMap, GivesEveryBitAgain) {
  RecordedSession session = slid();
  session.force_map = {
      .file = "/data/\"rubber\".h5", .digest = "0123456789abcdef", .reading = R"({"fit":"jkr"})", .pixel = {3, 2}};
  EXPECT_NE(session.find(physics::EventKind::JumpToContact), nullptr);
  EXPECT_NE(session.find(physics::EventKind::JumpOffContact), nullptr);
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(session, folder.file("map.afms")));
  const auto loaded = load_session(folder.file("map.afms"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(loaded->law_map);
  EXPECT_EQ(loaded->parameters.law_map, 1U);
  EXPECT_EQ(loaded->law_map->spacing_m, 10e-9);
  EXPECT_EQ(loaded->force_map, session.force_map);
  EXPECT_EQ(loaded->law_map->ln_modulus, model_with_map().law_map.ln_modulus);
  EXPECT_EQ(loaded->law_map->adhesion_j_per_m2, model_with_map().law_map.adhesion_j_per_m2);
  expect_same(*loaded);
}

TEST(ReplayOfAMap, GivesTheDampingOfAViscousOneAgain) {
  RecordedSession session = slid(true);
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(session, folder.file("viscous.afms")));
  EXPECT_EQ(core::read_file(folder.file("viscous.afms"))->at(4), 18) << "the version";
  const auto loaded = load_session(folder.file("viscous.afms"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->parameters.viscous_map, 1U);
  expect_same(*loaded);
  session.parameters.viscous_map = 0;
  const auto undamped = replay(session);
  ASSERT_TRUE(undamped) << undamped.error().message;
  EXPECT_FALSE(undamped->identical()) << "the damping is not felt";
}

TEST(ReplayOfAMap, GivesEveryVibrationAgain) {
  using scene::MapVibration;
  const support::ScratchFolder folder;
  for (const MapVibration quantity :
       {MapVibration::Modulus, MapVibration::Adhesion, MapVibration::Loss, MapVibration::Collision}) {
    if (!support::deep() && quantity != MapVibration::Loss) continue;
    RecordedSession session = slid(quantity == MapVibration::Loss, quantity);
    ASSERT_TRUE(save_session(session, folder.file("vibrating.afms")));
    EXPECT_EQ(core::read_file(folder.file("vibrating.afms"))->at(4), 20) << "the version";
    const auto loaded = load_session(folder.file("vibrating.afms"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->parameters.map_vibration, quantity);
    EXPECT_EQ(loaded->parameters.viscous_map, quantity == MapVibration::Loss ? 1U : 0U);
    EXPECT_EQ(loaded->device.max_vibration_n, 0.1);
    expect_same(*loaded);
    session.device.max_vibration_n = 0.0;
    const auto still = replay(session);
    ASSERT_TRUE(still) << still.error().message;
    EXPECT_FALSE(still->identical()) << "the vibration is not felt: " << scene::text_of(quantity).word;
  }
}

TEST(ReplayOfAMap, NoticesAnotherMap) {
  RecordedSession session = slid();
  auto other = std::make_shared<scene::SharedLawMap>(*session.law_map);
  for (float& ln_modulus : other->ln_modulus) ln_modulus += 0.05F;
  session.law_map = other;
  const auto replayed = replay(session);
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_FALSE(replayed->identical());
}

TEST(ReplayOfAMap, RefusesAFileWhoseMapCannotBe) {
  const RecordedSession session = slid();
  const support::ScratchFolder folder;
  const auto refusal = [&](const RecordedSession& wrong) {
    EXPECT_TRUE(save_session(wrong, folder.file("wrong.afms")));
    const auto loaded = load_session(folder.file("wrong.afms"));
    return loaded ? std::string("accepted") : loaded.error().message;
  };
  const auto with = [&](const auto& change) {
    RecordedSession wrong = session;
    auto map = std::make_shared<scene::SharedLawMap>(*session.law_map);
    change(*map);
    wrong.law_map = map;
    return wrong;
  };
  EXPECT_EQ(refusal(session), "accepted");
  EXPECT_THAT(refusal(with([](auto& map) { map.ln_modulus[5] = std::nanf(""); })),
              testing::HasSubstr("its map of modulus and adhesion is not a grid of such values"));
  EXPECT_THAT(refusal(with([](auto& map) { map.adhesion_j_per_m2[5] = -1.0F; })),
              testing::HasSubstr("is not a grid of such values"));
  EXPECT_THAT(refusal(with([](auto& map) { map.spacing_m = 0.0; })), testing::HasSubstr("is not a grid"));
  RecordedSession mapless = session;
  mapless.law_map = nullptr;
  EXPECT_THAT(refusal(mapless), testing::HasSubstr("its content is that of another version"));
  RecordedSession lawless = session;
  lawless.parameters.law_map = 0;
  EXPECT_THAT(refusal(lawless), testing::HasSubstr("its content is that of another version"));
}

}  // namespace replay_map_test
}  // namespace afm::servo
