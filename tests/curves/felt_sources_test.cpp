// SPDX-License-Identifier: Apache-2.0
// Invariant: a session names the source of every number that was felt
#include "curves/felt_sources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "curves/contact_options.h"
#include "curves/curve_output.h"
#include "curves/sample_model.h"
#include "support/places.h"

namespace afm::curves {
namespace felt_sources_test {

using json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

ContactOptions of(const std::string& material) {
  ContactOptions options;
  options.assets_dir = support::source("assets");
  options.material = material;
  options.model = "dmt";
  return options;
}

ContactSetup loaded(const std::string& material) { return contact_setup(of(material)).value(); }

// The numbers of the loaded material, as the servo gets them.
scene::SharedContact felt(const ContactSetup& setup) { return make_sample_model(setup).value().parameters; }

TEST(FeltSources, AreThoseOfTheMaterialIncludingItsLaw) {
  const ContactSetup mica = loaded("mica");
  const json sources = json::parse(felt_sources(mica, felt(mica)));
  EXPECT_EQ(sources["tip_radius"]["value"], "50 nm");
  EXPECT_EQ(sources["tip_radius"]["source"], "Liu & Peng, Table 1");
  EXPECT_EQ(sources["tip_radius"]["estimated"], false);
  EXPECT_EQ(sources["law"]["value"], "dmt");
  EXPECT_THAT(sources["law"]["source"].get<std::string>(), HasSubstr("Derjaguin, Muller & Toporov 1975"));
  EXPECT_EQ(sources, sources_json(acting_sources(mica)));
}

TEST(FeltSources, NameTheProbeAndWhatWasTyped) {
  ContactOptions options = of("mica");
  options.probe = "mlct-c";
  options.values["hamaker"] = "30zJ";
  const ContactSetup setup = contact_setup(options).value();
  const json sources = json::parse(felt_sources(setup, felt(setup)));
  EXPECT_NE(sources["spring_constant"],
            json::parse(felt_sources(loaded("mica"), felt(loaded("mica"))))["spring_constant"]);
  EXPECT_THAT(sources["hamaker"]["source"].get<std::string>(), HasSubstr("--hamaker on the command line"));
}

TEST(FeltSources, SayWhichNumberWasChangedWhileItWasFelt) {
  const ContactSetup mica = loaded("mica");
  scene::SharedContact stiffer = felt(mica);
  stiffer.contact.spring_constant = physics::Stiffness(0.2);
  stiffer.law = physics::Law::Hertz;
  const json sources = json::parse(felt_sources(mica, stiffer));
  EXPECT_EQ(sources["spring_constant"]["value"], "200 mN/m");
  EXPECT_EQ(sources["spring_constant"]["source"], "changed while it was felt");
  EXPECT_EQ(sources["tip_radius"]["source"], "Liu & Peng, Table 1");
  EXPECT_EQ(sources["law"]["source"], "Hertz 1882");
  EXPECT_FALSE(sources.contains("hamaker")) << "Hertz' law has none";
}

TEST(FeltSources, HaveThoseOfFrictionIfItIsFelt) {
  ContactSetup mica = loaded("mica");
  EXPECT_FALSE(json::parse(felt_sources(mica, felt(mica))).contains("friction_coefficient"));
  mica.friction = physics::FrictionLaw::Amontons;
  EXPECT_EQ(json::parse(felt_sources(mica, felt(mica)))["friction_coefficient"]["estimated"], true);
}

// A file of 0.2.0 has no sources: those of the built-in material, as far as its numbers are the same.
TEST(SessionNumbers, OfAnOlderFileAreLookedUp) {
  const ContactSetup mica = loaded("mica");
  scene::SharedContact parameters = felt(mica);
  parameters.contact.hamaker.si *= 2.0;
  parameters.contact.tip_radius.si *= 1.0 + 1e-15;  // rounding of another version
  const json numbers = session_numbers("mica", parameters, "", support::source("assets"));
  EXPECT_EQ(numbers["parameters"]["hamaker_J"], parameters.contact.hamaker.si);
  EXPECT_EQ(numbers["sources"]["tip_radius"]["source"], "Liu & Peng, Table 1");
  EXPECT_EQ(numbers["sources"]["hamaker"]["source"], "recorded in the session, without a source");
  EXPECT_FALSE(numbers["estimated"].empty());
}

TEST(SessionNumbers, OfAnUnknownMaterialHaveNoOtherSourceThanTheFile) {
  const scene::SharedContact parameters = felt(loaded("mica"));
  const json numbers = session_numbers("somebody's gel", parameters, "", support::source("assets"));
  EXPECT_EQ(numbers["parameters"]["material"], "somebody's gel");
  EXPECT_EQ(numbers["parameters"]["work_of_adhesion_J_per_m2"], 2.0 * parameters.contact.mean_surface_energy.si);
  for (const auto& [key, source] : numbers["sources"].items()) {
    if (key == "law") continue;
    EXPECT_EQ(source["source"], "recorded in the session, without a source") << key;
    EXPECT_NE(source["value"], "") << key;
  }
  EXPECT_TRUE(numbers["estimated"].empty());
}

TEST(SessionNumbers, TakeTheSourcesThatTheFileHas) {
  const ContactSetup gold = loaded("gold");
  const std::string recorded = felt_sources(gold, felt(gold));
  const json numbers = session_numbers("gold", felt(gold), recorded, "/nowhere");
  EXPECT_EQ(numbers["sources"], json::parse(recorded));
  EXPECT_EQ(source_lines(""), "");
  EXPECT_THAT(source_lines(recorded), AllOf(StartsWith("# source of law: dmt, Derjaguin"),
                                            HasSubstr("\n# source of tip_radius: 50 nm, Liu & Peng, Table 1\n")));
}

}  // namespace felt_sources_test
}  // namespace afm::curves
