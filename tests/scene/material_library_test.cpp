// SPDX-License-Identifier: Apache-2.0
#include "scene/material_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace afm::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kShipped = AFM_SOURCE_DIR "/assets/materials.toml";

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

TEST(MaterialLibrary, HoldsThePapersThreeMaterials) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value()) << library.error().message;
  ASSERT_EQ(library->materials.size(), 3U);
  const MaterialEntry* gold = library->find("gold");
  ASSERT_NE(gold, nullptr);
  EXPECT_EQ(gold->interaction.tip_radius.si, 5e-8);
  EXPECT_EQ(gold->interaction.spring_constant.si, 0.1);
  EXPECT_TRUE(std::isinf(gold->interaction.sample_stiffness.si));
  EXPECT_EQ(gold->interaction.hamaker.si, 1.2e-19);
  EXPECT_EQ(gold->interaction.mean_surface_energy.si, 0.015915);
  EXPECT_EQ(gold->experiment_f_ad.si, 1e-8);
  EXPECT_THAT(gold->note, HasSubstr("SiO2"));
}

TEST(MaterialLibrary, CitesASourceForEveryNumber) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value());
  for (const MaterialEntry& entry : library->materials) {
    EXPECT_EQ(entry.sources.size(), 7U) << entry.name;
    for (const auto& sourced : entry.sources) EXPECT_FALSE(sourced.source.empty()) << entry.name << sourced.key;
  }
}

TEST(MaterialLibrary, ListsTheKnownNamesForAnUnknownOne) {
  const auto library = load_materials(kShipped);
  ASSERT_TRUE(library.has_value());
  EXPECT_EQ(library->find("Mica"), nullptr);
  const auto missing = library->require("unobtainium");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_EQ(missing.error().message, "unknown material \"unobtainium\"; known are mica, gold, si3n4");
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
  EXPECT_THAT(refusal(changed("\"Mica\"", "7")), HasSubstr("line 3: material.title: must be a text"));
  EXPECT_THAT(refusal(changed("{ value = \"50 nm\", source = \"a\" }", "50e-9")),
              HasSubstr("line 6: material.tip_radius: must be written { value"));
  EXPECT_THAT(refusal(changed("\"50 nm\"", "50")), HasSubstr("material.tip_radius.value: must be a text"));
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
  EXPECT_THAT(refusal(changed("2.228", "0.1")), HasSubstr("line 10: material.mean_surface_energy"));
  EXPECT_THAT(refusal(changed("1.4 nN", "-1.4 nN")), HasSubstr("line 12: material.experiment_f_ad"));
}

TEST(MaterialFile, RefusesANameTwiceOrTooLong) {
  EXPECT_THAT(refusal(std::string(kOneMaterial) + kOneMaterial), HasSubstr("material.name: \"mica\" is used twice"));
  EXPECT_THAT(refusal(changed("\"mica\"", "\"" + std::string(60, 'm') + "\"")), HasSubstr("is longer than 47 bytes"));
}

TEST(MaterialFile, SaysWhenItCannotBeReadOrParsed) {
  const auto missing = load_materials("/no/such/file.toml");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().message, "material file /no/such/file.toml: cannot be read; check the path and its rights");
  EXPECT_THAT(refusal(changed("title = \"Mica\"", "title = \"Mica")), HasSubstr("line 3: "));
}

TEST(MaterialFile, NeverCrashesOnATruncatedOne) {
  const std::string whole = kOneMaterial;
  for (std::size_t length = 0; length + 2 < whole.size(); length += 7) {
    const auto result = load_text(whole.substr(0, length));
    EXPECT_FALSE(result.has_value()) << length;
  }
}

}  // namespace
}  // namespace afm::scene
