// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/particles_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/state/plan_figures.h"
#include "scene/samples/pattern_state.h"
#include "servo/live_picture.h"
#include "support/particles/particle_sets.h"
#include "support/phrases.h"
#include "support/places.h"

// The panel of the particles, of five gold spheres on mica.
namespace afm::exhibit {
namespace particles_panel_test {

using physics::PushState;
using testing::HasSubstr;
using testing::StartsWith;

class ParticlesPanel : public ::testing::Test {
 protected:
  render::DataPanel panel(const scene::TipPush& push, const Phrases& phrases = test::english()) const {
    return particles_panel({.set = &set_, .pages = pages_, .push = push}, phrases);
  }
  render::DataRow row(const render::DataPanel& panel, Phrase name, const Phrases& phrases = test::english()) const {
    const auto found = std::find_if(panel.rows.begin(), panel.rows.end(),
                                    [&](const render::DataRow& candidate) { return candidate.name == phrases[name]; });
    return found == panel.rows.end() ? render::DataRow{} : *found;
  }

  scene::ParticleSet set_ = test::particle_set("gold-row");
  std::vector<scene::ParticlePage> pages_ = test::start_pages(set_);
};

TEST_F(ParticlesPanel, NamesStateParticleAndForcesOfAPush) {
  const render::DataPanel shown = panel(test::push_of(set_, 2, PushState::Slides));
  EXPECT_EQ(shown.title, "Five gold spheres on mica");
  EXPECT_EQ(shown.subtitle, "110 nm off the pattern (25 nm allowed); to take back: 0");
  EXPECT_EQ(row(shown, Phrase::PushStateName), (render::DataRow{"State", "slides", "particle 3 of 5: gold"}));
  EXPECT_EQ(row(shown, Phrase::PushNormal).value, "0.31 nN");
  EXPECT_EQ(row(shown, Phrase::PushLateral).value, "0.25 nN");
  EXPECT_EQ(row(shown, Phrase::PushThreshold),
            (render::DataRow{"Gives at", "0.25 nN", "by shear strength \u00d7 contact area"}));
}

TEST_F(ParticlesPanel, HasAWordForEveryState) {
  std::vector<std::string> words;
  for (const PushState state : core::kEnumerators<PushState>) {
    words.push_back(row(panel(test::push_of(set_, 0, state)), Phrase::PushStateName).value);
  }
  EXPECT_EQ(words, (std::vector<std::string>{"free", "holds", "slides", "rolls", "several move", "on the tip"}));
}

TEST_F(ParticlesPanel, SaysThatATipWhichSticksHoldsOrDrags) {
  scene::TipPush push = test::push_of(set_, 0, PushState::Slides);
  EXPECT_EQ(row(panel(push), Phrase::ParticleTearsAt), render::DataRow{}) << "a tip that does not stick";
  set_.setup.species[0].sticks = true;
  push.normal_n = -0.26e-9;
  EXPECT_EQ(row(panel(push), Phrase::PushStateName).value, "is dragged");
  EXPECT_EQ(row(panel(push), Phrase::PushNormal).value, "-0.26 nN");
  const render::DataRow tears = row(panel(push), Phrase::ParticleTearsAt);
  EXPECT_EQ(tears.value, "1.49 nN");
  EXPECT_THAT(tears.source, StartsWith("20 mJ/m\u00b2; estimated: silicon oxide on gold"));
  push.state = PushState::Holds;
  EXPECT_EQ(row(panel(push), Phrase::PushStateName).value, "holds the tip");
}

TEST_F(ParticlesPanel, NamesTheToolInUse) {
  scene::TipPush push = test::push_of(set_, 0, PushState::Slides);
  const render::DataRow pushes{"Tool", "push", "the tip lets go of spheres", true};
  EXPECT_EQ(row(panel(push), Phrase::ToolName), pushes);
  push.settings.tool = scene::PushTool::Push;
  EXPECT_EQ(row(panel(push), Phrase::ToolName), pushes);
  EXPECT_EQ(row(panel(push), Phrase::ParticleTearsAt), render::DataRow{});
  push.settings.tool = scene::PushTool::Grip;
  EXPECT_EQ(row(panel(push), Phrase::ToolName), render::DataRow{});
  EXPECT_EQ(row(panel(push), Phrase::ParticleTearsAt).name, "Grip, tears away at");
  EXPECT_EQ(row(panel(push), Phrase::ParticleTearsAt).value, "1.49 nN");
  set_ = test::particle_set("sticky-tip");
  pages_ = test::start_pages(set_);
  push = test::push_of(set_, 0, PushState::Holds);
  EXPECT_FALSE(row(panel(push), Phrase::ParticleTearsAt).value.empty()) << "the tool of the set";
  push.settings.tool = scene::PushTool::Push;
  EXPECT_EQ(row(panel(push), Phrase::ToolName).value, "push");
}

TEST_F(ParticlesPanel, HasTheAdhesionOfThePadBelowTheTouchedSphere) {
  set_ = test::particle_set("pick-and-place");
  pages_ = test::start_pages(set_);
  scene::TipPush push = test::push_of(set_, 0, PushState::Carried);
  EXPECT_EQ(row(panel(push), Phrase::PushStateName).value, "on the tip");
  EXPECT_EQ(row(panel(push), Phrase::WorkOfAdhesion).value, "20 mJ/m\u00b2");
  const physics::StickyPad pad = scene::shared_sticky_pads(set_).front();
  pages_[0].poses[0].x_m = pad.middle.x.si;
  pages_[0].poses[0].y_m = pad.middle.y.si;
  const render::DataRow adhesion = row(panel(push), Phrase::WorkOfAdhesion);
  EXPECT_EQ(adhesion.value, "200 mJ/m\u00b2");
  EXPECT_THAT(adhesion.source, HasSubstr("thiols"));
}

TEST_F(ParticlesPanel, HasTheFrictionOfAnIsland) {
  set_ = test::particle_set("islands");
  pages_ = test::start_pages(set_);
  scene::TipPush push = test::push_of(set_, 0, PushState::Slides);
  push.threshold_n = 14.9e-9;
  EXPECT_EQ(row(panel(push), Phrase::PushThreshold).value, "14.9 nN");
  EXPECT_EQ(row(panel(push), Phrase::PushOtherLaw), render::DataRow{}) << "measured alone";
  EXPECT_EQ(row(panel(push), Phrase::ParticleRadius).value, "97.7 nm");
  EXPECT_EQ(row(panel(push), Phrase::ParticleShearStrength).value, "1 MPa");
  EXPECT_THAT(row(panel(push), Phrase::ParticleShearStrength).source, StartsWith("estimated: order of magnitude"));
  EXPECT_EQ(row(panel(push), Phrase::WorkOfAdhesion), render::DataRow{});
  // an island that turns is lost more slowly, and may be aimed at less well
  ParticlesNow now{.set = &set_, .pages = pages_, .push = push};
  now.plan = {.from_m = {pages_[0].poses[0].x_m, pages_[0].poses[0].y_m},
              .to_m = {pages_[0].poses[0].x_m, pages_[0].poses[0].y_m + 339e-9},
              .particle = 0};
  EXPECT_NEAR(plan_figures(now)->aim.si, 27.9e-9, 0.2e-9);
}

TEST_F(ParticlesPanel, SaysWhatIsKnownOfTheNearestParticleAndWhatALookFound) {
  using servo::Known;
  servo::PictureNow picture{.level = 2,
                            .known = std::vector<Known>(set_.particles.size(), Known::Measured),
                            .particle = 2,
                            .age_s = 83.2,
                            .doubt_m = 4.55e-9};
  picture.known[2] = Known::Computed;
  picture.all_measured = false;
  scene::TipPush push = test::push_of(set_, 0, PushState::Free);
  push.strokes = 4;
  const auto shown = [&] {
    return particles_panel({.set = &set_, .pages = pages_, .push = push, .picture = &picture}, test::english());
  };
  EXPECT_EQ(row(panel(push), Phrase::PictureName), render::DataRow{}) << "level 0 has none";
  EXPECT_EQ(row(shown(), Phrase::PictureName),
            (render::DataRow{"Picture", "computed", "level 2; particle 3, seen 83 s ago, in doubt by 4.55 nm"}));
  EXPECT_EQ(row(shown(), Phrase::LookName), render::DataRow{}) << "nobody has looked";
  EXPECT_THAT(shown().subtitle, HasSubstr("to take back: 0")) << "none at level 2";
  picture.known[2] = Known::Stale;
  EXPECT_EQ(row(shown(), Phrase::PictureName).value, "stale");
  picture.look_share = 0.4;
  EXPECT_EQ(row(shown(), Phrase::PictureName).value, "looking: 40 %");
  picture.looks = 1;
  picture.newest = {.particle = 2, .lines = 33, .off_m = 6.7e-9};
  EXPECT_EQ(row(shown(), Phrase::LookName),
            (render::DataRow{"Newest look", "6.7 nm", "from the shown place of particle 3; lines: 33"}));
  picture.newest.off_m.reset();
  EXPECT_EQ(row(shown(), Phrase::LookName).value, "not found");
}

TEST_F(ParticlesPanel, CallsNoPatternDoneBeforeAllOfItHasBeenMeasured) {
  pages_ = test::formed_pages(set_);
  servo::PictureNow picture{.level = 1, .known = std::vector<servo::Known>(set_.particles.size())};
  const scene::TipPush push = test::push_of(set_, 0, PushState::Free);
  const auto shown = [&] {
    return particles_panel({.set = &set_, .pages = pages_, .push = push, .picture = &picture}, test::english());
  };
  EXPECT_THAT(shown().subtitle, StartsWith("Pattern done"));
  picture.all_measured = false;
  EXPECT_THAT(shown().subtitle, HasSubstr("by computed places: look again (F5)"));
}

TEST_F(ParticlesPanel, WarnsOfALookThatPressesTooHard) {
  servo::PictureNow picture{.level = 1, .known = std::vector<servo::Known>(set_.particles.size())};
  ParticlesNow now{.set = &set_, .pages = pages_, .picture = &picture, .look_load_n = 34e-12};
  const auto shown = [&](Phrase name, const Phrases& phrases = test::english()) {
    return row(particles_panel(now, phrases), name, phrases);
  };
  EXPECT_EQ(shown(Phrase::LookLoad), render::DataRow{}) << "gentle";
  now.look_load_n = 136e-12;
  EXPECT_EQ(shown(Phrase::LookLoad),
            (render::DataRow{"Load of a look", "0.136 nN",
                             "too hard: a look pushes particles away; gentle up to 0.0679 nN"}));
  const Phrases german = Phrases::load(test::kPhraseFolder + "de.toml").value();
  EXPECT_EQ(shown(Phrase::LookLoad, german).source, "zu hart: Die Messung schiebt Teilchen weg; sanft bis 0,0679 nN");
  picture.looks = 1;
  picture.newest = {.particle = 2, .lines = 33, .off_m = std::nullopt, .swept_above_n = 67.9e-12};
  EXPECT_EQ(shown(Phrase::LookName),
            (render::DataRow{"Newest look", "pushed away", "particle 3: the load was above its gentle 0.0679 nN"}));
  now.picture = nullptr;
  EXPECT_EQ(shown(Phrase::LookLoad), render::DataRow{}) << "no looks";
}

TEST_F(ParticlesPanel, SaysHowManyPushesCanBeTakenBack) {
  set_.targets.clear();
  scene::TipPush push = test::push_of(set_, 0, PushState::Free);
  EXPECT_EQ(panel(push).subtitle, "Particles in air");
  push.strokes = 3;
  EXPECT_EQ(panel(push).subtitle, "Particles in air; pushes to take back: 3");
  push.strokes = scene::kMostStrokes;
  EXPECT_EQ(panel(push).subtitle, "Particles in air; pushes to take back: 64");
}

TEST_F(ParticlesPanel, SaysHowFarThePatternIsAndWhenItIsDone) {
  scene::TipPush push = test::push_of(set_, 0, PushState::Free);
  push.strokes = 7;
  const auto targets = scene::shared_targets(set_);
  const std::array<std::size_t, 5> order{3, 0, 4, 1, 2};  // any assignment of particles to targets
  for (std::size_t i = 0; i < targets.size(); ++i) {
    scene::ParticlePose& pose = pages_[0].poses[order[i]];
    pose.x_m = targets[i].position.x.si + 24e-9;
    pose.y_m = targets[i].position.y.si;
  }
  EXPECT_EQ(panel(push).subtitle, "Pattern done, 24 nm off; pushes to take back: 7");
  EXPECT_TRUE(pattern_of({.set = &set_, .pages = pages_})->done());
  for (std::size_t i = 0; i < targets.size(); ++i) pages_[0].poses[i].x_m += 2e-9;
  EXPECT_EQ(panel(push).subtitle, "26 nm off the pattern (25 nm allowed); to take back: 7");
  EXPECT_FALSE(pattern_of({.set = &set_, .pages = pages_})->done());
  EXPECT_FALSE(pattern_of({.set = &set_, .pages = {}})) << "before the servo has said where they lie";
}

TEST_F(ParticlesPanel, AsksForTheLiftWhileTheTaskRunsAndShowsTheScoreThen) {
  pages_ = test::formed_pages(set_);
  scene::TipPush push = test::push_of(set_, 0, PushState::Free);
  push.strokes = 7;
  scene::TaskScore score{.time_s = 83.54,
                         .rms_m = 22.5e-9,
                         .work_j = 42e-18,
                         .largest_lateral_n = 0.25e-9,
                         .strokes = 7,
                         .losses = 2,
                         .state = scene::TaskState::Running};
  const Phrases german = Phrases::load(test::kPhraseFolder + "de.toml").value();
  const auto shown = [&](const Phrases& phrases) {
    return particles_panel({.set = &set_, .pages = pages_, .push = push, .score = score}, phrases);
  };
  const auto rows = [&](const Phrases& phrases, std::size_t count) {
    const auto all = shown(phrases).rows;
    return std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  };
  EXPECT_EQ(shown(test::english()).subtitle, "22.5 nm off, within the limit: lift the tip; to take back: 7");
  EXPECT_EQ(rows(test::english(), 1), (std::vector<render::DataRow>{{"Clock", "84 s", "pushes: 7; slipped past: 2"}}));
  EXPECT_EQ(shown(test::english()).rows[1].name, "State");
  EXPECT_EQ(shown(german).subtitle, "22,5 nm daneben, im Rahmen: Spitze abheben; zur\u00fccknehmbar: 7");
  EXPECT_EQ(rows(german, 1),
            (std::vector<render::DataRow>{{"Uhr", "84 s", "Sch\u00fcbe: 7; daran vorbeigerutscht: 2"}}));

  score.state = scene::TaskState::Done;
  EXPECT_EQ(shown(test::english()).subtitle, "Pattern done, 22.5 nm off; pushes to take back: 7");
  EXPECT_EQ(rows(test::english(), 3),
            (std::vector<render::DataRow>{{"Done in", "83.5 s", "pushes: 7; slipped past: 2"},
                                          {"Distance when done", "22.5 nm", "no push was taken back or guided"},
                                          {"Work of the hand", "42 aJ", "largest lateral force 0.25 nN"}}));
  score.undos = 3;
  score.guided = 2;
  EXPECT_EQ(rows(german, 3),
            (std::vector<render::DataRow>{
                {"Fertig in", "83,5 s", "Sch\u00fcbe: 7; daran vorbeigerutscht: 2"},
                {"Abstand bei Abschluss", "22,5 nm", "zur\u00fcckgenommene Sch\u00fcbe: 3; in einer Rille: 2"},
                {"Arbeit der Hand", "42 aJ", "gr\u00f6\u00dfte Seitenkraft 0,25 nN"}}));
  score.truth = 1;
  EXPECT_EQ(rows(test::english(), 3)[1].source, "taken back: 3; in a groove: 2; particles shown");
  score.undos = score.guided = 0;
  EXPECT_EQ(rows(test::english(), 3)[1].source, "aid: the particles were shown, no picture");
}

TEST_F(ParticlesPanel, SaysWhatAPlanAsksOfTheHand) {
  EXPECT_EQ(row(panel(test::push_of(set_, 0, PushState::Free)), Phrase::PlanWay).name, "") << "without a plan";
  ParticlesNow now{.set = &set_, .pages = pages_, .push = test::push_of(set_, 0, PushState::Free)};
  const scene::ParticlePose third = pages_[0].poses[2];
  now.plan = {.from_m = {third.x_m, third.y_m}, .to_m = {third.x_m, third.y_m + 120e-9}, .particle = 2};
  const render::DataPanel shown = particles_panel(now, test::english());
  // rho is 40.25 nm, 8.05 mm in the hand
  EXPECT_EQ(row(shown, Phrase::PlanWay),
            (render::DataRow{"Planned path left", "120 nm", "of particle 3; without a groove"}));
  EXPECT_EQ(row(shown, Phrase::PlanAim).value, "4.07 nm") << "40.25 nm/cosh(120/40.25)";
  EXPECT_EQ(row(shown, Phrase::PlanHand),
            (render::DataRow{"Hand at most", "32.2 mm/s", "to steer it: distance of tip and sphere/0.25 s"}));
  now.plan.guided = 1;
  pages_[0].poses[2].y_m += 80e-9;
  EXPECT_EQ(row(particles_panel(now, test::english()), Phrase::PlanWay),
            (render::DataRow{"Planned path left", "40 nm", "of particle 3; a groove guides the hand"}));
  now.plan.to_m[1] += 2e-6;
  EXPECT_EQ(row(particles_panel(now, test::english()), Phrase::PlanAim).value, "< 1 pm");
  now.push.hand_m_per_m = 0.0;
  EXPECT_EQ(row(particles_panel(now, test::english()), Phrase::PlanHand).name, "") << "before the servo has said it";
}

// The unused figure is in brackets, recognisable without colour.
TEST_F(ParticlesPanel, ShowsTheOtherLawsFigureInBrackets) {
  const auto other = row(panel(test::push_of(set_, 0, PushState::Holds)), Phrase::PushOtherLaw);
  EXPECT_EQ(other.name, "(by another law)");
  EXPECT_EQ(other.value, "(3.53 nN)") << "0.3 of 11.8 nN";
  EXPECT_EQ(other.source, "not used: coefficient \u00d7 (load + adhesion)");
  set_.setup.species.front().law = physics::ParticleLaw::Amontons;
  const render::DataPanel by_load = panel(test::push_of(set_, 0, PushState::Holds));
  EXPECT_THAT(row(by_load, Phrase::PushThreshold).source, HasSubstr("coefficient"));
  EXPECT_THAT(row(by_load, Phrase::PushOtherLaw).source, HasSubstr("shear strength"));
  set_.setup.species.front().shear_strength = physics::Pressure(0.0);
  EXPECT_EQ(row(panel({}), Phrase::PushOtherLaw).name, "") << "the file lacks its parameters";
}

TEST_F(ParticlesPanel, IsFreeWithTheFiguresAtRestWhileNothingIsTouched) {
  scene::TipPush lifted = test::push_of(set_, 0, PushState::Slides);
  lifted.met = 0;
  for (const scene::TipPush& push : {scene::TipPush{}, lifted}) {
    const render::DataPanel shown = panel(push);
    EXPECT_EQ(row(shown, Phrase::PushStateName), (render::DataRow{"State", "free", "the tip touches no particle"}));
    EXPECT_EQ(row(shown, Phrase::PushNormal).value, "0 nN");
    EXPECT_EQ(row(shown, Phrase::PushLateral).value, "0 nN");
    EXPECT_NE(row(shown, Phrase::PushThreshold).value, "0 nN");
  }
}

TEST_F(ParticlesPanel, SaysWhatIsEstimatedOfEveryNumberOfTheFile) {
  const render::DataPanel shown = panel({});
  for (const Phrase name : {Phrase::ParticleRadius, Phrase::WorkOfAdhesion, Phrase::ParticleShearStrength,
                            Phrase::ParticleCoefficient, Phrase::LeverSideways}) {
    EXPECT_THAT(row(shown, name).source, StartsWith("estimated: ")) << test::english()[name];
  }
  EXPECT_EQ(row(shown, Phrase::ParticleRadius).value, "25 nm");
  EXPECT_EQ(row(shown, Phrase::WorkOfAdhesion).value, "100 mJ/m\u00b2");
  for (scene::SourcedValue& source : set_.species.front().sources) source.estimated = false;
  EXPECT_EQ(row(panel({}), Phrase::ParticleRadius).source, "colloidal gold of 50 nm, nominal");
}

TEST_F(ParticlesPanel, SaysHowMuchSofterTheLeverIsInTheHand) {
  scene::TipPush push = test::push_of(set_, 0, PushState::Holds);
  EXPECT_EQ(row(panel(push), Phrase::LeverSoftened).name, "") << "as it is";
  push.softened_sideways = 25.0;
  push.softened_upwards = 3.0;
  EXPECT_EQ(row(panel(push), Phrase::LeverSoftened).value, "25 times softer");
  push.softened_sideways = 1234.5;
  EXPECT_EQ(row(panel(push), Phrase::LeverSoftened).value, "1234 times softer");
}

TEST_F(ParticlesPanel, SpeaksGerman) {
  const Phrases german = Phrases::load(test::kPhraseFolder + "de.toml").value();
  const render::DataPanel shown = panel(test::push_of(set_, 2, PushState::Rolls), german);
  EXPECT_EQ(shown.title, "F\u00fcnf Goldkugeln auf Glimmer");
  EXPECT_EQ(row(shown, Phrase::PushStateName, german).value, "rollt");
  EXPECT_EQ(row(shown, Phrase::PushOtherLaw, german).value, "(3,53 nN)");
}

// Texts of the panel about a set that are not phrases.
std::vector<std::string> words_of(const scene::ParticleSet& set) {
  std::vector<std::string> words{set.title, set.medium};
  const auto add = [&](std::span<const scene::SourcedValue> sources, std::string_view key) {
    if (const scene::SourcedValue* found = scene::find_source(sources, key)) words.push_back(found->source);
  };
  add(set.sources, "lateral_spring");
  if (set.soft != nullptr) add(set.sources, "hardness");
  for (std::size_t i = 0; i < scene::shared_sticky_pads(set).size(); ++i) {
    add(set.sources, "pad_" + std::to_string(i + 1) + "_work_of_adhesion");
  }
  for (std::size_t i = 0; i < set.species.size(); ++i) {
    words.push_back(set.species[i].name);
    for (const char* key : {"radius", "work_of_adhesion", "shear_strength", "coefficient"}) {
      add(set.species[i].sources, key);
    }
    if (set.setup.species[i].sticks) add(set.species[i].sources, "tip_adhesion");
  }
  return words;
}

TEST(WordsOfParticles, OfEverySetAreInGerman) {
  const Phrases german = Phrases::load(test::kPhraseFolder + "de.toml").value();
  std::size_t sets = 0;
  for (const auto& file : std::filesystem::directory_iterator(support::source("assets/particles"))) {
    const scene::ParticleSet set = scene::load_particle_set(file.path().string()).value();
    if (set.ink != nullptr) continue;  // set not shown on the wall
    ++sets;
    for (const std::string& word : words_of(set)) EXPECT_NE(german.word(word), word) << file.path();
  }
  EXPECT_GE(sets, 9U);
}

}  // namespace particles_panel_test
}  // namespace afm::exhibit
