// SPDX-License-Identifier: Apache-2.0
// Invariant: German has every phrase
#include "exhibit/words/phrases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "exhibit/frame/exhibit_setup.h"
#include "scene/samples/probe_library.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace phrases_test {

using ::testing::HasSubstr;

const std::string kAssets = support::source("assets");

Phrases german() { return Phrases::load(test::kPhraseFolder + "de.toml").value(); }

TEST(Phrases, FillPlaceholdersAndUseTheDecimalMarkOfTheLanguage) {
  EXPECT_EQ(test::english().text<Phrase::NoteSnapIn>("0.24 nN", "2.4 nm"), "Snap-in 0.24 nN at 2.4 nm");
  EXPECT_EQ(german().text<Phrase::NoteSnapIn>("0.24 nN", "2.4 nm"), "Einschnappen 0,24 nN bei 2,4 nm");
  EXPECT_EQ(german().number("0.5 to 12.75; 3. and 0.2.0 stay, as 192.168.0.1"),
            "0,5 to 12,75; 3. and 0.2.0 stay, as 192.168.0.1");
  EXPECT_EQ(test::english().number("0.5"), "0.5");
}

TEST(Phrases, TranslateWordsAndTheWordBeforeANumber) {
  EXPECT_EQ(german().word("Mica"), "Glimmer");
  EXPECT_EQ(german().word("Mica 0.1 N/m"), "Glimmer 0,1 N/m");
  EXPECT_EQ(german().word("My sample"), "My sample");
  EXPECT_EQ(test::english().word("Mica"), "Mica");
}

TEST(Phrases, OfAllLanguagesHaveEveryKeyOnce) {
  std::set<std::string_view> keys;
  for (const PhraseRow& row : kPhraseRows) EXPECT_TRUE(keys.insert(row.key).second) << row.key;
  std::size_t files = 0;
  for (const LanguageRow& language : kLanguages) {
    const auto phrases = Phrases::load(test::kPhraseFolder + std::string(language.word) + ".toml");
    ASSERT_TRUE(phrases) << phrases.error().message;
    EXPECT_EQ((*phrases)[Phrase::Language], language.word);
    ++files;
  }
  const std::filesystem::directory_iterator all(test::kPhraseFolder);
  EXPECT_EQ(files, static_cast<std::size_t>(std::distance(begin(all), end(all)))) << "kLanguages lists each file";
}

// Words of our files that the wall quotes.
TEST(Phrases, OfGermanTranslateEveryWordOfMaterialsAndProbes) {
  const Phrases phrases = german();
  const std::string file = core::read_file(test::kPhraseFolder + "de.toml").value();
  const auto expect_word = [&](const std::string& word) {
    EXPECT_NE(file.find("\n\"" + word + "\" = \""), std::string::npos) << "de.toml lacks \"" << word << "\"";
  };
  const scene::MaterialLibrary materials = scene::load_materials(kAssets + "/materials.toml").value();
  for (const scene::MaterialEntry& entry : materials.materials) {
    for (const std::string& word : {entry.title, entry.tip, entry.medium}) expect_word(word);
    for (const scene::SourcedValue& value : entry.sources) expect_word(value.source);
  }
  const scene::ProbeLibrary probes = scene::load_probes(kAssets + "/probes.toml").value();
  for (const scene::ProbeEntry& probe : probes.probes) {
    for (const scene::SourcedValue& value : probe.sources) expect_word(value.source);
  }
}

TEST(Phrases, RefuseAFileThatIsNotComplete) {
  const support::ScratchFolder folder;
  const auto phrases = Phrases::load(folder.write("p.toml", "language = \"xx\"\ndecimal-mark = \".\"\n"));
  ASSERT_FALSE(phrases);
  EXPECT_THAT(phrases.error().message, HasSubstr("line 1: choose-sample: is missing"));
}

TEST(Phrases, RefuseAWrongLineOfAFileOfTheUsersOwn) {
  const support::ScratchFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto phrases = Phrases::load(folder.write("g.toml", text), test::english());
    return phrases ? std::string() : phrases.error().message;
  };
  EXPECT_EQ(refusal(""), "");
  EXPECT_THAT(refusal("lift = \"x\"\nlitf = \"y\"\n"), HasSubstr("line 2: litf: unknown key"));
  EXPECT_THAT(refusal("choose-sample = 3\n"), HasSubstr("line 1: choose-sample: must be text of"));
  EXPECT_THAT(refusal("choose-sample = \"" + std::string(101, 'x') + "\"\n"), HasSubstr("1 to 100 characters"));
  EXPECT_THAT(refusal("choose-sample = \"a\\nb\"\n"), HasSubstr("on one line"));
  EXPECT_THAT(refusal("choose-sample = \"{button}\"\n"), HasSubstr("line 1: choose-sample: {button} is unknown"));
  EXPECT_THAT(refusal("\njourney = \"Away\"\n"), HasSubstr("line 2: journey: lacks {place}"));
  EXPECT_THAT(refusal("[words]\n\"Mica\" = 3\n"), HasSubstr("line 2: Mica: must be text of"));
  EXPECT_THAT(Phrases::load("no-such-file.toml").error().message, HasSubstr("phrase file no-such-file.toml"));
}

TEST(Phrases, OfTheUserLieOnTopOfTheChosenLanguage) {
  const support::ScratchFolder folder;
  ExhibitFiles files;
  files.assets_dir = kAssets;
  files.language = "de";
  files.guidance = folder.write("own.toml", "lift = \"Hoch damit\"\n");
  const auto phrases = load_phrases(files);
  ASSERT_TRUE(phrases) << phrases.error().message;
  EXPECT_EQ(phrases->wall[Phrase::Lift], "Hoch damit");
  EXPECT_EQ(phrases->wall[Phrase::StateOn], "KRAFT AN");
  EXPECT_EQ(phrases->english[Phrase::StateOn], "FORCE ON") << "the log stays English";
}

TEST(Language, FollowsTheFirstVariableOfTheLocaleThatIsSet) {
  const auto language = [](std::vector<std::string> values) { return language_of_locale(values); };
  EXPECT_EQ(language({"", "", "de_DE.UTF-8"}), "de");
  EXPECT_EQ(language({"", "de_AT@euro", "en_US.UTF-8"}), "de");
  EXPECT_EQ(language({"C", "de_DE.UTF-8", "de_DE.UTF-8"}), "en");
  EXPECT_EQ(language({"", "", "de"}), "de");
  EXPECT_EQ(language({"", "", "den_XX"}), "en");
  EXPECT_EQ(language({"fr_FR.UTF-8", "", "de"}), "en");
  EXPECT_EQ(language({"", "", ""}), "en");
}

}  // namespace phrases_test
}  // namespace afm::exhibit
