// SPDX-License-Identifier: Apache-2.0
// That each row of kLawTable is true: what it says acts, acts, and nothing else does.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "mica.h"
#include "physics/dynamic_model.h"
#include "physics/force_laws.h"
#include "physics/law.h"
#include "physics/law_tables.h"
#include "support/places.h"

namespace afm::physics {
namespace law_traits_test {

using namespace literals;

constexpr Pressure kRigid(std::numeric_limits<double>::infinity());

std::vector<double> forces_of(Law law, const ContactParameters& contact) {
  const auto tables = build_law_tables(law, contact);
  const CycleFigures& figures = tables->figures;
  std::vector<double> forces{figures.force_before_jtc.si, figures.force_after_jtc.si, figures.force_before_joc.si};
  for (const Length z : {-10_nm, -5_nm, -2_nm, -1_nm}) forces.push_back(tables->attached.force(z).si);
  for (const Length z : {4_nm, 6_nm, 10_nm, 15_nm}) forces.push_back(tables->free.force(z).si);
  // force of the lever at each jump
  for (const Length z : {figures.z_jtc, figures.z_joc}) forces.push_back((contact.spring_constant * z).si);
  return forces;
}

// Whether another value of the member gives another curve.
template <auto Member>
bool acts(Law law) {
  constexpr double kFactor = 1.25, kRounding_n = 1e-14;
  ContactParameters changed = elastic_mica();
  changed.*Member = kFactor * (changed.*Member);
  const auto before = forces_of(law, elastic_mica()), after = forces_of(law, changed);
  return !std::equal(before.begin(), before.end(), after.begin(),
                     [](double a, double b) { return std::abs(a - b) < kRounding_n; });
}

class EveryComputedLaw : public testing::TestWithParam<Law> {
 protected:
  const LawTraits& traits_ = traits_of(GetParam());
};

TEST_P(EveryComputedLaw, DependsOnWhatItsRowNamesAndOnNothingElse) {
  EXPECT_EQ(acts<&ContactParameters::hamaker>(traits_.law), traits_.van_der_waals);
  EXPECT_EQ(acts<&ContactParameters::mean_surface_energy>(traits_.law), traits_.adhesion);
  EXPECT_EQ(acts<&ContactParameters::atomic_distance>(traits_.law), traits_.atomic_distance);
  EXPECT_EQ(acts<&ContactParameters::reduced_modulus>(traits_.law), traits_.modulus != ModulusUse::Unused);
}

TEST_P(EveryComputedLaw, NeedsAFiniteModulusWhereItsRowSaysSo) {
  ContactParameters rigid = elastic_mica();
  rigid.reduced_modulus = kRigid;
  if (traits_.modulus == ModulusUse::Needed) {
    EXPECT_THROW(build_law_tables(traits_.law, rigid), UnphysicalValue);
  } else {
    EXPECT_NO_THROW(build_law_tables(traits_.law, rigid));
  }
}

TEST_P(EveryComputedLaw, MovesAMassWhereItsRowSaysSo) {
  const auto move = [&] { DynamicModel(traits_.law, elastic_mica(), {12_kHz, 2.5, 0_K}, Time(1e-3)); };
  if (traits_.dynamic) {
    EXPECT_NO_THROW(move());
  } else {
    EXPECT_THROW(move(), std::invalid_argument);
    EXPECT_THROW(fixed_grips(traits_.law, elastic_mica()), std::invalid_argument);
  }
}

TEST_P(EveryComputedLaw, IsDescribedInTheDocuments) {
  for (const char* name : {"docs/physics.md", "docs/manual/measure.md"}) {
    std::ifstream file(support::source(name));
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_NE(text.find("`" + std::string(traits_.name) + "`"), std::string::npos) << traits_.name << " in " << name;
  }
}

TEST_P(EveryComputedLaw, HasTheSourceOfItsRowInTheDocument) {
  std::ifstream file(support::source("docs/physics.md"));
  const std::string row_of_law = "| `" + std::string(traits_.name) + "` | ";
  std::string row;
  while (std::getline(file, row) && !row.starts_with(row_of_law)) {
  }
  const std::string source(source_of(traits_.law));
  EXPECT_NE(row.find("| " + (source == "Liu & Peng" ? "the paper" : source) + " |"), std::string::npos)
      << traits_.name << " has the source \"" << source << "\", and in the document: " << row;
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryComputedLaw, testing::ValuesIn(laws_with(&LawTraits::computed)),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(LawTable, HasNoNameTwiceAndNoneThatIsAModelOfAnotherKind) {
  for (const LawTraits& row : kLawTable) {
    EXPECT_EQ(law_of(row.name), row.law);
    EXPECT_TRUE(row.computed || !row.dynamic) << row.name;
    for (const char* taken : {"auto", "paper-rule", "unknown", ""}) EXPECT_NE(row.name, taken);
  }
}

}  // namespace law_traits_test
}  // namespace afm::physics
