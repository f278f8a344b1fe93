// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/material_library.h"
#include "support/places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

namespace afm::scene {
namespace material_library_test {

using testing::AllOf;
using testing::HasSubstr;

const std::string kShipped = support::source("assets/materials.toml");

constexpr const char* kOneMaterial = R"([[material]]
name = "mica"
title = "Mica"
tip = "Si3N4"
medium = "water"
tip_radius = { value = "50 nm", source = "a" }
spring_constant = { value = "0.1 N/m", source = "b" }
sample_stiffness = { value = "inf N/m", source = "c" }
hamaker = { value = "24.5 zJ", source = "d" }
mean_surface_energy = { value = "2.228 mJ/m2", source = "e" }
experiment_f_attr = { value = "0.24 nN", source = "f" }
experiment_f_ad = { value = "1.4 nN", source = "g" }
)";

core::Result<MaterialLibrary> load_text(const std::string& text) {
  const auto path =
      std::filesystem::temp_directory_path() /
      (std::string("touchafm_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml");
  std::ofstream(path) << text;
  auto result = load_materials(path.string());
  std::filesystem::remove(path);
  return result;
}

// The file of one material with `from` replaced by `to`.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kOneMaterial;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  const auto result = load_text(text);
  if (result) {
    ADD_FAILURE() << "accepted:\n" << text;
    return "";
  }
  EXPECT_EQ(result.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
  return result.error().message;
}

TEST(MaterialLibrary, HoldsThePapersThreeMaterialsFirst) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value()) << library.error().message;
  ASSERT_GE(library->materials.size(), 3U);
  for (std::size_t i = 0; i < kPaperMaterials.size(); ++i) EXPECT_EQ(library->materials[i].name, kPaperMaterials[i]);
  const MaterialEntry* gold = library->find("gold");
  ASSERT_NE(gold, nullptr);
  EXPECT_EQ(gold->contact.tip_radius.si, 5e-8);
  EXPECT_EQ(gold->contact.spring_constant.si, 0.1);
  EXPECT_TRUE(std::isinf(gold->contact.sample_stiffness.si));
  EXPECT_EQ(gold->contact.hamaker.si, 1.2e-19);
  EXPECT_EQ(gold->contact.mean_surface_energy.si, 0.015915);
  EXPECT_EQ(gold->experiment_f_ad.value().si, 1e-8);
  EXPECT_THAT(gold->note, HasSubstr("SiO2"));
}

// 1/E* = (1 - nu_t^2)/E_t + (1 - nu_s^2)/E_s, worked out by hand to three digits.
TEST(MaterialLibrary, MakesTheReducedModulusOfBothBodies) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value());
  EXPECT_NEAR(library->find("mica")->contact.reduced_modulus.si, 51.5e9, 0.05e9);
  EXPECT_NEAR(library->find("gold")->contact.reduced_modulus.si, 71.4e9, 0.05e9);
  EXPECT_NEAR(library->find("si3n4")->contact.reduced_modulus.si, 132e9, 0.05e9);
  EXPECT_NEAR(library->find("pdms-air")->contact.reduced_modulus.si, 2.667e6, 0.001e6);
}

TEST(MaterialLibrary, CitesASourceForEveryNumber) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value());
  for (const MaterialEntry& entry : library->materials) {
    EXPECT_GE(entry.sources.size(), 12U) << entry.name;
    for (const auto& sourced : entry.sources) EXPECT_FALSE(sourced.source.empty()) << entry.name << sourced.key;
  }
}

TEST(MaterialLibrary, MarksWhatNobodyMeasured) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value());
  ASSERT_GT(library->materials.size(), kPaperMaterials.size());
  for (const MaterialEntry& entry : library->materials) {
    const bool paper = std::find(kPaperMaterials.begin(), kPaperMaterials.end(), entry.name) != kPaperMaterials.end();
    EXPECT_EQ(find_source(entry.sources, "hamaker")->estimated, !paper) << entry.name;
    EXPECT_TRUE(find_source(entry.sources, "sample_modulus")->estimated) << entry.name;
    EXPECT_EQ(entry.experiment_f_attr.has_value(), paper) << entry.name;
    EXPECT_TRUE(library->find(entry.look) != nullptr) << entry.look;
  }
}

// W = A/(12 pi a0^2) with a0 = 0.165 nm, as documented in the file for every row that is not the paper's.
TEST(MaterialLibrary, HasWorksOfAdhesionThatFollowFromTheHamakerConstants) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value());
  std::size_t followed = 0;
  for (const MaterialEntry& entry : library->materials) {
    if (entry.experiment_f_ad) continue;
    ++followed;
    const double work = entry.contact.hamaker.si / (12.0 * std::numbers::pi * 0.165e-9 * 0.165e-9);
    EXPECT_NEAR(2.0 * entry.contact.mean_surface_energy.si / work, 1.0, 0.03) << entry.name;
  }
  EXPECT_GE(followed, 5U);
}

TEST(MaterialLibrary, TakesAnotherFileOnTop) {
  auto library = load_materials(kShipped).value();
  const std::size_t count = library.materials.size();
  library.add(load_text(changed("\"Mica\"", "\"My mica\"")).value());
  EXPECT_EQ(library.materials.size(), count);
  EXPECT_EQ(library.materials.front().title, "My mica");
  library.add(load_text(changed("name = \"mica\"", "name = \"glass\"")).value());
  EXPECT_EQ(library.materials.back().name, "glass");
}

TEST(MaterialLibrary, GivesTheChosenOnesInTheirOrder) {
  const auto library = load_materials(kShipped).value();
  const std::vector<std::string> names{"si3n4", "mica"};
  const auto chosen = library.only(names);
  ASSERT_TRUE(chosen.has_value());
  ASSERT_EQ(chosen->materials.size(), 2U);
  EXPECT_EQ(chosen->materials[0].name, "si3n4");
  const std::vector<std::string> unknown{"butter"};
  EXPECT_THAT(library.only(unknown).error().message, HasSubstr("unknown material \"butter\""));
}

TEST(MaterialLibrary, ListsTheKnownNamesForAnUnknownOne) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value());
  EXPECT_EQ(library->find("Mica"), nullptr);
  const auto missing = library->require("unobtainium");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(missing.error().message, HasSubstr("unknown material \"unobtainium\"; choose mica, gold, si3n4, "));
}

TEST(MaterialFile, IsAcceptedAsWritten) {
  const auto library = load_text(kOneMaterial);
  ASSERT_TRUE(library.has_value()) << library.error().message;
  EXPECT_EQ(library->materials.front().sources.front().value, "50 nm");
}

TEST(MaterialFile, NamesFileLineAndKeyOfAnUnknownKey) {
  EXPECT_THAT(refusal(changed("medium", "mdium")),
              AllOf(HasSubstr("touchafm_NamesFileLineAndKeyOfAnUnknownKey.toml: line 5: material.mdium: unknown key")));
  EXPECT_THAT(refusal(changed("source = \"d\"", "sauce = \"d\"")), HasSubstr("line 9: material.hamaker.sauce"));
  EXPECT_THAT(refusal(std::string("[lever]\n") + kOneMaterial), HasSubstr("line 1: lever: unknown key"));
}

TEST(MaterialFile, NamesTheKeyThatIsMissing) {
  EXPECT_THAT(refusal(changed("medium = \"water\"", "")), HasSubstr("material.medium: is missing"));
  EXPECT_THAT(refusal(changed(", source = \"d\"", "")), HasSubstr("material.hamaker.source: is missing"));
  EXPECT_THAT(refusal(""), HasSubstr("at least one [[material]]"));
}

TEST(MaterialFile, NamesTheKeyOfAWrongType) {
  EXPECT_THAT(refusal(changed("\"Mica\"", "7")), HasSubstr("line 3: material.title: must be text"));
  EXPECT_THAT(refusal(changed("{ value = \"50 nm\", source = \"a\" }", "50e-9")),
              HasSubstr("line 6: material.tip_radius: must be written { value"));
  EXPECT_THAT(
      refusal(changed("\"50 nm\"", "50")),
      HasSubstr("material.tip_radius: cannot read \"50\" as a length: it has no unit; write a number and one of the "
                "units m, mm, um, nm, pm, in quotes"));
  EXPECT_THAT(refusal("material = 3\n"), HasSubstr("line 1: material: must be written [[material]]"));
  EXPECT_THAT(refusal("material = [3]\n"), HasSubstr("must be written [[material]]"));
}

TEST(MaterialFile, RefusesBareNumbersAndWrongDimensions) {
  EXPECT_THAT(refusal(changed("50 nm", "50")),
              HasSubstr("line 6: material.tip_radius: cannot read \"50\" as a length"));
  EXPECT_THAT(refusal(changed("24.5 zJ", "24.5 nN")), HasSubstr("line 9: material.hamaker: cannot read"));
}

TEST(MaterialFile, RefusesUnphysicalValues) {
  EXPECT_THAT(refusal(changed("50 nm", "-50 nm")),
              HasSubstr("line 6: material.tip_radius: tip radius -50 nm is not within 100 pm to 1 mm"));
  EXPECT_THAT(refusal(changed("24.5 zJ", "1e30 J")), HasSubstr("line 9: material.hamaker"));
  EXPECT_THAT(refusal(changed("\"0.1 N/m\"", "\"inf N/m\"")), HasSubstr("line 7: material.spring_constant"));
  EXPECT_THAT(refusal(changed("2.228", "0")), HasSubstr("line 10: material.mean_surface_energy"));
  EXPECT_THAT(refusal(changed("1.4 nN", "-1.4 nN")), HasSubstr("line 12: material.experiment_f_ad"));
}

TEST(MaterialFile, TakesTheWorkOfAdhesionInsteadOfTheMeanSurfaceEnergy) {
  const auto library = load_text(
      changed("mean_surface_energy = { value = \"2.228 mJ/m2\"", "work_of_adhesion = { value = \"4.456 mJ/m2\""));
  ASSERT_TRUE(library.has_value()) << library.error().message;
  EXPECT_DOUBLE_EQ(library->materials.front().contact.mean_surface_energy.si, 2.228e-3);
  EXPECT_THAT(refusal(std::string(kOneMaterial) + "work_of_adhesion = { value = \"1 mJ/m2\", source = \"h\" }\n"),
              HasSubstr("not both"));
  EXPECT_THAT(refusal(changed("mean_surface_energy = { value = \"2.228 mJ/m2\", source = \"e\" }", "")),
              HasSubstr("material.mean_surface_energy: is missing"));
}

TEST(MaterialFile, IsRigidUnlessItSaysHowElastic) {
  EXPECT_TRUE(std::isinf(load_text(kOneMaterial).value().materials.front().contact.reduced_modulus.si));
  const std::string direct = "reduced_modulus = { value = \"51.5 GPa\", source = \"h\" }\n";
  const auto library = load_text(kOneMaterial + direct);
  ASSERT_TRUE(library.has_value()) << library.error().message;
  EXPECT_EQ(library->materials.front().contact.reduced_modulus.si, 5.15e10);
  const std::string tip = "tip_modulus = { value = \"250 GPa\", source = \"h\" }\n";
  EXPECT_THAT(refusal(kOneMaterial + direct + tip), HasSubstr("line 13: material.reduced_modulus"));
  EXPECT_THAT(refusal(kOneMaterial + tip), HasSubstr("material.tip_poisson_ratio: is missing"));
}

TEST(MaterialFile, RefusesElasticityThatNoBodyHas) {
  const auto bodies = [](const char* modulus, const char* ratio) {
    return std::string(kOneMaterial) + "tip_modulus = { value = \"250 GPa\", source = \"h\" }\n" +
           "tip_poisson_ratio = { value = 0.23, source = \"h\" }\n" + "sample_modulus = { value = \"" + modulus +
           "\", source = \"h\" }\n" + "sample_poisson_ratio = { value = " + ratio + ", source = \"h\" }\n";
  };
  EXPECT_TRUE(load_text(bodies("60 GPa", "0.25")).has_value());
  EXPECT_THAT(refusal(bodies("1e30 Pa", "0.25")), HasSubstr("line 15: material.sample_modulus: sample modulus"));
  EXPECT_THAT(refusal(bodies("60 GPa", "0.6")), HasSubstr("line 16: material.sample_poisson_ratio"));
  EXPECT_THAT(refusal(bodies("60 GPa", "-1")), HasSubstr("is not above -1 and at most 0.5")) << "it would be rigid";
  EXPECT_TRUE(load_text(bodies("60 GPa", "-0.5")).has_value()) << "auxetic bodies exist";
  EXPECT_THAT(refusal(bodies("60 GPa", "nan")), HasSubstr("line 16: material.sample_poisson_ratio"));
  EXPECT_THAT(refusal(bodies("60 GPa", "\"0.25\"")), HasSubstr("must be a number without a unit"));
}

TEST(MaterialFile, KnowsEstimatesAndDefaults) {
  const auto library = load_text(changed("source = \"d\" }", "source = \"d\", estimated = true }"));
  ASSERT_TRUE(library.has_value()) << library.error().message;
  const auto& sources = library->materials.front().sources;
  EXPECT_TRUE(find_source(sources, "hamaker")->estimated);
  EXPECT_FALSE(find_source(sources, "tip_radius")->estimated);
  EXPECT_THAT(find_source(sources, "atomic_distance")->source, HasSubstr("default"));
  EXPECT_THAT(refusal(changed("source = \"d\" }", "source = \"d\", estimated = 1 }")),
              HasSubstr("line 9: material.hamaker.estimated: must be true or false"));
}

TEST(MaterialFile, KnowsHowTheLeverMoves) {
  const auto library = load_text(std::string(kOneMaterial) + "resonance = { value = \"38 kHz\", source = \"h\" }\n" +
                                 "quality_factor = { value = 40, source = \"h\" }\n");
  ASSERT_TRUE(library.has_value()) << library.error().message;
  const physics::LeverDynamics& lever = library->materials.front().lever;
  EXPECT_EQ(lever.resonance.si, 38e3);
  EXPECT_EQ(lever.quality_factor, 40.0);
  EXPECT_EQ(lever.temperature.si, 298.15);
  EXPECT_THAT(refusal(std::string(kOneMaterial) + "quality_factor = { value = -1, source = \"h\" }\n"),
              HasSubstr("line 13: material.quality_factor"));
}

TEST(MaterialFile, RefusesANameTwiceOrTooLong) {
  EXPECT_THAT(refusal(std::string(kOneMaterial) + kOneMaterial), HasSubstr("material.name: \"mica\" is used twice"));
  EXPECT_THAT(refusal(changed("\"mica\"", "\"" + std::string(60, 'm') + "\"")), HasSubstr("is longer than 47 bytes"));
}

// A material's name is a cell in the tables of lessons, and a word after --material.
TEST(MaterialFile, RefusesANameThatBeginsLikeAFormulaOrAnOption) {
  for (const std::string name : {"=1+1", "+mica", "-mica", "@mica"}) {
    EXPECT_THAT(
        refusal(changed("\"mica\"", "\"" + name + "\"")),
        HasSubstr("line 2: material.name: \"" + name + "\" begins like a formula of a spreadsheet or an option"));
  }
}

TEST(MaterialFile, SaysWhenItCannotBeReadOrParsed) {
  const auto missing = load_materials("/no/such/file.toml");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().message, "material file /no/such/file.toml: cannot be read: there is no such file");
  EXPECT_THAT(load_materials("/").error().message, HasSubstr("cannot be read: it is a folder, not a file"));
  EXPECT_THAT(refusal(changed("title = \"Mica\"", "title = \"Mica")), HasSubstr("line 3: "));
}

TEST(MaterialFile, NeverCrashesOnATruncatedOne) {
  const std::string whole = kOneMaterial;
  const std::size_t last_needed_key = whole.find("mean_surface_energy");
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    const auto result = load_text(whole.substr(0, length));
    EXPECT_TRUE(!result.has_value() || length > last_needed_key) << length;
  }
}

}  // namespace material_library_test
}  // namespace afm::scene
