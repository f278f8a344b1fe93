// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/particle_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "core/whole_file.h"
#include "scene/samples/particle_files.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace particle_set_test {

using testing::HasSubstr;

const std::string kFolder = support::source("assets/particles");

TEST(ParticleSet, EveryShippedSetLoadsWithASourceForEachNumber) {
  int sets = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const auto set = load_particle_set(entry.path().string());
    ASSERT_TRUE(set) << set.error().message;
    ++sets;
    if (set->soft || set->ink) continue;  // sets of soft_sample_test.cpp and ink_run_test.cpp
    EXPECT_FALSE(set->particles.empty());
    EXPECT_FALSE(set->moves.empty());
    EXPECT_EQ(set->sources.size(), 6U + set->setup.pads.size());
    for (std::size_t i = 0; i < set->species.size(); ++i) {
      const SpeciesEntry& species = set->species[i];
      const bool rod = physics::is_rod(set->setup.species[i]), island = physics::is_island(set->setup.species[i]);
      EXPECT_EQ(species.sources.size(), rod ? 6U : island ? 5U : 12U) << species.name;
      for (const SourcedValue& value : species.sources) EXPECT_FALSE(value.source.empty()) << value.key;
    }
  }
  EXPECT_EQ(sets, 12);
}

TEST(ParticleSet, GoldRowHasTheNumbersOfTheCases) {
  const auto set = load_particle_set(kFolder + "/gold-row.toml");
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->setup.species.size(), 1U);
  const physics::ParticleSpecies& gold = set->setup.species.front();
  EXPECT_NEAR(gold.contact.reduced_modulus.si, 38710783890.0, 38710.0);
  EXPECT_NEAR(physics::sliding_threshold(gold, physics::Force(0.0)).si, 2.527882197e-10, 1e-16);
  EXPECT_EQ(set->particles.size(), 5U);
  EXPECT_NEAR(set->setup.tip.half_angle_rad, 0.2617993878, 1e-10);
  EXPECT_NEAR(set->moves.at(1).speed.si, 1e-7, 1e-20);
}

std::string shipped() {
  const auto text = core::read_file(kFolder + "/gold-row.toml");
  EXPECT_TRUE(text);
  return *text;
}

std::string refusal(const std::string& text) {
  const support::ScratchFolder folder;
  const auto set = load_particle_set(folder.write("set.toml", text));
  if (set) return "accepted";
  EXPECT_EQ(set.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(set.error().message.find('\n'), std::string::npos);
  return set.error().message;
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = shipped();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ParticleSet, HasItsPatternInTheFrameOfItsParticles) {
  const auto set = load_particle_set(kFolder + "/gold-row.toml");
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->targets.size(), 5U);
  EXPECT_NEAR(median_radius(*set).si, 25e-9, 1e-20);
  const auto shared = std::make_unique<SharedParticles>(shared_particles(*set));
  const physics::Sideways<physics::Length> apart = set->targets[0].position - set->particles[0].position;
  EXPECT_NEAR(shared_targets(*set)[0].position.x.si - shared->particles[0].x_m, apart.x.si, 1e-20);
  EXPECT_NEAR(shared_targets(*set)[0].position.y.si - shared->particles[0].y_m, apart.y.si, 1e-20);
}

std::string changed_tube(const std::string& from, const std::string& to) {
  std::string text = core::read_file(kFolder + "/tube-and-electrodes.toml").value_or("");
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ParticleSet, OfRodsGoesThroughASharedSceneWithTheirDirections) {
  const auto set = load_particle_set(kFolder + "/tube-and-electrodes.toml");
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->setup.species.size(), 1U);
  const physics::ParticleSpecies& tube = set->setup.species.front();
  EXPECT_TRUE(physics::is_rod(tube));
  EXPECT_NEAR(tube.measured_threshold.si, 30e-9, 1e-20) << "30 mN/m over 1 um";
  const auto shared = std::make_unique<SharedParticles>(shared_particles(*set));
  EXPECT_TRUE(has_rods(*shared));
  const auto setup = push_setup(*shared);
  EXPECT_EQ(setup.species.at(0).length, tube.length);
  EXPECT_EQ(start_places(*shared).at(0).angle_rad, set->particles[0].angle_rad);
  EXPECT_EQ(recorded_set(*shared, support::source("assets")).pads.size(), 2U);
}

TEST(ParticleSet, RefusesRodsThatCannotBe) {
  EXPECT_EQ(refusal(changed_tube("angle_deg = 35", "angle_deg = -35")), "accepted");
  EXPECT_THAT(refusal(changed_tube("\"1 um\"", "\"3 um\"")), HasSubstr("species.length: a rod longer than 2.2"));
  EXPECT_THAT(refusal(changed_tube("\"1 um\"", "\"-1 um\"")), HasSubstr("species.length: it must be positive"));
  EXPECT_THAT(refusal(changed_tube("\"1 um\"", "\"10 nm\"")), HasSubstr("species.length: length 10 nm is not within"));
  EXPECT_THAT(refusal(changed_tube("\"30 mN/m\"", "\"30 nN\"")), HasSubstr("species.friction_per_length: cannot read"));
  EXPECT_THAT(refusal(changed_tube("\"30 mN/m\"", "\"1e-12 N/m\"")),
              HasSubstr("species.friction_per_length: friction of the whole rod: 1e-06 pN is not within"));
  EXPECT_THAT(refusal(changed_tube("\"1 TPa\"", "\"0 TPa\"")),
              HasSubstr("species.particle_modulus: it must be positive"));
  EXPECT_THAT(refusal(changed_tube("angle_deg = 35", "")), HasSubstr("particle.angle_deg: is missing"));
  EXPECT_THAT(refusal(changed_tube("angle_deg = 35", "angle_deg = nan")), HasSubstr("particle.angle_deg"));
  EXPECT_THAT(refusal(changed_tube("angle_deg = 0", "")), HasSubstr("target.angle_deg: is missing"));
  EXPECT_THAT(refusal(changed_tube("width = \"200 nm\"", "width = \"0 nm\"")),
              HasSubstr("pad.width: 0 m is not positive"));
  EXPECT_THAT(refusal(changed("x = \"180 nm\"", "angle_deg = 3\nx = \"180 nm\"")),
              HasSubstr("only a rod has an angle"));
  EXPECT_THAT(refusal(shipped() + "\n[[pad]]\nx = \"0 nm\"\ny = \"0 nm\"\nwidth = \"1 nm\"\nheight = \"1 nm\"\n"),
              HasSubstr("needs a rod that can be moved"));
}

TEST(ParticleSet, OfIslandsGoesThroughASharedScene) {
  const auto set = load_particle_set(kFolder + "/islands.toml");
  ASSERT_TRUE(set) << set.error().message;
  const physics::ParticleSpecies& island = set->setup.species.front();
  EXPECT_TRUE(physics::is_island(island));
  EXPECT_NEAR(island.measured_threshold.si, 30e-9, 0.02e-9) << "1 MPa over 30,000 nm2";
  EXPECT_NEAR(median_radius(*set).si, 97.7e-9, 1e-15);
  const auto shared = std::make_unique<SharedParticles>(shared_particles(*set));
  EXPECT_TRUE(has_islands(*shared));
  EXPECT_FALSE(has_rods(*shared));
  EXPECT_EQ(push_setup(*shared).species.at(0).island_radius, island.island_radius);
  EXPECT_EQ(recorded_set(*shared, support::source("assets")).title, set->title);
}

TEST(ParticleSet, RefusesIslandsThatCannotBe) {
  const auto changed_islands = [](const std::string& from, const std::string& to) {
    std::string text = core::read_file(kFolder + "/islands.toml").value_or("");
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  EXPECT_EQ(refusal(changed_islands("97.7 nm", "80 nm")), "accepted");
  EXPECT_THAT(refusal(changed_islands("97.7 nm", "-97.7 nm")), HasSubstr("species.radius: it must be positive"));
  EXPECT_THAT(
      refusal(changed_islands("97.7 nm", "30 nm")),
      HasSubstr("species.radius: radius 30 nm is not within 37.5 nm to 10 um: an island must be at least 1.5 times"));
  EXPECT_THAT(refusal(changed_islands("\"50 nm\"", "\"0 nm\"")),
              HasSubstr("species.height: height 0 m is not within 2 nm to 20 um"));
  EXPECT_THAT(
      refusal(changed_islands("\"50 nm\"", "\"6 nm\"")),
      HasSubstr("species.height: 6 nm is too low: an island must be at least as high as the tip's radius, 10 nm"));
  for (const char* strength : {"0 MPa", "9 GPa"}) {
    EXPECT_THAT(refusal(changed_islands("\"1 MPa\"", "\"" + std::string(strength) + "\"")),
                HasSubstr("species.shear_strength: friction of the whole island: "));
  }
  EXPECT_THAT(refusal(changed_islands("\"1 MPa\"", "\"1 nN\"")), HasSubstr("species.shear_strength: cannot read"));
  EXPECT_THAT(refusal(changed_islands("x = \"0 nm\"\ny = \"300 nm\"", "x = \"-260 nm\"\ny = \"-250 nm\"")),
              HasSubstr("overlap"));
  EXPECT_THAT(refusal(changed_islands("x = \"-300 nm\"\ny", "angle_deg = 3\nx = \"-300 nm\"\ny")),
              HasSubstr("only a rod has an angle"));
  // among spheres
  const std::string gold = shipped();
  const std::size_t from = gold.find("[[species]]"), to = gold.find("[[", from + 1);
  EXPECT_THAT(refusal(changed_islands("[[particle]]", gold.substr(from, to - from) + "\n[[particle]]")),
              HasSubstr("species: flat islands lie on a bare sample"));
}

TEST(ParticleSet, SticksToTheTipIfItsFileSaysSo) {
  const std::string key = "rolling_distance";
  const auto with = [&](const std::string& lines) { return changed(key, lines + "\n" + key); };
  const support::ScratchFolder folder;
  const auto set = load_particle_set(folder.write("set.toml", with("sticks = true\npull_off_seed = 7")));
  ASSERT_TRUE(set) << set.error().message;
  const auto shared = std::make_unique<SharedParticles>(shared_particles(*set));
  for (const physics::ParticleSpecies& species : {set->setup.species[0], push_setup(*shared).species[0]}) {
    EXPECT_TRUE(species.sticks);
    EXPECT_EQ(species.scatter_seed, 7);
  }
  EXPECT_FALSE(load_particle_set(kFolder + "/gold-row.toml")->setup.species[0].sticks);
  EXPECT_THAT(refusal(with("sticks = 1")), HasSubstr("species.sticks"));
  EXPECT_THAT(refusal(with("pull_off_seed = 7")), HasSubstr("species.pull_off_seed: the tip has no pull-off here"));
  EXPECT_THAT(refusal(with("sticks = true\npull_off_seed = 0")), HasSubstr("species.pull_off_seed"));
  const auto adhesion = [&](const std::string& value) {
    std::string text = with("sticks = true");
    const std::string given = "\"20 mJ/m2\"";
    return text.replace(text.find(given), given.size(), "\"" + value + "\"");
  };
  EXPECT_THAT(refusal(adhesion("0 mJ/m2")), HasSubstr("species.sticks: a tip that sticks needs tip_adhesion above 0"));
  EXPECT_THAT(refusal(adhesion("-5 mJ/m2")), HasSubstr("species.sticks: a tip that sticks needs tip_adhesion above 0"));
  EXPECT_THAT(refusal(adhesion("20 N/m2")), HasSubstr("species.tip_adhesion: cannot read"));
  const auto lifting = load_particle_set(folder.write("set.toml", adhesion("400 mJ/m2")));
  ASSERT_TRUE(lifting) << lifting.error().message;
  EXPECT_TRUE(has_lift(*std::make_unique<SharedParticles>(shared_particles(*lifting))));
  EXPECT_FALSE(has_lift(*shared));
}

TEST(ParticleSet, HasPadsOnWhichSpheresStick) {
  const auto set = load_particle_set(kFolder + "/pick-and-place.toml");
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_TRUE(set->pads.empty()) << "it is no electrode";
  ASSERT_EQ(set->setup.pads.size(), 1U);
  EXPECT_DOUBLE_EQ(set->setup.pads[0].work_of_adhesion.si, 0.2);
  const auto shared = std::make_unique<SharedParticles>(shared_particles(*set));
  EXPECT_TRUE(has_pads(*shared));
  EXPECT_TRUE(has_lift(*shared));
  // set-up in the frame of the particles
  const physics::PushSetup setup = push_setup(*shared);
  ASSERT_EQ(setup.pads.size(), 1U);
  const auto way = set->setup.pads[0].middle - set->particles[0].position;
  EXPECT_NEAR((setup.pads[0].middle.x - physics::Length(shared->particles[0].x_m) - way.x).si, 0.0, 1e-20);
  EXPECT_NEAR((setup.pads[0].middle.y - physics::Length(shared->particles[0].y_m) - way.y).si, 0.0, 1e-20);
  EXPECT_EQ(setup.pads[0].half_size, set->setup.pads[0].half_size);
  EXPECT_EQ(recorded_set(*shared, support::source("assets")).title, set->title);

  const std::string text = core::read_file(kFolder + "/pick-and-place.toml").value();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    return refusal(other.replace(other.find(from), from.size(), to));
  };
  EXPECT_THAT(with("\"200 mJ/m2\"", "\"0 mJ/m2\""), HasSubstr("pad.work_of_adhesion: pad work of adhesion"));
  EXPECT_THAT(with("\"200 mJ/m2\"", "\"200 nN\""), HasSubstr("pad.work_of_adhesion: cannot read"));
  EXPECT_THAT(with("width = \"70 nm\"", "width = \"0.1 nm\""), HasSubstr("pad.width: pad width"));
  const std::size_t pad = text.find("[[pad]]");
  std::string far = text;
  EXPECT_THAT(refusal(far.replace(far.find("\"200 nm\"", pad), 8, "\"900 nm\"")),
              HasSubstr("pad.x: the pad's middle is outside"));
  EXPECT_THAT(refusal(shipped() + "\n[[pad]]\nx = \"0 nm\"\ny = \"0 nm\"\nwidth = \"9 nm\"\nheight = \"9 nm\"\n"
                                  "work_of_adhesion = \"20 mJ/m2\"\n"),
              HasSubstr("pad.work_of_adhesion"));
}

TEST(ParticleSet, OfARecordingHasTheWordsOfTheSetOfTheAssets) {
  const auto set = load_particle_set(kFolder + "/latex-letter.toml");
  ASSERT_TRUE(set) << set.error().message;
  const auto recorded = std::make_unique<SharedParticles>(shared_particles(*set));
  const ParticleSet known = recorded_set(*recorded, support::source("assets"));
  EXPECT_EQ(known.title, set->title);
  EXPECT_EQ(known.particles.size(), set->particles.size());
  EXPECT_EQ(known.targets, set->targets);
  EXPECT_FALSE(known.sources.empty());

  recorded->species[0].kinetic_ratio *= 0.5;  // value from a user's file
  const ParticleSet unknown = recorded_set(*recorded, support::source("assets"));
  EXPECT_EQ(unknown.title, "Recorded particles");
  EXPECT_TRUE(unknown.sources.empty());
  ASSERT_EQ(unknown.species.size(), set->species.size());
  EXPECT_EQ(unknown.species[0].name, set->species[0].name);
  EXPECT_EQ(unknown.setup.species[0].kinetic_ratio, recorded->species[0].kinetic_ratio);
  ASSERT_EQ(unknown.particles.size(), set->particles.size());
  EXPECT_EQ(unknown.particles[1].position.x.si, recorded->particles[1].x_m);
}

TEST(ParticleSet, HasATaskWithoutAPictureOnlyIfItCanBeDone) {
  const auto set_with = [](const std::string& task) { return refusal(shipped() + "\n[task]\n" + task); };
  EXPECT_EQ(set_with("kind = \"line\"\nparticle = 1\ntarget = 3\n"), "accepted");
  EXPECT_THAT(set_with("kind = \"line\"\nparticle = 1\n"), HasSubstr("task.target: is missing"));
  EXPECT_THAT(set_with("kind = \"line\"\nparticle = 6\ntarget = 1\n"), HasSubstr("task.particle"));
  EXPECT_THAT(set_with("kind = \"line\"\nparticle = 1\ntarget = 6\n"), HasSubstr("task.target"));
  EXPECT_THAT(set_with("kind = \"threshold\"\nparticle = 1\n"), HasSubstr("task.kind: needs a particle with pinned"));
  EXPECT_THAT(set_with("kind = \"threshold\"\nparticle = 1\ntarget = 1\n"), HasSubstr("task.target: is of no use"));
  EXPECT_THAT(set_with("kind = \"blind\"\nparticle = 1\n"), HasSubstr("known are line, threshold"));
  std::string pushed = core::read_file(kFolder + "/threshold-by-feel.toml").value();
  pushed.replace(pushed.find("particle = 1"), 12, "particle = 2");
  EXPECT_THAT(refusal(pushed), HasSubstr("task.kind: particle 2 is pinned, so nobody can push it"));
}

TEST(ParticleSet, IsNotLookedForAmongNone) {
  const support::ScratchFolder folder;
  const auto none = particle_file("gold-row", folder.file("removed"));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().category, core::ErrorCategory::Failed);
  EXPECT_THAT(none.error().message,
              HasSubstr("there are no sets in " + folder.file("removed/particles") + "; install"));
  EXPECT_THAT(particle_file("silver-row", support::source("assets")).error().message,
              HasSubstr("choose blind-line, gold-row, "));
  const auto with_ending = particle_file("gold-row.toml", support::source("assets"));
  ASSERT_FALSE(with_ending);
  EXPECT_EQ(with_ending.error().message, "there is no file gold-row.toml; the included set is called gold-row");
  EXPECT_EQ(particle_file("my.toml", support::source("assets")), "my.toml") << "which load_particle_set() names";
}

// With another law, and without one of its numbers.
std::string without(const std::string& key, const std::string& law) {
  std::string text = changed("law = \"area\"", "law = \"" + law + "\"");
  const std::size_t at = text.find("\n" + key + " = ");
  EXPECT_NE(at, std::string::npos) << key;
  return text.erase(at, text.find('\n', at + 1) - at);
}

TEST(ParticleSet, RefusesATipThatStartsInsideAParticle) {
  EXPECT_THAT(
      refusal(changed("x = \"-80 nm\"\ny = \"1 nm\"\nz = \"80 nm\"", "x = \"10 nm\"\ny = \"1 nm\"\nz = \"0 nm\"")),
      HasSubstr("start.z: the tip would be inside particle 1, which it touches at "));
  // the tip touches the sphere 40.3 nm from its axis
  const auto at_m = [](const std::string& x) {
    return changed("x = \"-80 nm\"\ny = \"1 nm\"\nz = \"80 nm\"", "x = \"" + x + "\"\ny = \"0 nm\"\nz = \"0 nm\"");
  };
  EXPECT_THAT(refusal(at_m("-40.2 nm")), HasSubstr("inside particle 1"));
  EXPECT_EQ(refusal(at_m("-40.3 nm")), "accepted");
  const auto tube = [](const std::string& x, const std::string& y) {
    return changed_tube("x = \"334 nm\"\ny = \"320 nm\"\nz = \"80 nm\"",
                        "x = \"" + x + "\"\ny = \"" + y + "\"\nz = \"0 nm\"");
  };
  EXPECT_THAT(refusal(tube("328 nm", "229 nm")), HasSubstr("inside particle 1")) << "near the end of its axis";
  EXPECT_EQ(refusal(tube("328 nm", "-229 nm")), "accepted");
}

TEST(ParticleSet, RefusesWhatCannotBeInOneLineWithTheReason) {
  EXPECT_EQ(refusal(shipped()), "accepted");
  EXPECT_THAT(refusal(changed("\"25 nm\"", "\"25 N\"")), HasSubstr("species.radius: cannot read"));
  EXPECT_THAT(refusal(changed("\"25 nm\"", "\"25\"")), HasSubstr("um, nm, pm"));
  EXPECT_THAT(refusal(changed("\"25 nm\"", "\"-25 nm\"")), HasSubstr("species.radius: radius -25 nm is not within"));
  EXPECT_THAT(refusal(changed("\"10 MPa\"", "\"0 Pa\"")), HasSubstr("species.shear_strength"));
  EXPECT_THAT(refusal(changed("\"79 GPa\"", "\"79 Pa\"")), HasSubstr("species."));
  EXPECT_THAT(refusal(changed("\"79 GPa\"", "\"-79 GPa\"")),
              HasSubstr("species.particle_modulus: particle modulus -79 GPa is not within"));
  EXPECT_THAT(refusal(changed("value = 0.44", "value = 4.4")),
              HasSubstr("species.particle_poisson_ratio: particle poisson ratio 4.4"));
  EXPECT_THAT(refusal(changed("\"10 nm\"", "\"80 nm\"")), HasSubstr("at least half the tip's"));
  EXPECT_THAT(refusal(changed("value = 15", "value = 95")),
              HasSubstr("tip.half_angle_deg: half angle 95 deg is not within 0 deg to 74.5 deg"));
  EXPECT_THAT(refusal(changed("\"1 N/m\"", "\"1 mJ/m2\"")), HasSubstr("lever.normal_spring"));
  EXPECT_THAT(refusal(changed("law = \"area\"", "law = \"hope\"")),
              HasSubstr("hope is unknown; known are area, amontons"));
  EXPECT_THAT(refusal(changed("law = \"area\"", "law = \"measured\"")),
              HasSubstr("species.measured_threshold: is missing; the law measured needs it"));
  for (const std::string law : {"area", "both"}) {
    EXPECT_THAT(refusal(without("shear_strength", law)), HasSubstr("shear_strength: is missing; the law " + law));
  }
  for (const std::string law : {"amontons", "both"}) {
    EXPECT_THAT(refusal(without("coefficient", law)), HasSubstr("coefficient: is missing; the law " + law));
  }
  EXPECT_EQ(refusal(without("coefficient", "area")), "accepted");
  EXPECT_THAT(refusal(changed("x = \"180 nm\"\ny = \"-20 nm\"", "x = \"10 nm\"\ny = \"0 nm\"")),
              HasSubstr("line 41: particle.x: particles 1 and 2 overlap: their centres are 10 nm apart"));
  EXPECT_THAT(refusal(changed("x = \"180 nm\"", "x = \"180 mm\"")), HasSubstr("particle.x: 180 mm is not within"));
  EXPECT_THAT(refusal(changed("x = \"180 nm\"", "species = \"silver\"\nx = \"180 nm\"")),
              HasSubstr("silver is unknown; known are gold"));
  EXPECT_THAT(refusal(changed("x = \"180 nm\"", "colour = 1\nx = \"180 nm\"")), HasSubstr("unknown key"));
  EXPECT_THAT(refusal(changed("speed = \"0.2 um/s\"", "speed = \"0 um/s\"")), HasSubstr("move.speed: 0"));
  EXPECT_THAT(refusal(changed("source = \"polycrystalline gold, bulk\", ", "")), HasSubstr("source"));
  EXPECT_THAT(refusal(""), HasSubstr("title: is missing"));
  EXPECT_THAT(refusal(changed("x = \"30 nm\"", "x = \"400 nm\"")),
              HasSubstr("target.x: the target is outside the rectangle of the particles, x from 0 nm to 330 nm and y "
                        "from -160 nm to 170 nm"));
  EXPECT_THAT(refusal(changed("x = \"30 nm\"\ny = \"0 nm\"", "x = \"30 nm\"\ny = \"500 nm\"")),
              HasSubstr("target.y: the target is outside"));
  EXPECT_THAT(refusal(changed("x = \"30 nm\"", "x = \"51 nm\"")), HasSubstr("nearer to target 1 than"));
  EXPECT_EQ(refusal(changed("x = \"30 nm\"", "x = \"50 nm\"")), "accepted") << "two that touch";
  EXPECT_THAT(refusal(changed("[[target]]", "[[target]]\nx = \"10 nm\"\ny = \"-90 nm\"\n\n[[target]]")),
              HasSubstr("more targets than the 5 particles"));
  EXPECT_THAT(refusal(changed("x = \"180 nm\"", "pinned = true\nx = \"180 nm\"")), HasSubstr("than the 4 particles"));
}

}  // namespace particle_set_test
}  // namespace afm::scene
