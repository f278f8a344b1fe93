// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/push_values.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <memory>
#include <string>

#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/adjusted_set.h"
#include "scene/samples/level_choice.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/shared_segment.h"
#include "support/places.h"

namespace push_values_test {

using namespace afm;
using scene::PushSetting;
using scene::PushSettings;
using scene::PushTool;
using testing::HasSubstr;
using Why = scene::PushRefusal::Why;

scene::ParticleSet particle_set(const std::string& name) {
  return scene::load_particle_set(support::source("assets/particles/" + name + ".toml")).value();
}

std::unique_ptr<scene::SharedParticles> shared(const std::string& name) {
  return std::make_unique<scene::SharedParticles>(scene::shared_particles(particle_set(name)));
}

TEST(PushValues, OfAToolAreThoseOfTheSetUntilTheOtherIsHeld) {
  const auto gold = shared("gold-row");
  const auto gripped = std::make_unique<scene::SharedParticles>(*gold);
  scene::adjust({.tool = PushTool::Push}, *gripped);
  EXPECT_EQ(*gripped, *gold) << "the tool of the set";
  scene::adjust({.tool = PushTool::Grip}, *gripped);
  EXPECT_TRUE(scene::has_hold(*gripped));
  EXPECT_TRUE(scene::validate(*gripped));
  EXPECT_EQ(scene::own_tool(scene::push_setup(*gripped)), PushTool::Grip);
  scene::adjust({.tool = PushTool::Push}, *gripped);
  EXPECT_EQ(*gripped, *gold);

  const auto picks = shared("pick-and-place");
  EXPECT_EQ(scene::own_tool(scene::push_setup(*picks)), PushTool::Grip);
  EXPECT_TRUE(scene::has_lift(*picks));
  EXPECT_FALSE(scene::refusal(*picks, {.tool = PushTool::Push}));
  scene::adjust({.tool = PushTool::Push}, *picks);
  EXPECT_FALSE(scene::has_hold(*picks));
  EXPECT_FALSE(scene::has_lift(*picks));
}

TEST(PushValues, AreRefusedWithTheReason) {
  const auto why = [](const scene::SharedParticles& particles, PushTool tool) {
    return scene::refusal(particles, {.tool = tool}).value().why;
  };
  EXPECT_FALSE(scene::refusal(*shared("gold-row"), {.tool = PushTool::Grip}));
  EXPECT_EQ(why(*shared("scratch-pmma"), PushTool::Grip), Why::Marks);
  EXPECT_EQ(why(*shared("write-ink"), PushTool::Grip), Why::Marks);
  EXPECT_EQ(why(*shared("islands"), PushTool::Grip), Why::NoAdhesion);
  EXPECT_EQ(why(*shared("tube-and-electrodes"), PushTool::Grip), Why::NoAdhesion);
  const auto old = shared("gold-row");
  ASSERT_TRUE(scene::set_level({.level = 1}, *old));
  for (const PushTool tool : {PushTool::Push, PushTool::Grip}) EXPECT_FALSE(scene::refusal(*old, {.tool = tool}));
  const auto soft = shared("gold-row");
  soft->pusher.contact_stiffness_n_per_m = 0.3;
  const auto refused = scene::refusal(*soft, {.tool = PushTool::Grip});
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->why, Why::Lever);
  EXPECT_THAT(refused->text, HasSubstr("is too soft for spheres that stick to the tip"));
}

// Each setting changes only its own numbers, and its first value changes none.
TEST(PushValues, ChangeTheirOwnNumbersAlone) {
  const auto gold = shared("gold-row");
  const auto with = [&](PushSetting setting, std::uint16_t value) {
    auto particles = std::make_unique<scene::SharedParticles>(*gold);
    scene::adjust(scene::with({}, setting, value), *particles);
    EXPECT_EQ(scene::differs(*gold, setting, value), *particles != *gold) << scene::text_of(setting, value);
    return particles;
  };
  for (const scene::PushSettingText& row : scene::kPushSettings) EXPECT_EQ(*with(row.setting, 0), *gold) << row.name;
  EXPECT_EQ(*with(PushSetting::Lever, 2), *gold) << "1 N/m, as in the set";

  auto wanted = std::make_unique<scene::SharedParticles>(*gold);
  wanted->pusher.normal_spring_n_per_m = 40.0;
  wanted->pusher.lateral_spring_n_per_m = 400.0;
  EXPECT_EQ(*with(PushSetting::Lever, 4), *wanted);
  *wanted = *gold;
  wanted->pusher.tip_radius_m = 20e-9;
  EXPECT_EQ(*with(PushSetting::Tip, 3), *wanted);
  *wanted = *gold;
  wanted->species[0].law = physics::ParticleLaw::Amontons;
  EXPECT_EQ(*with(PushSetting::Law, 2), *wanted);
  *wanted = *gold;
  wanted->level.level = 2;
  EXPECT_EQ(*with(PushSetting::Level, 3), *wanted);
  *wanted = *gold;
  wanted->level = {.level = 1, .seed = 7, .since_ns = 8};
  scene::adjust({.level = 3}, *wanted);
  EXPECT_EQ(wanted->level, (scene::SharedLevel{.level = 2, .seed = 7})) << "another level: its drift begins anew";
  // 4 pi R gamma of a meniscus is 1.92 times the pull-off, as in N08
  *wanted = *gold;
  const auto humid = with(PushSetting::Medium, 1);
  EXPECT_NEAR(humid->species[0].work_of_adhesion_j_per_m2, (1.0 + 1.92) * 0.1, 1e-12);
  EXPECT_NEAR(humid->species[0].tip_adhesion_j_per_m2, 0.02 + 0.192, 1e-12);
  wanted->species[0].work_of_adhesion_j_per_m2 = humid->species[0].work_of_adhesion_j_per_m2;
  wanted->species[0].tip_adhesion_j_per_m2 = humid->species[0].tip_adhesion_j_per_m2;
  EXPECT_EQ(*humid, *wanted);
  EXPECT_NEAR(with(PushSetting::Medium, 2)->species[0].work_of_adhesion_j_per_m2, 0.02, 1e-15);
}

TEST(PushValues, AreRefusedWithTheirOwnReasons) {
  const auto refused = [](const scene::SharedParticles& particles, const PushSettings& settings) {
    return scene::refusal(particles, settings).value();
  };
  const auto gold = shared("gold-row");
  for (const scene::PushSettingText& row : scene::kPushSettings) {
    for (std::uint16_t value = 0; value < row.values; ++value) {
      const PushSettings settings = scene::with({}, row.setting, value);
      EXPECT_TRUE(scene::is_valid(settings));
      const bool measured = row.setting == PushSetting::Law && value == 4;
      EXPECT_EQ(scene::refusal(*gold, settings).has_value(), measured) << scene::text_of(row.setting, value);
    }
    EXPECT_FALSE(scene::is_valid(scene::with({}, row.setting, row.values))) << row.name;
  }
  EXPECT_EQ(refused(*gold, {.law = 4}).why, Why::NoNumbers);
  EXPECT_THAT(refused(*gold, {.law = 4}).text, HasSubstr("no numbers for the friction law measured"));
  const auto old = shared("gold-row");
  ASSERT_TRUE(scene::set_level({.level = 2}, *old));
  EXPECT_FALSE(scene::refusal(*old, {.medium = 1}));
  // no picture where the tip lifts or turns the particles
  EXPECT_EQ(refused(*shared("islands"), {.level = 2}).why, Why::Picture);
  EXPECT_THAT(refused(*shared("islands"), {.level = 2}).text, HasSubstr("no level 1: only spheres and rods"));
  const auto lifts = shared("pick-and-place");
  EXPECT_THAT(refused(*lifts, {.level = 3}).text, HasSubstr("no level 2: the tip lifts these spheres"));
  EXPECT_FALSE(scene::refusal(*lifts, {.tool = PushTool::Push, .level = 3}));
  EXPECT_EQ(refused(*shared("write-ink"), {.lever = 1}).why, Why::Marks);
  // half a tip's radius is the smallest sphere
  const auto small = shared("gold-row");
  small->species[0].radius_m = 15e-9;
  EXPECT_EQ(refused(*small, {.tip = 4}).why, Why::Lever);
  EXPECT_FALSE(scene::differs(*shared("islands"), PushSetting::Law, 2));
  EXPECT_FALSE(scene::differs(*shared("tube-and-electrodes"), PushSetting::Medium, 1));
}

// Pictures of recordings need words and sources for all settings.
TEST(PushValues, LeaveASetOfTheAssetsKnown) {
  const PushSettings used{.tool = PushTool::Grip, .law = 2, .lever = 4, .tip = 3, .medium = 1};
  for (const char* name : {"gold-row", "pick-and-place"}) {
    const scene::ParticleSet set = particle_set(name);
    for (const PushSettings& settings : {PushSettings{}, PushSettings{.tip = 1}, used}) {
      const auto recorded = shared(name);
      scene::adjust(settings, *recorded);
      const scene::ParticleSet known = scene::recorded_set(*recorded, support::source("assets"));
      EXPECT_EQ(known.title, set.title);
      EXPECT_EQ(known.medium, settings.medium == 0 ? set.medium : "humid air");
      EXPECT_EQ(scene::shared_particles(known), *recorded);
    }
  }
}

// A number that was chosen is not sourced as the one of the file.
TEST(PushValues, HaveSourcesOfTheirOwn) {
  const scene::ParticleSet set = particle_set("pick-and-place");
  const scene::ParticleSet water = scene::adjusted(set, {.lever = 4, .tip = 1, .medium = 2});
  const auto source = [](const auto& sources, const char* key) { return *scene::find_source(sources, key); };
  EXPECT_EQ(source(water.sources, "normal_spring").value, "40 N/m");
  EXPECT_EQ(source(water.sources, "tip_radius").value, "5 nm");
  for (const char* key : {"lateral_spring", "normal_spring", "tip_radius", "pad_1_work_of_adhesion"}) {
    EXPECT_THAT(source(water.sources, key).source, HasSubstr("chosen here")) << key;
    EXPECT_TRUE(source(water.sources, key).estimated) << key;
  }
  EXPECT_THAT(source(water.species[0].sources, "work_of_adhesion").source, HasSubstr("a fifth"));
  EXPECT_EQ(source(water.species[0].sources, "radius").source, source(set.species[0].sources, "radius").source);
}

// The thresholds that a user meets follow the settings.
TEST(PushValues, MoveTheLimitsOfAPush) {
  const scene::ParticleSet set = particle_set("gold-row");
  scene::AdjustedSet adjusted(set);
  EXPECT_EQ(&adjusted.set(), &set);
  const scene::PushLimits before = adjusted.limits().front();
  EXPECT_NEAR(before.gentle.si, 6.786430504e-11, 1e-16) << "N24";
  EXPECT_NEAR(before.softest.si, 0.00282, 1e-5) << "N26";
  adjusted.use({.law = 2});
  const scene::PushLimits by_amontons = adjusted.limits().front();
  EXPECT_GT(by_amontons.gentle.si, 10.0 * before.gentle.si);
  EXPECT_GT(by_amontons.softest.si, 10.0 * before.softest.si);
  adjusted.use({.tip = 4});
  EXPECT_NE(adjusted.limits().front().softest, before.softest);
  adjusted.use({});
  EXPECT_EQ(adjusted.limits().front().gentle, before.gentle);
}

}  // namespace push_values_test
