// SPDX-License-Identifier: Apache-2.0
#include "app/commands/paper_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "curves/paper_tables.h"
#include "support/places.h"

namespace afm::app {
namespace paper_command_test {

using testing::HasSubstr;
namespace fs = std::filesystem;

class PaperCommand : public testing::Test {
 protected:
  PaperCommand()
      : folder_(fs::temp_directory_path() /
                (std::string("touchafm_paper_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    options_ = {support::source("assets/materials.toml"), "", folder_.string()};
  }
  ~PaperCommand() override { fs::remove_all(folder_); }

  std::string text_of(const char* name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  fs::path folder_;
  PaperOptions options_;
};

TEST_F(PaperCommand, WritesTablesAndFigures) {
  ASSERT_TRUE(write_paper(options_).has_value());
  for (const char* name : {"paper.md", "paper.json", "table1.csv", "table2.csv", "fig2.svg", "fig5e.svg"}) {
    EXPECT_FALSE(text_of(name).empty()) << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 6);
}

TEST_F(PaperCommand, NamesEveryErratumAndSaysThatAdhesionIsCircular) {
  ASSERT_TRUE(write_paper(options_).has_value());
  const std::string markdown = text_of("paper.md");
  ASSERT_GE(curves::errata().size(), 3U);
  for (const curves::Erratum& erratum : curves::errata()) EXPECT_THAT(markdown, HasSubstr(std::string(erratum.name)));
  EXPECT_THAT(markdown, HasSubstr("**circular**"));
}

TEST_F(PaperCommand, PutsThePrintedAndTheExactNumberBesideEachOther) {
  ASSERT_TRUE(write_paper(options_).has_value());
  const auto json = nlohmann::json::parse(text_of("paper.json"));
  const auto& gap = json["table1"]["mica"]["D_attr_m"];
  EXPECT_NEAR(gap["printed"], 0.799e-9, 1e-21);
  EXPECT_NEAR(gap["exact"], 1.59834899139e-9, 1e-18);
  EXPECT_EQ(gap["erratum"], "swapped columns");
  EXPECT_TRUE(gap["measured"].is_null());  // null, since a gap cannot be measured
  const auto& attraction = json["table2"]["mica"]["F_attr_N"];
  EXPECT_NEAR(attraction["printed"], 0.2387e-9, 1e-21);
  EXPECT_NEAR(attraction["exact"], 2.39752348708e-10, 1e-19);
  EXPECT_NEAR(attraction["experiment"], 0.24e-9, 1e-21);
}

TEST_F(PaperCommand, AgreesWithThePrintWhereNoErratumIsNamed) {
  const auto library = scene::load_materials(options_.materials_file).value().only(scene::kPaperMaterials);
  ASSERT_TRUE(library.has_value());
  const auto tables = curves::paper_tables(*library, {});
  ASSERT_TRUE(tables.has_value());
  int clean = 0;
  for (const auto* table : {&tables->table1, &tables->table2}) {
    for (const curves::TableCell& cell : *table) {
      // half of the last digit that three decimals or more have
      const bool agrees = std::abs(std::stod(cell.printed) - cell.exact) <= 0.0005;
      if (cell.erratum.empty()) {
        EXPECT_TRUE(agrees) << cell.material << " " << cell.quantity;
        ++clean;
      }
    }
  }
  EXPECT_EQ(clean, 5);
}

TEST_F(PaperCommand, MeasuresARunOfTheModelWhereNoDemoIsGiven) {
  ASSERT_TRUE(write_paper(options_).has_value());
  const auto json = nlohmann::json::parse(text_of("paper.json"));
  for (const char* table : {"table1", "table2"}) {
    ASSERT_EQ(json[table].size(), 3U) << table;
    for (const auto& [material, quantities] : json[table].items()) {
      for (const char* quantity : {"F_attr_N", "F_ad_N"}) {
        const auto& cell = quantities[quantity];
        EXPECT_NEAR(cell["measured"].get<double>() / cell["exact"].get<double>(), 1.0, 1e-9) << material << quantity;
      }
    }
  }
  EXPECT_THAT(text_of("paper.md"), HasSubstr("Mica: printed | Mica: exact | Mica: measured in the run"));
}

// The numbers of the same engine from an independent solver, with the moduli rounded to three digits.
TEST_F(PaperCommand, SaysWhatContactMechanicsSaysOfTheSameSamples) {
  ASSERT_TRUE(write_paper(options_).has_value());
  const auto json = nlohmann::json::parse(text_of("paper.json"))["contact_mechanics"];
  struct Expected {
    const char* material;
    double force_after_nn, z_out_nm, from_zero_nm, loop_aj;
  };
  for (const Expected& e :
       {Expected{"mica", -0.2034, 14.3819, 14.0203, 9.5284}, Expected{"gold", -0.3814, 100.3162, 100.0604, 499.369},
        Expected{"si3n4", -0.0768, 17.0393, 16.6728, 4.8877}}) {
    const auto& chosen = json[e.material]["chosen"];
    EXPECT_EQ(json[e.material]["law"], "dmt");
    EXPECT_NEAR(chosen["snap_in_force_after_N"].get<double>() * 1e9, e.force_after_nn, 1e-4) << e.material;
    EXPECT_NEAR(chosen["pull_off_z_m"].get<double>() * 1e9 / e.z_out_nm, 1.0, 2e-4) << e.material;
    EXPECT_NEAR(chosen["pull_off_from_contact_zero_m"].get<double>() * 1e9 / e.from_zero_nm, 1.0, 2e-4) << e.material;
    EXPECT_NEAR(chosen["loop_energy_J"].get<double>() * 1e18 / e.loop_aj, 1.0, 3e-4) << e.material;
  }
  EXPECT_THAT(text_of("paper.md"), HasSubstr("Gold: paper | Gold: dmt"));
}

TEST_F(PaperCommand, SaysWhatItsSurveyShowsAndWhatItDoesNot) {
  ASSERT_TRUE(write_paper(options_).has_value());
  EXPECT_THAT(text_of("paper.md"),
              testing::AllOf(HasSubstr("Table 3 is consistent"), HasSubstr("p = 0.42; d = 0.26 [-0.37, 0.88]"),
                             HasSubstr("all 899"), HasSubstr("p = 0.042; d_z = 0.49 [0.02, 0.95]"),
                             HasSubstr("p = 0.065"), HasSubstr("does not follow")));
  const auto json = nlohmann::json::parse(text_of("paper.json"))["table3"];
  EXPECT_EQ(json["questions"].size(), 8U);
  EXPECT_NEAR(json["haptics_against_graphics"]["unpaired"]["p"], 0.4228763481, 1e-9);
  EXPECT_NEAR(json["haptics_against_graphics"]["kindest_paired_t"]["p"], 0.04208628671, 1e-9);
  EXPECT_NEAR(json["haptics_against_graphics"]["kindest_sign_test"]["p"], 0.0654296875, 1e-9);
}

TEST_F(PaperCommand, ShowsWhatARunMeasured) {
  fs::create_directories(folder_);
  options_.summary_file = (folder_ / "summary.json").string();
  std::ofstream(options_.summary_file)
      << R"({"materials": {"mica": {"f_attr_N": 2.5e-10, "f_ad_N": 1.4e-9, "z_jtc_m": 2.4e-9, "z_joc_m": 1.4e-8}}})";
  ASSERT_TRUE(write_paper(options_).has_value());
  EXPECT_THAT(text_of("paper.md"), HasSubstr("measured in the run"));
  EXPECT_NEAR(nlohmann::json::parse(text_of("paper.json"))["table1"]["mica"]["F_attr_N"]["measured"], 2.5e-10, 1e-20);
}

TEST_F(PaperCommand, LeavesNothingBehindForABadSummary) {
  options_.summary_file = support::source("assets/materials.toml");
  const auto done = write_paper(options_);
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(PaperCommand, FailsOnAFolderThatCannotBeWritten) {
  options_.out = "/dev/null/paper";
  const auto done = write_paper(options_);
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().category, core::ErrorCategory::Failed);
  EXPECT_THAT(done.error().message, HasSubstr("/dev/null/paper"));
}

}  // namespace paper_command_test
}  // namespace afm::app
