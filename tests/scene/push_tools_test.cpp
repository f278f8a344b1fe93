// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/push_tools.h"

#include <gmock/gmock.h>

#include <memory>
#include <string>

#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/level_choice.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/particle_blocks.h"
#include "support/places.h"

namespace push_tools_test {

using namespace afm;
using scene::PushTool;
using testing::HasSubstr;
using Why = scene::ToolRefusal::Why;

scene::ParticleSet particle_set(const std::string& name) {
  return scene::load_particle_set(support::source("assets/particles/" + name + ".toml")).value();
}

std::unique_ptr<scene::SharedParticles> shared(const std::string& name) {
  return std::make_unique<scene::SharedParticles>(scene::shared_particles(particle_set(name)));
}

TEST(PushTools, AreThoseOfTheSetUntilTheOtherIsHeld) {
  const auto gold = shared("gold-row");
  const auto gripped = std::make_unique<scene::SharedParticles>(*gold);
  scene::hold(PushTool::Push, *gripped);
  EXPECT_EQ(*gripped, *gold) << "the tool of the set";
  scene::hold(PushTool::Grip, *gripped);
  EXPECT_TRUE(scene::has_hold(*gripped));
  EXPECT_TRUE(scene::validate(*gripped));
  EXPECT_EQ(scene::own_tool(scene::push_setup(*gripped)), PushTool::Grip);
  scene::hold(PushTool::Push, *gripped);
  EXPECT_EQ(*gripped, *gold);

  const auto picks = shared("pick-and-place");
  EXPECT_EQ(scene::own_tool(scene::push_setup(*picks)), PushTool::Grip);
  EXPECT_TRUE(scene::has_lift(*picks));
  EXPECT_FALSE(scene::tool_refusal(*picks, PushTool::Push));
  scene::hold(PushTool::Push, *picks);
  EXPECT_FALSE(scene::has_hold(*picks));
  EXPECT_FALSE(scene::has_lift(*picks));
}

TEST(PushTools, AreRefusedWithTheReason) {
  const auto why = [](const scene::SharedParticles& particles, PushTool tool) {
    return scene::tool_refusal(particles, tool).value().why;
  };
  EXPECT_FALSE(scene::tool_refusal(*shared("gold-row"), PushTool::Grip));
  EXPECT_EQ(why(*shared("scratch-pmma"), PushTool::Grip), Why::Marks);
  EXPECT_EQ(why(*shared("write-ink"), PushTool::Grip), Why::Marks);
  EXPECT_EQ(why(*shared("islands"), PushTool::Grip), Why::NoAdhesion);
  EXPECT_EQ(why(*shared("tube-and-electrodes"), PushTool::Grip), Why::NoAdhesion);
  const auto old = shared("gold-row");
  ASSERT_TRUE(scene::set_level({.level = 1}, *old));
  EXPECT_EQ(why(*old, PushTool::Grip), Why::Picture);
  EXPECT_FALSE(scene::tool_refusal(*old, PushTool::Push)) << "in use";
  const auto soft = shared("gold-row");
  soft->pusher.contact_stiffness_n_per_m = 0.3;
  const auto refused = scene::tool_refusal(*soft, PushTool::Grip);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->why, Why::Lever);
  EXPECT_THAT(refused->text, HasSubstr("is too soft for spheres that stick to the tip"));
}

// So that a picture of a recording has words and sources whichever tool was used.
TEST(PushTools, LeaveASetOfTheAssetsKnown) {
  const auto gold = shared("gold-row");
  scene::hold(PushTool::Grip, *gold);
  const scene::ParticleSet known = scene::recorded_set(*gold, support::source("assets"));
  EXPECT_EQ(known.title, particle_set("gold-row").title);
  EXPECT_TRUE(known.setup.species.front().sticks);
  EXPECT_EQ(scene::shared_particles(known), *gold);
}

}  // namespace push_tools_test
