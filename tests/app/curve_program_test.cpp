// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

// `touchafm curve` and `touchafm material` as people run them: exit codes, one line for what is refused, and nothing
// written then.
namespace afm::app {
namespace curve_program_test {

using support::ProgramResult;
using support::run_touchafm;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Expects a refusal in one line, with no file left in the folder except the test's own.
void expect_refusal(const std::string& arguments, int exit_code, const std::string& part) {
  const support::ScratchFolder folder;
  const ProgramResult result = run_touchafm(arguments + " --out " + folder.file("curve.csv"));
  EXPECT_EQ(result.exit_code, exit_code) << arguments << "\n" << result.err;
  EXPECT_THAT(result.err, HasSubstr(part)) << arguments;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(fs::is_empty(folder.path())) << arguments;
}

std::string material_file(const support::ScratchFolder& folder, const std::string& tip_radius,
                          const std::string& more = "") {
  return folder.write("own.toml",
                      "[[material]]\nname='own'\ntitle='Own'\ntip='x'\nmedium='air'\n"
                      "tip_radius={value='" +
                          tip_radius +
                          "',source='me'}\nspring_constant={value='0.1 N/m',source='me'}\n"
                          "sample_stiffness={value='inf N/m',source='me'}\nhamaker={value='20 zJ',source='me'}\n"
                          "work_of_adhesion={value='10 mJ/m2',source='me',estimated=true}\n" +
                          more);
}

TEST(CurveProgram, RefusesUnphysicalValues) {
  expect_refusal("curve --material mica --tip-radius -50nm", 2, "tip radius -50 nm is not within");
  expect_refusal("curve --material mica --spring-constant 0N/m", 2, "spring constant 0 N/m is not within");
  expect_refusal("curve --material mica --hamaker nanzJ", 2, "--hamaker: cannot read");
  expect_refusal("curve --material mica --reduced-modulus 1e30Pa", 2, "reduced modulus");
  expect_refusal("curve --material mica --reduced-modulus 50", 2, "TPa, GPa, MPa, kPa, Pa");
}

TEST(CurveProgram, RefusesASweepOfABillionPointsAtOnce) {
  expect_refusal("curve --material mica --sweep tip-radius=1nm:100nm:1000000000", 2, "from 2 to 1000000");
  expect_refusal("curve --material mica --sweep tip-radius=1nm:9nm:99999 --sweep hamaker=1zJ:9zJ:99999", 2, "at most");
}

TEST(CurveProgram, RefusesModelsAndOptionsThatDoNotFit) {
  expect_refusal("curve --material mica --model magic", 2, "unknown model");
  expect_refusal("curve --material mica --model jkr --hamaker 10zJ", 2, "--hamaker has no effect on model jkr");
  for (const char* model : {"paper", "paper-rule", "hao", "lj", "dynamic-lj"}) {
    expect_refusal(std::string("curve --material mica --reduced-modulus 5GPa --model ") + model, 2,
                   "--reduced-modulus has no effect on model");
  }
  for (const char* model : {"paper", "paper-rule", "hao", "hertz", "dmt", "jkr", "dynamic-dmt", "dynamic-jkr"}) {
    expect_refusal(std::string("curve --material mica --atomic-distance 0.2nm --model ") + model, 2,
                   "--atomic-distance has no effect on model");
  }
  expect_refusal("curve --material mica --work-of-adhesion 1mJ/m2 --model hertz", 2,
                 "--work-of-adhesion has no effect");
  expect_refusal("curve --material mica --sweep reduced-modulus=1GPa:2GPa:2 --model lj", 2,
                 "is not a number of the model lj");
  expect_refusal("curve --material mica --tip-radius ''", 2, "--tip-radius: its value is empty");
  for (const char* path : {"--from 30nm", "--to -1nm", "--step 1nm"}) {
    expect_refusal(std::string("curve --material mica --sweep tip-radius=1nm:9nm:3 ") + path, 2,
                   "cannot be given with --sweep");
  }
  expect_refusal("curve --model jkr --tip-radius 50nm", 2, "also needs --spring-constant");
  expect_refusal("curve --material mica --format svg --sweep tip-radius=1nm:9nm:3", 2, "csv or json");
  expect_refusal("curve --material mica --tip-radius 5nm --sweep tip-radius=1nm:9nm:3", 2,
                 "--sweep tip-radius=1nm:9nm:3: --tip-radius is given, too, and has no effect; remove one");
  expect_refusal("curve --mode tapping --free-amplitude 9nm --sweep free-amplitude=1nm:9nm:3 --material mica", 2,
                 "--free-amplitude is given, too");
  expect_refusal("curve --material mica --overlay x.tab", 2, "--overlay needs a plot");
}

TEST(CurveProgram, RefusesBadMaterialFiles) {
  const support::ScratchFolder folder;
  expect_refusal("curve --material own --materials " + material_file(folder, "50 nm", "colour='red'\n"), 3,
                 "own.toml: line 11: material.colour: unknown key");
  expect_refusal("curve --material own --materials " + material_file(folder, "-50 nm"), 3,
                 "line 6: material.tip_radius: tip radius -50 nm");
  expect_refusal("curve --material own --materials " +
                     material_file(folder, "50 nm", "reduced_modulus={value='1e30 Pa',source='me'}\n"),
                 3, "line 11: material.reduced_modulus");
  expect_refusal("curve --material mica --materials /no/such.toml", 3, "/no/such.toml");
  expect_refusal("curve --material mica --probe ppp-contr --probes /no/such.toml", 3, "/no/such.toml");
  expect_refusal("curve --material mica --probes /no/such.toml", 2, "--probe");  // unread file, hence another error
}

TEST(CurveProgram, TakesAMaterialOfTheUsersOwnBesideTheBuiltInOnes) {
  const support::ScratchFolder folder;
  const std::string file = material_file(folder, "30 nm");
  const ProgramResult own = run_touchafm("curve --material own --model paper --json --materials " + file);
  ASSERT_EQ(own.exit_code, 0) << own.err;
  EXPECT_EQ(nlohmann::json::parse(own.out)["parameters"]["tip_radius_m"], 30e-9);
  EXPECT_EQ(run_touchafm("curve --material mica --json --materials " + file).exit_code, 0);
}

TEST(CurveProgram, WritesTheFormatThatTheEndingNames) {
  const support::ScratchFolder folder;
  for (const char* name : {"c.csv", "c.json", "c.svg", "c.tab", "c.h5", "D.H5"}) {
    const ProgramResult result = run_touchafm("curve --material mica --step 0.1nm --out " + folder.file(name));
    EXPECT_EQ(result.exit_code, 0) << name << result.err;
  }
  EXPECT_THAT(text_of(folder.file("c.csv")), HasSubstr("z_m,force_N"));
  EXPECT_EQ(nlohmann::json::parse(text_of(folder.file("c.json")))["model"], "dmt");
  EXPECT_THAT(text_of(folder.file("c.svg")), HasSubstr("<svg"));
  EXPECT_EQ(text_of(folder.file("D.H5")), text_of(folder.file("c.h5"))) << "no text in a file for other programs";
  EXPECT_THAT(text_of(folder.file("c.tab")), HasSubstr("BEGIN METADATA"));
  EXPECT_EQ(text_of(folder.file("c.h5")).substr(1, 3), "HDF");
  const ProgramResult workshop = run_touchafm("curve --material mica --step 0.1nm --format afm-workshop");
  EXPECT_EQ(workshop.exit_code, 0) << workshop.err;
  EXPECT_FALSE(workshop.out.empty());
}

TEST(CurveProgram, DrawsAMeasuredCurveOverTheModel) {
  const support::ScratchFolder folder;
  ASSERT_EQ(run_touchafm("curve --material gold --step 0.1nm --out " + folder.file("measured.tab")).exit_code, 0);
  const ProgramResult result =
      run_touchafm("curve --material mica --format svg --overlay " + folder.file("measured.tab"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("measured, retract"));
  EXPECT_THAT(result.err, HasSubstr("measured.tab is shifted by "));
  const std::string cut = folder.write("cut.tab", text_of(folder.file("measured.tab")).substr(0, 500));
  expect_refusal("curve --material mica --format svg --overlay " + cut, 3, "cut.tab");
}

TEST(MaterialProgram, ListsMaterialsAndProbes) {
  const ProgramResult list = run_touchafm("material");
  ASSERT_EQ(list.exit_code, 0) << list.err;
  for (const char* name : {"materials (touchafm material NAME", "mica", "pdms-air", "polystyrene-water",
                           "probes (--probe NAME; nominal values)", "ppp-contr", "colloid-5um"}) {
    EXPECT_THAT(list.out, HasSubstr(name));
  }
}

TEST(MaterialProgram, PrintsEveryNumberWithItsSourceAndTheLawWithItsReason) {
  const support::ScratchFolder folder;
  const ProgramResult gold = run_touchafm("material gold --map " + folder.file("map.svg"));
  ASSERT_EQ(gold.exit_code, 0) << gold.err;
  for (const char* part : {"Hillier et al. 1996", "(estimated)", "reduced modulus", "71.45 GPa", "Tabor parameter",
                           "model dmt, chosen by the Tabor parameter", "snap-in", "pull-off", "loop energy",
                           "vanishes at and above k_c", "experiment f ad"}) {
    EXPECT_THAT(gold.out, HasSubstr(part));
  }
  EXPECT_THAT(text_of(folder.file("map.svg")), HasSubstr("this contact"));
  EXPECT_EQ(run_touchafm("material butter").exit_code, 2);
  EXPECT_EQ(run_touchafm("material --map " + folder.file("x.svg")).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder.file("x.svg")));
}

}  // namespace curve_program_test
}  // namespace afm::app
