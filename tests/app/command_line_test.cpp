// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/run_program.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace {

using support::ProgramResult;
using ::testing::AllOf;
using ::testing::HasSubstr;

ProgramResult touchafm(const std::string& arguments) { return support::run_program(AFM_PROGRAM " " + arguments); }

// Everything that is refused says so in one line.
void expect_refusal(const ProgramResult& result, int exit_code, const std::string& part) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_THAT(result.err, HasSubstr(part));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.out, "");
}

TEST(CommandLine, EveryCommandExplainsItself) {
  const ProgramResult all = touchafm("--help");
  EXPECT_EQ(all.exit_code, 0);
  for (const char* command : {"demo", "curve", "material", "paper", "render", "wall", "devices"}) {
    EXPECT_THAT(all.out, HasSubstr(command));
    const ProgramResult one = touchafm(std::string(command) + " --help");
    EXPECT_EQ(one.exit_code, 0) << command;
    EXPECT_THAT(one.out, HasSubstr("example:")) << command;
  }
}

TEST(CommandLine, RefusesAnUnknownCommandAndAnUnknownOption) {
  expect_refusal(touchafm("dmeo --out x"), 2, "dmeo");
  expect_refusal(touchafm("demo --out x --fast"), 2, "--fast");
  expect_refusal(touchafm(""), 2, "--help");
}

TEST(CommandLine, RefusesAnUnknownMaterialByListingTheKnown) {
  expect_refusal(touchafm("curve --material granite"), 2, "mica");
}

TEST(CommandLine, RefusesABareNumberByListingTheUnits) {
  expect_refusal(touchafm("curve --material mica --tip-radius 50"), 2, "nm");
}

TEST(CommandLine, RefusesAWallWithCollinearCorners) {
  const support::ScratchFolder folder;
  const std::string wall =
      folder.write("wall.toml",
                   "[[screen]]\nname='w'\nlower_left=[0,0,0]\nlower_right=[1,0,0]\nupper_left=[2,0,0]\n"
                   "[[viewer]]\nname='v'\nipd='63 mm'\nsweet_spot=[0,1,2]\n");
  expect_refusal(touchafm("wall " + wall), 3, "collinear");
  expect_refusal(touchafm("demo --out " + folder.file("out") + " --wall " + wall), 3, "collinear");
  EXPECT_FALSE(std::filesystem::exists(folder.file("out")));
}

TEST(CommandLine, RefusesAnEyeBehindTheWall) {
  expect_refusal(touchafm("wall " AFM_SOURCE_DIR "/assets/walls/powerwall.toml --json --head 0,1.65,-2"), 3, "behind");
}

TEST(CommandLine, RefusesAHeadThatIsNotAPose) {
  expect_refusal(touchafm("wall " AFM_SOURCE_DIR "/assets/walls/powerwall.toml --head 0,1.65"), 2, "x,y,z");
  expect_refusal(touchafm("wall " AFM_SOURCE_DIR "/assets/walls/powerwall.toml --head 0,1,2,3,4,5,6"), 2, "quaternion");
}

TEST(CommandLine, PrintsBothEyesOfAWallAsJson) {
  const ProgramResult result = touchafm("wall " AFM_SOURCE_DIR "/assets/walls/powerwall.toml --json --head 0,1.65,2.5");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto frusta = nlohmann::json::parse(result.out);
  ASSERT_EQ(frusta.size(), 2U);
  EXPECT_EQ(frusta[0]["eye"], "left");
  EXPECT_NEAR(frusta[0]["eye_position_m"][0].get<double>(), -0.0315, 1e-12);
  // row-major: 2n/(r-l) = 2 d/width, and the y row points down
  EXPECT_NEAR(frusta[1]["projection"][0].get<double>(), 2.0 * 2.5 / 3.048, 1e-12);
  EXPECT_LT(frusta[1]["projection"][5].get<double>(), 0.0);
  EXPECT_NEAR(frusta[1]["projection"][11].get<double>(), 0.1, 1e-12);
}

TEST(CommandLine, RefusesMissingAndBrokenModels) {
  const support::ScratchFolder folder;
  std::filesystem::copy(AFM_SOURCE_DIR "/assets", folder.file("assets"), std::filesystem::copy_options::recursive);
  const std::string demo = "demo --out " + folder.file("out") + " --assets " + folder.file("assets");
  std::filesystem::resize_file(folder.file("assets/models/probe.glb"), 1000);
  expect_refusal(touchafm(demo), 3, "probe.glb");
  std::filesystem::remove(folder.file("assets/models/probe.glb"));
  expect_refusal(touchafm(demo), 3, "probe.glb");
  EXPECT_FALSE(std::filesystem::exists(folder.file("out")));
}

TEST(CommandLine, RefusesAnOutputFolderThatCannotBeWritten) {
  const support::ScratchFolder folder;
  const std::string file = folder.write("file", "x");
  expect_refusal(touchafm("demo --out " + file), 1, file);
  expect_refusal(touchafm("paper --out " + file + "/below"), 1, file);
}

TEST(CommandLine, SaysWhatToInstallWhenThereIsNoVulkanDriver) {
  const support::ScratchFolder folder;
  const ProgramResult result = support::run_program(
      "VK_ICD_FILENAMES=/nowhere.json VK_DRIVER_FILES=/nowhere.json " AFM_PROGRAM " demo --out " + folder.file("out"));
  expect_refusal(result, 4, "mesa-vulkan-drivers");
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/report.html")));
}

TEST(CommandLine, RefusesAHandThatIsNoHand) {
  expect_refusal(touchafm("demo --out /tmp/x --hand-speed 3m/s"), 2, "5mm/s to 200mm/s");
  expect_refusal(touchafm("demo --out /tmp/x --hand-speed 30"), 2, "mm/s");
}

TEST(CommandLine, RefusesASessionThatIsNone) {
  const support::ScratchFolder folder;
  expect_refusal(touchafm("render --session " + folder.write("s.afms", "no") + " --out " + folder.file("x.png")), 3,
                 "not a TouchAFM session");
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.png")));
}

TEST(CommandLine, TheServoAloneSaysWhoStartsIt) {
  const std::string servo = std::filesystem::path(AFM_PROGRAM).replace_filename("touchafm-servo").string();
  expect_refusal(support::run_program(servo), 2, "started by touchafm");
}

}  // namespace
}  // namespace afm::app
