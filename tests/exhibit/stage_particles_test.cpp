// SPDX-License-Identifier: Apache-2.0
// Invariant: every machine draws particles where the servo has them
#include "exhibit/scenery/stage_particles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <vector>

#include "exhibit/models/user_models.h"
#include "exhibit/scenery/lines_on_sample.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/state/lines_to_write.h"
#include "physics/manipulation/tip_contact.h"
#include "scene/samples/particle_set.h"
#include "servo/live_picture.h"
#include "support/paper_wall.h"
#include "support/particles/particle_sets.h"

// Particles on the wall, where the servo has them.
namespace afm::exhibit {
namespace stage_particles_test {

class ParticlesOfAWall : public test::PaperWall {
 protected:
  WallScene wall_of(const scene::ParticleSet& set) const {
    UserModels own;
    own.particles = std::make_shared<const scene::ParticleSet>(set);
    return WallScene::load(assets_, materials_, stage_place(wall_), test::english(), own).value();
  }
  static render::FrameState frame(const WallScene& wall, const ParticlesNow* now) {
    render::FrameState frame;
    wall.update({.material = 0, .particles = now}, frame);
    return frame;
  }
  // Centre of a drawn particle in the sample's frame, in metres of the nanoworld.
  static glm::dvec3 centre_m(const WallScene& wall, const render::FrameState& frame, std::size_t particle) {
    const render::MeshCopies& spheres = frame.copies.front();
    const glm::dvec3 room(frame.room_from_node[spheres.node] * glm::dvec4(spheres.copies[particle].place, 1.0));
    const glm::dmat4 sample_from_room = glm::inverse(frame.room_from_node[wall.sample_node()]);
    return glm::dvec3(sample_from_room * glm::dvec4(room, 1.0)) * wall.unit_m() * wall.drawn_scale(0).sample_m_per_m;
  }
  static bool shown(const WallScene& wall, const render::FrameState& frame, const char* name) {
    return frame.visible[wall.scene().find_node(name).value()] != 0;
  }

  scene::ParticleSet set_ = test::particle_set("gold-row");
};

TEST_F(ParticlesOfAWall, LinesToBeWrittenAreDotsFromCornerToCorner) {
  const LinesToWrite lines{.lines_m = {{{-80e-9, 40e-9}, {80e-9, 40e-9}}, {{0.0, 40e-9}, {0.0, -80e-9}}},
                           .width_m = 20e-9};
  const WallScene wall = wall_of(test::particle_set("scratch-pmma"));
  render::FrameState drawn = frame(wall, nullptr);
  const std::size_t before = drawn.copies.size();
  add_lines(lines, wall, drawn);
  ASSERT_EQ(drawn.copies.size(), before + 1);
  const render::MeshCopies dots = drawn.copies.back();
  EXPECT_EQ(dots.node, wall.scene().find_node("plan-line/dot").value());
  EXPECT_EQ(dots.copies.size(), 14U + 11U) << "every 12 nm";
  EXPECT_LE(dots.copies.size(), wall.scene().nodes[dots.node].most_copies);
  drawn.copies = {dots};
  const glm::dvec3 first_m = centre_m(wall, drawn, 0), last_m = centre_m(wall, drawn, 24);
  EXPECT_LT(glm::distance(glm::dvec2(first_m), glm::dvec2(-80e-9, 40e-9)), 1e-11);
  EXPECT_LT(glm::distance(glm::dvec2(last_m), glm::dvec2(0.0, -80e-9)), 1e-11);
  add_lines({.lines_m = std::vector(20, lines.lines_m[0]), .width_m = 1e-9}, wall, drawn);
  EXPECT_EQ(drawn.copies.back().copies.size(), wall.scene().nodes[dots.node].most_copies) << "more are left out";
}

TEST_F(ParticlesOfAWall, LieAtTheirStartWithTheSizeOfTheScaleLine) {
  for (const char* name : {"gold-row", "latex-letter"}) {
    const scene::ParticleSet set = test::particle_set(name);
    const WallScene wall = wall_of(set);
    const render::FrameState drawn = frame(wall, nullptr);
    ASSERT_EQ(drawn.copies.size(), 2U) << "particles and targets";
    ASSERT_EQ(drawn.copies.front().copies.size(), set.particles.size());
    EXPECT_EQ(wall.scene().nodes[drawn.copies.front().node].most_copies, set.particles.size());
    const std::vector<scene::ParticlePage> pages = test::start_pages(set);
    // all of them on the drawn sample
    const double half_m = 0.5 * kNarrowestSample * kStrokeHeight * wall.unit_m() * wall.drawn_scale(0).sample_m_per_m;
    for (std::size_t i = 0; i < set.particles.size(); ++i) {
      const double radius_m = set.setup.species[set.particles[i].species].contact.tip_radius.si;
      const scene::ParticlePose pose = pages[i / scene::kPosesPerPage].poses[i % scene::kPosesPerPage];
      const glm::dvec3 there(pose.x_m, pose.y_m, radius_m);
      EXPECT_LT(std::max(std::abs(there.x), std::abs(there.y)) + radius_m, half_m) << name;
      EXPECT_LT(glm::distance(centre_m(wall, drawn, i), there), 1e-3 * radius_m) << name << " " << i;
      const double drawn_radius_m = static_cast<double>(drawn.copies.front().copies[i].scale) * wall.unit_m() *
                                    wall.drawn_scale(0).sample_m_per_m;
      EXPECT_NEAR(drawn_radius_m, radius_m, 1e-5 * radius_m);
    }
    // whatever the parameters of the material
    EXPECT_EQ(wall.drawn_scale(0, 40e-9).sample_m_per_m, wall.drawn_scale(0).sample_m_per_m);
    EXPECT_EQ(wall.drawn_scale(1).sample_m_per_m, wall.drawn_scale(0).sample_m_per_m);
  }
}

TEST_F(ParticlesOfAWall, FollowThePosesOfTheServo) {
  const WallScene wall = wall_of(set_);
  std::vector<scene::ParticlePage> pages = test::start_pages(set_);
  pages[0].poses[1].x_m = 77e-9;
  pages[0].poses[1].y_m = -33e-9;
  pages[0].poses[1].orientation = {0.5, 0.5, -0.5, 0.5};
  const ParticlesNow now{.set = &set_, .pages = pages};
  const render::FrameState moved = frame(wall, &now), before = frame(wall, nullptr);
  EXPECT_LT(glm::distance(centre_m(wall, moved, 1), glm::dvec3(77e-9, -33e-9, 25e-9)), 0.1e-9);
  EXPECT_EQ(moved.copies[0].copies[1].turn, glm::vec4(0.5F, -0.5F, 0.5F, 0.5F)) << "w comes last";
  for (const std::size_t other : {0U, 2U, 3U, 4U}) {
    EXPECT_EQ(moved.copies[0].copies[other], before.copies[0].copies[other]) << other;
  }
}

// Apart without colour: none, many small or a few large dots around them.
TEST_F(ParticlesOfAWall, ShowWhetherTheirPlaceWasMeasured) {
  using servo::Known;
  const WallScene wall = wall_of(set_);
  const std::vector<scene::ParticlePage> pages = test::start_pages(set_);
  servo::PictureNow picture{.level = 2, .known = std::vector<Known>(set_.particles.size(), Known::Measured)};
  const ParticlesNow now{.set = &set_, .pages = pages, .picture = &picture};
  const auto node = wall.scene().find_node("doubts/dot").value();
  const auto dots = [&](const render::FrameState& drawn) {
    const auto found = std::find_if(drawn.copies.begin(), drawn.copies.end(),
                                    [&](const render::MeshCopies& copies) { return copies.node == node; });
    return found == drawn.copies.end() ? std::vector<render::MeshCopy>{} : found->copies;
  };
  const render::FrameState measured = frame(wall, &now);
  EXPECT_TRUE(dots(measured).empty());
  picture.known[1] = Known::Computed;
  const std::vector<render::MeshCopy> computed = dots(frame(wall, &now));
  EXPECT_EQ(computed.size(), 12U);
  picture.known[1] = Known::Stale;
  const render::FrameState old = frame(wall, &now);
  const std::vector<render::MeshCopy> stale = dots(old);
  ASSERT_EQ(stale.size(), 4U);
  EXPECT_GT(stale[0].scale, 2.0F * computed[0].scale);
  EXPECT_LT(old.copies[0].copies[1].tint.g, 0.5F * measured.copies[0].copies[1].tint.g);
  picture.known.assign(set_.particles.size(), Known::Computed);
  EXPECT_LE(dots(frame(wall, &now)).size(), wall.scene().nodes[node].most_copies);
}

TEST_F(ParticlesOfAWall, LieAmongTheCrossesOfTheirPattern) {
  const WallScene wall = wall_of(set_);
  const render::FrameState drawn = frame(wall, nullptr);
  const render::MeshCopies& crosses = drawn.copies.at(1);
  EXPECT_EQ(crosses.node, wall.scene().find_node("targets/target"));
  const auto targets = scene::shared_targets(set_);
  ASSERT_EQ(crosses.copies.size(), targets.size());
  const double scale = wall.unit_m() * wall.drawn_scale(0).sample_m_per_m;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    EXPECT_NEAR(scale * static_cast<double>(crosses.copies[i].place.x), targets[i].position.x.si, 0.1e-9);
    EXPECT_NEAR(scale * static_cast<double>(crosses.copies[i].place.y), targets[i].position.y.si, 0.1e-9);
  }
  set_.targets.clear();
  EXPECT_EQ(frame(wall_of(set_), nullptr).copies.size(), 1U);
}

TEST_F(ParticlesOfAWall, HaveAFootprintWhereTheyLayAndDotsFromThere) {
  const WallScene wall = wall_of(set_);
  std::vector<scene::ParticlePage> pages = test::start_pages(set_);
  const ParticlesNow at_start{.set = &set_, .pages = pages};
  EXPECT_EQ(frame(wall, &at_start).copies.size(), 2U) << "none has moved";
  const glm::dvec2 start_m(pages[0].poses[2].x_m, pages[0].poses[2].y_m), way_m(60e-9, -25e-9);
  pages[0].poses[1].x_m += 4e-9;  // displacement too small for its width to show
  pages[0].poses[2].x_m += way_m.x;
  pages[0].poses[2].y_m += way_m.y;
  const ParticlesNow now{.set = &set_, .pages = pages};
  const render::FrameState moved = frame(wall, &now);
  ASSERT_EQ(moved.copies.size(), 4U);
  const render::MeshCopies& footprints = moved.copies[2];
  const render::MeshCopies& dots = moved.copies[3];
  EXPECT_EQ(footprints.node, wall.scene().find_node("footprints/footprint"));
  EXPECT_EQ(dots.node, wall.scene().find_node("ways/dot"));
  ASSERT_EQ(footprints.copies.size(), 1U);
  const double scale = wall.unit_m() * wall.drawn_scale(0).sample_m_per_m;
  const glm::dvec2 foot_m = scale * glm::dvec2(footprints.copies[0].place);
  EXPECT_LT(glm::distance(foot_m, start_m), 0.1e-9);
  // 65 nm, five gaps of about half a radius
  EXPECT_EQ(dots.copies.size(), 4U);
  double last_m = 0.0;
  for (const render::MeshCopy& dot : dots.copies) {
    const glm::dvec2 from_start_m = scale * glm::dvec2(dot.place) - start_m;
    EXPECT_GT(glm::length(from_start_m), last_m);
    EXPECT_NEAR(from_start_m.x * way_m.y, from_start_m.y * way_m.x, 1e-18);
    last_m = glm::length(from_start_m);
  }
  EXPECT_LT(last_m, glm::length(way_m));
  pages[0].poses[2].x_m += 1.0;  // displacement as large as in a damaged session
  EXPECT_LE(frame(wall, &now).copies[3].copies.size(), wall.scene().nodes[dots.node].most_copies);
}

TEST_F(ParticlesOfAWall, HaveALineAndRingsWhereAPushIsPlanned) {
  const WallScene wall = wall_of(set_);
  std::vector<scene::ParticlePage> pages = test::start_pages(set_);
  const glm::dvec2 from_m(pages[0].poses[3].x_m, pages[0].poses[3].y_m), to_m = from_m + glm::dvec2(90e-9, -40e-9);
  pages[0].poses[3].x_m += 3e-9;
  ParticlesNow now{.set = &set_, .pages = pages};
  now.plan = {.from_m = {from_m.x, from_m.y}, .to_m = {to_m.x, to_m.y}, .particle = 3};
  const render::FrameState drawn = frame(wall, &now);
  ASSERT_EQ(drawn.copies.size(), 4U) << "particles, targets, and the plan";
  const render::MeshCopies& line = drawn.copies[2];
  const render::MeshCopies& ends = drawn.copies[3];
  EXPECT_EQ(line.node, wall.scene().find_node("plan-line/dot"));
  EXPECT_EQ(ends.node, wall.scene().find_node("plan-ends/footprint"));
  const double scale = wall.unit_m() * wall.drawn_scale(0).sample_m_per_m;
  const auto place_m = [&](const render::MeshCopy& copy) { return scale * glm::dvec2(copy.place); };
  EXPECT_LT(glm::distance(place_m(line.copies.front()), from_m), 0.1e-9);
  EXPECT_LT(glm::distance(place_m(line.copies.back()), to_m), 0.1e-9);
  EXPECT_EQ(line.copies.size(), 14U) << "98 nm, gaps of at least 0.3 radii";
  ASSERT_EQ(ends.copies.size(), 2U);
  EXPECT_LT(glm::distance(place_m(ends.copies[0]), from_m + glm::dvec2(3e-9, 0.0)), 0.1e-9) << "around the sphere";
  EXPECT_LT(glm::distance(place_m(ends.copies[1]), to_m), 0.1e-9);
  now.plan.to_m[0] = 1e-3;  // largest length of a plan
  EXPECT_LE(frame(wall, &now).copies[2].copies.size(), wall.scene().nodes[line.node].most_copies);
  now.plan.particle = 77;  // number on another wall
  EXPECT_EQ(frame(wall, &now).copies.size(), 2U);
}

TEST_F(ParticlesOfAWall, MarkTheTouchedOneWithARingAroundIt) {
  const WallScene wall = wall_of(set_);
  const std::vector<scene::ParticlePage> pages = test::start_pages(set_);
  ParticlesNow now{.set = &set_, .pages = pages};
  EXPECT_FALSE(shown(wall, frame(wall, &now), "touched-particle/ring"));
  now.push = test::push_of(set_, 3, physics::PushState::Holds);
  const render::FrameState touching = frame(wall, &now);
  EXPECT_TRUE(shown(wall, touching, "touched-particle/ring"));
  const scene::NodeIndex ring = wall.scene().find_node("touched-particle/ring").value();
  const render::MeshCopies& spheres = touching.copies.front();
  const glm::dvec3 foot(touching.room_from_node[spheres.node] *
                        glm::dvec4(glm::vec2(spheres.copies[3].place), 0.0, 1.0));
  EXPECT_LT(glm::distance(glm::dvec3(touching.room_from_node[ring][3]), foot), 1e-6);
  EXPECT_NE(spheres.copies[3].tint, spheres.copies[2].tint);
}

TEST_F(ParticlesOfAWall, AreRodsThatLieAsTheServoHasThem) {
  const scene::ParticleSet set = test::particle_set("tube-and-electrodes");
  const WallScene wall = wall_of(set);
  std::vector<scene::ParticlePage> pages = test::start_pages(set);
  scene::set_turn(pages[0].poses[0], physics::half_turn(1.0));
  pages[0].poses[0].x_m = 30e-9;
  ParticlesNow now{.set = &set, .pages = pages};
  const render::FrameState drawn = frame(wall, &now), before = frame(wall, nullptr);
  const render::MeshCopies& rods = drawn.copies.front();
  EXPECT_EQ(rods.node, wall.scene().find_node("rods-0/rod"));
  ASSERT_EQ(rods.copies.size(), 1U);
  EXPECT_NEAR(rods.copies[0].turn.z, std::sin(0.5), 1e-6);
  EXPECT_NEAR(rods.copies[0].turn.w, std::cos(0.5), 1e-6);
  EXPECT_NEAR(before.copies.front().copies[0].turn.z, std::sin(0.5 * set.particles[0].angle_rad), 1e-6);
  const auto mesh = wall.scene().nodes[rods.node].mesh.value();
  float longest = 0.0F, widest = 0.0F;
  for (const auto& vertex : wall.scene().meshes[mesh].primitives.front().vertices) {
    longest = std::max(longest, std::abs(vertex.position.x));
    widest = std::max(widest, std::abs(vertex.position.y));
  }
  EXPECT_NEAR(longest, 26.0F, 1e-4F) << "half of 1 um and the round end, in radii of 20 nm";
  EXPECT_NEAR(widest, 1.0F, 1e-6F);
  // a cross on each wanted end, and two pads
  EXPECT_EQ(before.copies.at(1).copies.size(), 2U);
  EXPECT_EQ(before.copies.at(2).node, wall.scene().find_node("pads-0/pad"));
  EXPECT_EQ(before.copies.at(3).node, wall.scene().find_node("pads-1/pad"));
  // the ring is where the tip is, not at the middle
  now.push = test::push_of(set, 0, physics::PushState::Slides);
  const glm::dvec2 end_m = glm::dvec2(30e-9, pages[0].poses[0].y_m) + 400e-9 * glm::dvec2(std::cos(1.0), std::sin(1.0));
  now.push.apex_m = {end_m.x + 50e-9 * std::sin(1.0), end_m.y - 50e-9 * std::cos(1.0), 0.0};
  const render::FrameState touched = frame(wall, &now);
  const scene::NodeIndex ring = wall.scene().find_node("touched-particle/ring").value();
  const glm::dvec3 room(touched.room_from_node[ring][3]);
  const glm::dvec3 there =
      glm::dvec3(glm::inverse(touched.room_from_node[wall.sample_node()]) * glm::dvec4(room, 1.0)) * wall.unit_m() *
      wall.drawn_scale(0).sample_m_per_m;
  EXPECT_LT(glm::distance(glm::dvec2(there), end_m), 0.1e-9);
}

TEST_F(ParticlesOfAWall, AreIslandsWhoseMarksShowTheirTurns) {
  const scene::ParticleSet set = test::particle_set("islands");
  const WallScene wall = wall_of(set);
  std::vector<scene::ParticlePage> pages = test::start_pages(set);
  scene::set_turn(pages[0].poses[1], physics::half_turn(-0.7));
  ParticlesNow now{.set = &set, .pages = pages};
  const render::FrameState drawn = frame(wall, &now);
  const render::MeshCopies& islands = drawn.copies.front();
  EXPECT_EQ(islands.node, wall.scene().find_node("islands-0/island"));
  ASSERT_EQ(islands.copies.size(), 3U);
  EXPECT_NEAR(islands.copies[1].turn.z, std::sin(-0.35), 1e-6);
  EXPECT_NEAR(islands.copies[0].turn.z, 0.0, 1e-6);
  float widest = 0.0F, highest = 0.0F;
  std::size_t dark_ahead = 0, dark_behind = 0;
  const auto mesh = wall.scene().nodes[islands.node].mesh.value();
  for (const auto& vertex : wall.scene().meshes[mesh].primitives.front().vertices) {
    widest = std::max(widest, std::hypot(vertex.position.x, vertex.position.y));
    highest = std::max(highest, std::abs(vertex.position.z));
    if (vertex.color.x < 0.9F && vertex.position.x > 0.5F) ++dark_ahead;
    if (vertex.color.x < 0.9F && vertex.position.x < -0.5F) ++dark_behind;
  }
  EXPECT_NEAR(widest, 97.7F / 25.0F, 1e-4F) << "in halves of the height";
  EXPECT_NEAR(highest, 1.0F, 1e-6F);
  EXPECT_GT(dark_ahead, 10U);
  EXPECT_EQ(dark_behind, 0U);
  // the ring is around the whole island
  now.push = test::push_of(set, 0, physics::PushState::Slides);
  const render::FrameState touched = frame(wall, &now);
  const glm::dmat4& ring = touched.room_from_node[wall.scene().find_node("touched-particle/ring").value()];
  const render::MeshCopy& copy = touched.copies.front().copies[0];
  EXPECT_NEAR(glm::length(glm::dvec3(ring[0])) / glm::length(glm::dvec3(touched.room_from_node[islands.node][0])),
              static_cast<double>(copy.scale) * 97.7 / 25.0, 1e-6);
}

TEST_F(ParticlesOfAWall, PutTheDrawnTipWhereTheBentLeverHasIt) {
  const WallScene wall = wall_of(set_);
  ParticlesNow now{.set = &set_};
  now.push = test::push_of(set_, 0, physics::PushState::Slides);
  const render::FrameState drawn = frame(wall, &now);
  const glm::dvec3 apex(drawn.room_from_node[wall.scene().find_node("probe/apex").value()][3]);
  const glm::dvec3 in_sample =
      glm::dvec3(glm::inverse(drawn.room_from_node[wall.sample_node()]) * glm::dvec4(apex, 1.0)) * wall.unit_m() *
      wall.drawn_scale(0).sample_m_per_m;
  EXPECT_NEAR(in_sample.x, now.push.apex_m[0], 0.1e-9);
  EXPECT_NEAR(in_sample.y, now.push.apex_m[1], 0.1e-9);
}

TEST_F(ParticlesOfAWall, HangOnTheTipThatHasLiftedThem) {
  set_ = test::particle_set("pick-and-place");
  const WallScene wall = wall_of(set_);
  EXPECT_TRUE(shown(wall, frame(wall, nullptr), "pads-0/pad"));
  const auto pages = test::start_pages(set_);
  ParticlesNow now{.set = &set_, .pages = pages};
  now.push = test::push_of(set_, 0, physics::PushState::Carried);
  const double radius_m = set_.setup.species[0].contact.tip_radius.si;
  now.push.apex_m = {pages[0].poses[0].x_m, pages[0].poses[0].y_m, 90e-9};  // above its middle
  EXPECT_NEAR(centre_m(wall, frame(wall, &now), 0).z, 90e-9 - radius_m, 0.1e-9);
  EXPECT_NEAR(centre_m(wall, frame(wall, &now), 1).z, radius_m, 0.1e-9);
  // touched by the side of the tip
  const auto side =
      physics::side_contact(set_.setup.tip, set_.setup.species[0].contact.tip_radius, physics::Length(2e-9));
  now.push.apex_m[0] -= side.distance.si;
  EXPECT_NEAR(centre_m(wall, frame(wall, &now), 0).z, 90e-9 - 2e-9 + radius_m, 0.1e-9);
  now.push.state = physics::PushState::Holds;
  EXPECT_NEAR(centre_m(wall, frame(wall, &now), 0).z, radius_m, 0.1e-9);
}

TEST_F(ParticlesOfAWall, AreHiddenWithTheInstrument) {
  const WallScene wall = wall_of(set_);
  render::FrameState empty, journey;
  wall.update({}, empty);
  wall.update({.material = 0, .centerpiece = Centerpiece::Journey, .journey_orders = 4.0}, journey);
  EXPECT_FALSE(shown(wall, empty, "particles/sphere"));
  EXPECT_FALSE(shown(wall, journey, "particles/sphere"));
  EXPECT_FALSE(shown(wall, journey, "footprints/footprint"));
  EXPECT_FALSE(shown(wall, journey, "ways/dot"));
  EXPECT_FALSE(shown(wall, journey, "plan-line/dot"));
  EXPECT_FALSE(shown(wall, journey, "targets/target"));
  EXPECT_TRUE(shown(wall, frame(wall, nullptr), "particles/sphere"));
  EXPECT_TRUE(wall.scene().find_node("particles/sphere"));
  EXPECT_FALSE(scene_.scene().find_node("particles/sphere")) << "without particles";
}

}  // namespace stage_particles_test
}  // namespace afm::exhibit
