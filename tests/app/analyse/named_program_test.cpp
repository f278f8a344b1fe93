// SPDX-License-Identifier: Apache-2.0
// Every report, table and file names the program and its version, so that it can be cited.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/version.h"
#include "core/whole_file.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace named_program_test {

using support::run_touchafm;
using testing::HasSubstr;

std::string contents(const std::string& command, const std::string& file) {
  const auto made = run_touchafm(command + " --out " + file);
  EXPECT_EQ(made.exit_code, 0) << command << made.err;
  return core::read_file(file).value_or("");
}

TEST(NamedProgram, IsInEveryReport) {
  const std::string data = support::source("tests/data/afm/");
  for (const std::string& command :
       {std::string("curve --material mica"), std::string("curve --material mica --sweep tip-radius=5nm:50nm:3"),
        std::string("curve --material mica --mode fm --resonance 30kHz --amplitude 1nm"),
        std::string(
            "curve --material mica --mode tapping --free-amplitude 20nm --resonance 300kHz --quality-factor 400 "
            "--spring-constant 40N/m --at 15nm"),
        "analyse " + data + "bom.tab", "analyse " + data + "qnm-log.spm",
        std::string("lever --sader --length 120um --width 30um --resonance 70kHz --quality-factor 150"),
        std::string("scan --material mica --size 20nm --pixels 8 --rate 20Hz")}) {
    const auto made = run_touchafm(command + " --json");
    ASSERT_EQ(made.exit_code, 0) << command << made.err;
    const auto report = nlohmann::json::parse(made.out);
    EXPECT_EQ(report.value("software", ""), "TouchAFM") << command;
    EXPECT_EQ(report.value("software_version", ""), core::kVersion) << command;
  }
}

TEST(NamedProgram, IsInEveryFile) {
  const support::ScratchFolder folder;
  const std::string name = std::string("TouchAFM ") + core::kVersion,
                    scan = "scan --material mica --size 20nm --pixels 8";
  EXPECT_THAT(contents("curve --material mica", folder.file("a.csv")), HasSubstr(name));
  EXPECT_THAT(contents("curve --material mica --format tab", folder.file("a.tab")), HasSubstr(name));
  EXPECT_THAT(contents("curve --material mica --format svg", folder.file("a.svg")), HasSubstr(name));
  EXPECT_THAT(contents(scan, folder.file("a.gwy")), HasSubstr(name));
  EXPECT_THAT(contents(scan, folder.file("a.gsf")), HasSubstr("Software = " + name));
  const std::string fit = "analyse " + support::source("tests/data/afm/rising.tab") + " --fit paraboloid --radius 5um";
  ASSERT_EQ(run_touchafm(fit + " --out " + folder.file("fits")).exit_code, 0);
  const std::string table = core::read_file(folder.file("fits/fits.tsv")).value();
  EXPECT_THAT(table, HasSubstr("\tsource\tsoftware\n"));
  EXPECT_THAT(table, HasSubstr("\tHertz 1881"));
  EXPECT_TRUE(table.ends_with("\t" + name + "\n")) << table;
  EXPECT_THAT(core::read_file(folder.file("fits/modulus.svg")).value(), HasSubstr(name));
}

}  // namespace named_program_test
}  // namespace afm::app
