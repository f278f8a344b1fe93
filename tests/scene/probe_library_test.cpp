// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/probe_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace probe_library_test {

using testing::HasSubstr;

const std::string kShipped = support::source("assets/probes.toml");

constexpr const char* kOneProbe = R"([[probe]]
name = "mine"
title = "My lever"
shape = "rectangular"
tip = "silicon"
tip_radius = { value = "8 nm", source = "a" }
spring_constant = { value = "0.2 N/m", source = "b" }
resonance_in_air = { value = "13 kHz", source = "c" }
quality_factor_in_air = { value = 100, source = "d" }
tip_modulus = { value = "165 GPa", source = "e" }
tip_poisson_ratio = { value = 0.22, source = "f" }
)";

core::Result<ProbeLibrary> load_text(const std::string& text) {
  const support::ScratchFolder folder;
  return load_probes(folder.write("probes.toml", text));
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = kOneProbe;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  const auto result = load_text(text);
  if (result) return "accepted";
  EXPECT_EQ(result.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
  return result.error().message;
}

MaterialEntry material(const char* name) {
  return *load_materials(support::source("assets/materials.toml")).value().find(name);
}

TEST(ProbeLibrary, HoldsProbesThatEveryMaterialAccepts) {
  const auto probes = load_probes(kShipped);
  ASSERT_TRUE(probes.has_value()) << probes.error().message;
  EXPECT_GE(probes->probes.size(), 8U);
  for (const ProbeEntry& probe : probes->probes) {
    const MaterialEntry pdms = with_probe(material("pdms-air"), probe);
    EXPECT_NO_THROW(physics::validate(pdms.contact)) << probe.name;
    for (const auto& sourced : probe.sources) EXPECT_FALSE(sourced.source.empty()) << probe.name << sourced.key;
  }
}

// 169 GPa x 50 um x (2 um)^3/(4 (450 um)^3) = 0.18546 N/m; f_1 = 0.16154 t/L^2 sqrt(E/rho) = 13.59 kHz
TEST(ProbeLibrary, ComputesWhatTheGeometrySays) {
  const auto probes = load_probes(kShipped);
  ASSERT_TRUE(probes.has_value());
  const ProbeEntry* probe = probes->find("silicon-450x50x2");
  ASSERT_NE(probe, nullptr);
  EXPECT_NEAR(probe->spring_constant.si, 0.185460, 1e-6);
  EXPECT_NEAR(probe->resonance_in_air.value().si, 13.59e3, 10.0);
  EXPECT_TRUE(find_source(probe->sources, "spring_constant")->estimated);
}

TEST(ProbeLibrary, ListsTheKnownNamesForAnUnknownOne) {
  const auto missing = load_probes(kShipped).value().require("tweezers");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(missing.error().message, HasSubstr("unknown probe \"tweezers\"; choose mlct-c"));
}

TEST(Probe, ReplacesLeverAndTipButNotThePairOfMaterials) {
  const ProbeEntry probe = load_text(kOneProbe).value().probes.front();
  const MaterialEntry before = material("mica-air");
  const MaterialEntry after = with_probe(before, probe);
  EXPECT_EQ(after.contact.tip_radius.si, 8e-9);
  EXPECT_EQ(after.contact.spring_constant.si, 0.2);
  EXPECT_EQ(after.lever.resonance.si, 13e3);
  EXPECT_EQ(after.lever.quality_factor, 100.0);
  EXPECT_EQ(after.contact.hamaker, before.contact.hamaker);
  EXPECT_EQ(after.contact.mean_surface_energy, before.contact.mean_surface_energy);
  EXPECT_THAT(after.note, HasSubstr("those of a Si3N4 tip; the probe's tip is silicon"));
  // 1/E* = (1 - 0.22^2)/165 GPa + (1 - 0.25^2)/60 GPa
  EXPECT_NEAR(after.contact.reduced_modulus.si, 1.0 / (0.9516 / 165e9 + 0.9375 / 60e9), 1.0);
  EXPECT_EQ(find_source(after.sources, "tip_radius")->source, "My lever: a");
}

TEST(Probe, LeavesTheMediumsResonanceWhereItKnowsOnlyThatInAir) {
  const ProbeEntry probe = load_text(kOneProbe).value().probes.front();
  const MaterialEntry after = with_probe(material("mica"), probe);
  EXPECT_EQ(after.lever.resonance.si, 12e3);
  EXPECT_EQ(after.lever.quality_factor, 2.5);
}

TEST(ProbeFile, ComputesAVShapedLever) {
  const std::string lever =
      "length = { value = \"200 um\", source = \"g\" }\nbase_width = { value = \"150 um\", source = \"g\" }\n"
      "arm_width = { value = \"28 um\", source = \"g\" }\nthickness = { value = \"0.5 um\", source = \"g\" }\n"
      "lever_modulus = { value = \"250 GPa\", source = \"g\" }\n";
  std::string text = changed("spring_constant = { value = \"0.2 N/m\", source = \"b\" }\n", lever);
  text.replace(text.find("rectangular"), 11, "v-shaped");
  const auto probes = load_text(text);
  ASSERT_TRUE(probes.has_value()) << probes.error().message;
  EXPECT_NEAR(probes->probes.front().spring_constant.si, 0.05, 0.02);
}

TEST(ProbeFile, NamesLineAndKeyOfWhatIsWrong) {
  EXPECT_TRUE(load_text(kOneProbe).has_value());
  EXPECT_THAT(refusal(changed("tip_radius", "tip_raduis")), HasSubstr("line 6: probe.tip_raduis: unknown key"));
  EXPECT_THAT(refusal(changed("rectangular", "round")), HasSubstr("line 4: probe.shape: is \"round\""));
  EXPECT_THAT(refusal(changed("8 nm", "-8 nm")), HasSubstr("line 6: probe.tip_radius: tip radius -8 nm"));
  EXPECT_THAT(refusal(changed("0.2 N/m", "0 N/m")), HasSubstr("line 7: probe.spring_constant"));
  EXPECT_THAT(refusal(changed("13 kHz", "13 nm")), HasSubstr("line 8: probe.resonance_in_air: cannot read"));
  EXPECT_THAT(refusal(changed("13 kHz", "0 kHz")), HasSubstr("line 8: probe.resonance_in_air: must be positive"));
  EXPECT_THAT(refusal(changed("value = 100", "value = -1")), HasSubstr("line 9: probe.quality_factor_in_air"));
  EXPECT_THAT(refusal(changed("165 GPa", "1e30 Pa")), HasSubstr("line 10: probe.tip_modulus"));
  EXPECT_THAT(refusal(changed("spring_constant = { value = \"0.2 N/m\", source = \"b\" }", "")),
              HasSubstr("probe.length: is missing"));
  EXPECT_THAT(refusal(std::string(kOneProbe) + "lever_modulus = { value = \"1 GPa\", source = \"g\" }\n"),
              HasSubstr("has an effect only if no spring_constant is given"));
  const std::string with_length = std::string(kOneProbe) + "length = { value = \"225 um\", source = \"g\" }\n";
  EXPECT_TRUE(load_text(with_length).has_value());
  for (const char* impossible : {"-225 um", "0 um", "225 mm"}) {
    std::string text = with_length;
    EXPECT_THAT(refusal(text.replace(text.find("225 um"), 6, impossible)), HasSubstr("probe.length: length "));
  }
  EXPECT_THAT(refusal(std::string(kOneProbe) + kOneProbe), HasSubstr("\"mine\" is used twice"));
}

TEST(ProbeFile, NeverCrashesOnATruncatedOne) {
  const std::string whole = kOneProbe;
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    EXPECT_TRUE(!load_text(whole.substr(0, length)).has_value() || length > whole.find("spring_constant")) << length;
  }
}

}  // namespace probe_library_test
}  // namespace afm::scene
