// SPDX-License-Identifier: Apache-2.0
// The panel of the particles with settings that a person has changed.
// Invariant: figure, law and source of a threshold on the panel change together
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "exhibit/panels/particles_panel.h"
#include "scene/samples/adjusted_set.h"
#include "support/particles/particle_sets.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace push_settings_test {

using testing::HasSubstr;

class PushSettings : public ::testing::Test {
 protected:
  render::DataPanel panel(const scene::PushSettings& settings, const Phrases& phrases = test::english()) {
    adjusted_.use(settings);
    return particles_panel(
        {.set = &adjusted_.set(), .pages = pages_, .push = {.settings = settings}, .limits = &adjusted_.limits()},
        phrases);
  }

  // The row of that name: "" if there is none.
  static render::DataRow row(const render::DataPanel& panel, const std::string& name) {
    for (const render::DataRow& candidate : panel.rows) {
      if (candidate.name == name) return candidate;
    }
    return {};
  }

  const scene::ParticleSet set_ = test::particle_set("gold-row");
  const std::vector<scene::ParticlePage> pages_ = test::start_pages(set_);
  scene::AdjustedSet adjusted_{set_};
};

TEST_F(PushSettings, OfTheSetAreNotListed) {
  const render::DataPanel own = panel({.tool = scene::PushTool::Push});
  EXPECT_EQ(row(own, "Changed"), render::DataRow{});
  EXPECT_EQ(row(own, "Gives at"), (render::DataRow{"Gives at", "0.253 nN", "by shear strength \u00d7 contact area"}));
  EXPECT_EQ(row(own, "(by another law)").value, "(3.53 nN)");
  EXPECT_EQ(row(own, "Gentle load"),
            (render::DataRow{"Gentle load", "0.0679 nN", "a scan that presses harder pushes it", true}));
  EXPECT_EQ(row(own, "Lever at least"),
            (render::DataRow{"Lever at least", "2.82 mN/m", "upwards, to push it; in use: 1 N/m"}));
}

TEST_F(PushSettings, MoveFigureLawAndLimitsTogether) {
  const render::DataPanel own = panel({}), amontons = panel({.law = 2});
  EXPECT_EQ(row(amontons, "Gives at"),
            (render::DataRow{"Gives at", "3.53 nN", "by coefficient \u00d7 (load + adhesion)"}));
  EXPECT_EQ(row(amontons, "(by another law)"),
            (render::DataRow{"(by another law)", "(0.253 nN)", "not used: shear strength \u00d7 contact area", true}));
  EXPECT_EQ(row(amontons, "Changed"), (render::DataRow{"Changed", "1", "Friction law amontons"}));
  EXPECT_NE(row(amontons, "Gentle load").value, row(own, "Gentle load").value);
  EXPECT_NE(row(amontons, "Lever at least").value, row(own, "Lever at least").value);
}

TEST_F(PushSettings, HaveTheirOwnSources) {
  const render::DataPanel soft = panel({.lever = 1, .tip = 4, .medium = 1});
  EXPECT_EQ(row(soft, "Changed"),
            (render::DataRow{"Changed", "3", "Lever 100 mN/m, Tip radius 40 nm, Medium humid air"}));
  EXPECT_EQ(row(soft, "Lever, sideways").value, "1 N/m");
  EXPECT_THAT(row(soft, "Lever, sideways").source, HasSubstr("chosen here: the lever of the set"));
  EXPECT_EQ(row(soft, "Work of adhesion W").value, "292 mJ/m\u00b2");
  EXPECT_THAT(row(soft, "Work of adhesion W").source, HasSubstr("a meniscus of 72 mN/m"));
  EXPECT_THAT(row(soft, "Lever at least").source, HasSubstr("in use: 100 mN/m"));
}

TEST_F(PushSettings, NameTheLevel) {
  EXPECT_EQ(row(panel({.level = 3}), "Changed"), (render::DataRow{"Changed", "1", "Level 2"}));
}

TEST_F(PushSettings, HaveGermanWords) {
  const Phrases german = Phrases::load(test::kPhraseFolder + "de.toml").value();
  const render::DataPanel soft = panel({.lever = 4, .medium = 2, .level = 2}, german);
  EXPECT_EQ(row(soft, german[Phrase::SettingsChanged]).source, "Federbalken 40 N/m, Umgebung Wasser, Stufe 1");
  EXPECT_THAT(row(soft, german[Phrase::WorkOfAdhesion]).source, HasSubstr("Fünftel"));
}

}  // namespace push_settings_test
}  // namespace afm::exhibit
