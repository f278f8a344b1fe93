// SPDX-License-Identifier: Apache-2.0
// Every report, table and file names the program and its version, so that it can be cited.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/options/command.h"
#include "core/version.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace named_program_test {

using support::run_touchafm;
using testing::HasSubstr;

const std::string kScan = "scan --material mica --size 20nm --pixels 8";

std::string data(const std::string& file) { return support::source("tests/data/afm/" + file); }

// Commands with --json.
std::vector<std::string> reports() {
  return {"curve --material mica",
          "curve --material mica --sweep tip-radius=5nm:50nm:3",
          "curve --material mica --mode fm --resonance 30kHz --amplitude 1nm",
          "curve --material mica --mode tapping --free-amplitude 20nm --resonance 300kHz --quality-factor 400 "
          "--spring-constant 40N/m --at 15nm",
          "analyse " + data("bom.tab"),
          "analyse " + data("qnm-log.spm"),
          "lever --sader --length 120um --width 30um --resonance 70kHz --quality-factor 150",
          kScan + " --rate 20Hz",
          "particles gold-row",
          "particles scratch-pmma",
          "replay " + support::source("tests/formats/0.2.0/session-mica.afms"),
          "render --describe --gltf " + support::source("assets/models/probe.glb"),
          "doctor --seconds 0.1",
          "devices",
          "wall " + support::source("assets/walls/powerwall.toml")};
}

std::string contents(const std::string& command, const std::string& file) {
  const auto made = run_touchafm(command + " --out " + file);
  EXPECT_EQ(made.exit_code, 0) << command << made.err;
  return core::read_file(file).value_or("");
}

TEST(NamedProgram, IsInEveryReport) {
  for (const std::string& command : reports()) {
    const auto made = run_touchafm(command + " --json");
    ASSERT_EQ(made.exit_code, 0) << command << made.err;
    const auto printed = nlohmann::json::parse(made.out);
    // devices and wall print a list
    const auto reports_of_command = printed.is_array() ? printed : nlohmann::json::array({printed});
    EXPECT_FALSE(reports_of_command.empty()) << command;
    for (const auto& report : reports_of_command) {
      EXPECT_EQ(report.value("software", ""), "TouchAFM") << command;
      EXPECT_EQ(report.value("software_version", ""), core::kVersion) << command;
    }
  }
}

TEST(NamedProgram, IsLookedForInEveryCommandWithJson) {
  const auto commands = reports();
  for (const Command& command : kCommands) {
    const std::string name(command.name);
    if (run_touchafm(name + " --help").out.find("--json") == std::string::npos) continue;
    EXPECT_TRUE(std::any_of(commands.begin(), commands.end(),
                            [&](const std::string& each) { return (each + " ").starts_with(name + " "); }))
        << name << " --json is not in the list of this test";
  }
}

TEST(NamedProgram, IsBesideParametersAndSourcesInTheReportOnASession) {
  const auto made = run_touchafm("replay --json " + support::source("tests/formats/0.2.0/session-mica.afms"));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto report = nlohmann::json::parse(made.out);
  EXPECT_EQ(report["parameters"]["tip_radius_m"], 50e-9);
  EXPECT_EQ(report["sources"]["tip_radius"]["source"], "Liu & Peng, Table 1");
  EXPECT_THAT(report["sources"]["law"]["source"].get<std::string>(), HasSubstr("Derjaguin"));
}

TEST(NamedProgram, EndsEveryReportInWords) {
  const std::string end = "\ncomputed by " + core::written_by() + "\n";
  for (const std::string& command :
       {"analyse " + data("bom.tab"), "analyse " + data("qnm-log.spm"), std::string("material"),
        std::string("material gold"), std::string("particles gold-row"), std::string("particles scratch-pmma"),
        std::string("lever --sader --length 120um --width 30um --resonance 70kHz --quality-factor 150"),
        "replay " + support::source("tests/formats/0.2.0/session-mica.afms")}) {
    const auto made = run_touchafm(command);
    EXPECT_EQ(made.exit_code, 0) << command << made.err;
    EXPECT_TRUE(made.out.ends_with(end)) << command << made.out;
  }
}

TEST(NamedProgram, IsInEveryFile) {
  const support::ScratchFolder folder;
  const std::string name = core::written_by();
  EXPECT_THAT(contents("curve --material mica", folder.file("a.csv")), HasSubstr(name));
  EXPECT_THAT(contents("curve --material mica --format tab", folder.file("a.tab")), HasSubstr(name));
  EXPECT_THAT(contents("curve --material mica --format svg", folder.file("a.svg")), HasSubstr(name));
  EXPECT_THAT(contents(kScan, folder.file("a.gwy")), HasSubstr(name));
  EXPECT_THAT(contents(kScan, folder.file("a.gsf")), HasSubstr("Software = " + name));
  EXPECT_THAT(contents("particles scratch-pmma", folder.file("b.gwy")), HasSubstr(name));
  ASSERT_EQ(run_touchafm("convert " + data("bom.tab") + " " + folder.file("b.csv")).exit_code, 0);
  EXPECT_THAT(core::read_file(folder.file("b.csv")).value(),
              HasSubstr("TouchAFM version:\t" + std::string(core::kVersion)));
  ASSERT_EQ(run_touchafm("convert " + data("bom.tab") + " " + folder.file("b.h5")).exit_code, 0);
  EXPECT_THAT(core::read_file(folder.file("b.h5")).value(),
              testing::AllOf(HasSubstr("software version"), HasSubstr(core::kVersion)));
  ASSERT_EQ(run_touchafm("paper --out " + folder.file("paper")).exit_code, 0);
  for (const char* file : {"paper.md", "table1.csv", "table2.csv", "fig2.svg", "fig5e.svg"}) {
    EXPECT_THAT(core::read_file(folder.file(std::string("paper/") + file)).value(), HasSubstr(name)) << file;
  }
  const auto paper = nlohmann::json::parse(core::read_file(folder.file("paper/paper.json")).value());
  EXPECT_EQ(paper["software_version"], core::kVersion);
  const std::string fit = "analyse " + data("rising.tab") + " --fit paraboloid --radius 5um";
  ASSERT_EQ(run_touchafm(fit + " --out " + folder.file("fits")).exit_code, 0);
  const std::string table = core::read_file(folder.file("fits/fits.tsv")).value();
  EXPECT_THAT(table, HasSubstr("\tsource\tsoftware\n"));
  EXPECT_THAT(table, HasSubstr("\tHertz 1881"));
  EXPECT_TRUE(table.ends_with("\t" + name + "\n")) << table;
  EXPECT_THAT(core::read_file(folder.file("fits/modulus.svg")).value(), HasSubstr(name));
}

// BIDS allows no header in a table: the JSON file beside it describes the program instead.
TEST(NamedProgram, IsBesideTheTablesOfAStudyWithTheSamples) {
  const support::ScratchFolder folder;
  const std::string lesson = "lesson " + support::source("assets/lessons/three-materials.toml");
  const auto taken = run_touchafm(lesson + " --participant sim:1 --out " + folder.file("study"));
  ASSERT_EQ(taken.exit_code, 0) << taken.err;
  std::size_t tables = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("study"))) {
    std::filesystem::path beside = entry.path();
    if (beside.extension() != ".tsv") continue;
    ++tables;
    const auto json = nlohmann::json::parse(core::read_file(beside.replace_extension(".json").string()).value());
    EXPECT_EQ(json["StimulusPresentation"]["SoftwareVersion"], core::kVersion) << entry.path();
    if (!json.contains("Lesson")) continue;
    ASSERT_EQ(json["Samples"].size(), 3U);
    for (const auto& [name, sample] : json["Samples"].items()) {
      EXPECT_GT(sample["parameters"]["hamaker_J"].get<double>(), 0.0) << name;
      EXPECT_FALSE(sample["sources"]["hamaker"]["source"].get<std::string>().empty()) << name;
    }
  }
  EXPECT_EQ(tables, 2U);
}

// A text of a PNG picture as stored: key, end of the key, not compressed, no language, the text.
std::string text_in_png(const std::string& key, const std::string& text) { return key + std::string(5, '\0') + text; }

TEST(NamedProgram, IsInEveryPictureWithItsParameters) {
  const support::ScratchFolder folder;
  ASSERT_EQ(run_touchafm(kScan + " --tip-radius 7nm --picture " + folder.file("a.png")).exit_code, 0);
  const std::string scan = core::read_file(folder.file("a.png")).value();
  EXPECT_THAT(scan, HasSubstr(text_in_png("Software", core::written_by())));
  EXPECT_THAT(scan, HasSubstr(text_in_png("Title", "Height in m")));
  EXPECT_THAT(scan, HasSubstr(text_in_png("Width", "20 nm")));
  EXPECT_THAT(scan, HasSubstr(text_in_png("Material", "mica")));
  EXPECT_THAT(scan, HasSubstr(text_in_png("Tip radius", "7 nm")));
  EXPECT_THAT(scan, HasSubstr(text_in_png("Source of tip_radius", "7nm, --tip-radius on the command line")));

  ASSERT_EQ(run_touchafm("curve --material mica --tip-radius 7nm --out " + folder.file("curve.svg")).exit_code, 0);
  const std::string curve = core::read_file(folder.file("curve.svg")).value();
  const std::string unseen = curve.substr(0, curve.find("</metadata>"));
  EXPECT_THAT(unseen, HasSubstr(core::written_by()));
  EXPECT_THAT(unseen, HasSubstr("# tip_radius_m: 7e-09\n"));
  EXPECT_THAT(unseen, HasSubstr("# source of tip_radius: 7nm, --tip-radius on the command line"));

  ASSERT_EQ(
      run_touchafm("generate map --modulus 4kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN --pixels 2x2 "
                   "--size 1um --out " +
                   folder.file("map.h5"))
          .exit_code,
      0);
  ASSERT_EQ(
      run_touchafm("analyse " + folder.file("map.h5") + " --fit paraboloid --radius 5um --out " + folder.file("fits"))
          .exit_code,
      0);
  const std::string map = core::read_file(folder.file("fits/map-modulus.png")).value();
  EXPECT_THAT(map, HasSubstr(text_in_png("Software", core::written_by())));
  EXPECT_THAT(map, HasSubstr(text_in_png("Title", "Modulus in Pa")));
  EXPECT_THAT(map, HasSubstr(text_in_png("radius_m", "5e-06")));
  EXPECT_THAT(map, HasSubstr("Hertz 1881"));
}

}  // namespace named_program_test
}  // namespace afm::app
