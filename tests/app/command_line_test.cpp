// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/options/command.h"
#include "core/whole_file.h"
#include "haptics/device_registry.h"
#include "scene/shared/scale_modes.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace command_line_test {

using support::expect_refusal;
using support::ProgramResult;
using support::run_touchafm;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CommandLine, EveryCommandExplainsItself) {
  const ProgramResult all = run_touchafm("--help");
  EXPECT_EQ(all.exit_code, 0);
  std::vector<std::string> commands{"bench cluster", "bench fits",    "bench haptics",
                                    "bench maps",    "bench physics", "bench render"};
  for (const Command& command : kCommands) {
    EXPECT_THAT(all.out, HasSubstr("\n  " + std::string(command.name) + " "));
    commands.emplace_back(command.name);
  }
  // a text or a number whose possible values the help does not describe
  const std::regex unexplained(R"(\n  \S+ +(TEXT|U?INT|FLOAT)\b)");
  for (const std::string& command : commands) {
    const ProgramResult one = run_touchafm(command + " --help");
    EXPECT_EQ(one.exit_code, 0) << command;
    EXPECT_THAT(one.out, HasSubstr("example: touchafm " + command)) << command;
    std::smatch option;
    EXPECT_FALSE(std::regex_search(one.out, option, unexplained)) << command << ": " << option.str();
  }
}

TEST(CommandLine, RefusesAnUnknownCommandAndAnUnknownOption) {
  expect_refusal(run_touchafm("dmeo --out x"), 2, "dmeo");
  expect_refusal(run_touchafm("demo --out x --fast"), 2, "--fast");
  expect_refusal(run_touchafm(""), 2, "--help");
}

TEST(CommandLine, RefusesAnUnknownMaterialByListingTheKnown) {
  expect_refusal(run_touchafm("curve --material granite"), 2, "mica");
}

TEST(CommandLine, RefusesABareNumberByListingTheUnits) {
  expect_refusal(run_touchafm("curve --material mica --tip-radius 50"), 2, "nm");
}

TEST(CommandLine, RefusesOptionsOfAnalyseThatAreForAnotherKindOfFile) {
  const support::ScratchFolder folder;
  const std::string image = folder.file("mica.gsf");
  ASSERT_EQ(run_touchafm("scan --material mica --pixels 8 --size 30nm --rate 10Hz --out " + image).exit_code, 0);
  for (const char* option : {"--beside x.csv", "--spring-constant 1N/m", "--sensitivity 70nm/V",
                             "--contact-point gradient", "--curve 1", "--out x.svg"}) {
    const std::string name = std::string(option).substr(0, std::string(option).find(' '));
    expect_refusal(run_touchafm("analyse " + image + " " + option), 2, name + " is for curves, and " + image);
  }
  const std::string curve = support::source("tests/formats/0.1.0/curve.csv"), session = folder.write("x", "AFMS");
  expect_refusal(run_touchafm("analyse " + curve + " --channel Height"), 2,
                 "--channel is for images, and " + curve + " is a curve");
  expect_refusal(run_touchafm("analyse " + curve + " --level none"), 2, "--level is for images");
  expect_refusal(run_touchafm("analyse " + session + " --curve 0"), 2,
                 "--curve is for curves, and " + session + " is a session");
  expect_refusal(run_touchafm("analyse " + folder.path()), 3, "it is a folder, not a file");
  EXPECT_EQ(run_touchafm("analyse " + image + " --level none --json").exit_code, 0);
}

TEST(CommandLine, RefusesSettingsOfAScanByListingWhatIsLegal) {
  expect_refusal(run_touchafm("scan --out x.gwy"), 2, "--material");
  expect_refusal(run_touchafm("scan --material mica --json --rate 2"), 2, "MHz, kHz, Hz");
  expect_refusal(run_touchafm("scan --material mica --json --setpoint 1N"), 2, "-10uN to 10uN");
  expect_refusal(run_touchafm("scan --material mica --json --pixels 5000"), 2, "4096");
  expect_refusal(run_touchafm("scan --material mica --json --tip spoon"), 2, "pyramid-3");
  expect_refusal(run_touchafm("scan --material mica --out x.tif"), 2, ".gwy or .gsf");
  expect_refusal(run_touchafm("scan --material mica --out /nowhere/x.gwy"), 2, "there is no folder /nowhere; make it");
  expect_refusal(run_touchafm("scan --integral-gain 5000000/s"), 2, "5000000/s is outside 0/ms to 1000/ms");
}

TEST(CommandLine, RefusesAWallWithCollinearCorners) {
  const support::ScratchFolder folder;
  const std::string wall =
      folder.write("wall.toml",
                   "[[screen]]\nname='w'\nlower_left=[0,0,0]\nlower_right=[1,0,0]\nupper_left=[2,0,0]\n"
                   "[[viewer]]\nname='v'\nipd='63 mm'\nsweet_spot=[0,1,2]\n");
  expect_refusal(run_touchafm("wall " + wall), 3, "collinear");
  expect_refusal(run_touchafm("demo --out " + folder.file("out") + " --wall " + wall), 3, "collinear");
  EXPECT_FALSE(std::filesystem::exists(folder.file("out")));
}

TEST(CommandLine, RefusesAnEyeBehindTheWall) {
  expect_refusal(run_touchafm("wall " + support::source("assets/walls/powerwall.toml --json --head 0,1.65,-2")), 3,
                 "behind");
}

TEST(CommandLine, RefusesAHeadThatIsNotAPose) {
  expect_refusal(run_touchafm("wall " + support::source("assets/walls/powerwall.toml --head 0,1.65")), 2, "x,y,z");
  expect_refusal(run_touchafm("wall " + support::source("assets/walls/powerwall.toml --head 0,1,2,3,4,5,6")), 2,
                 "quaternion");
}

TEST(CommandLine, PrintsBothEyesOfAWallAsJson) {
  const ProgramResult result =
      run_touchafm("wall " + support::source("assets/walls/powerwall.toml --json --head 0,1.65,2.5"));
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

TEST(CommandLine, StartsAWallOfSeveralMachinesOrSaysWhatItLacks) {
  const support::ScratchFolder folder;
  std::string text = core::read_file(support::source("assets/walls/powerwall.toml")).value();
  const std::string alone = folder.write("alone.toml", text);
  text +=
      "\n[[node]]\nname = \"left\"\nhost = \"127.0.0.1\"\n[[output]]\nname = \"far\"\nnode = \"left\"\nscreen = "
      "\"powerwall\"\nmode = \"mono\"\nmonitor = \"DP-1\"\n";
  const std::string wall = folder.write("wall.toml", text);
  const ProgramResult lines = run_touchafm("wall " + wall + " --start");
  EXPECT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_EQ(lines.out, "ssh 127.0.0.1 DISPLAY=:0 touchafm node left --interface 127.0.0.1\ntouchafm view --wall " +
                           wall + " --cluster\n");
  EXPECT_THAT(run_touchafm("wall " + wall).out, HasSubstr("output far: node left, screen powerwall"));
  expect_refusal(run_touchafm("wall " + alone + " --start"), 2, "[[node]]");
  expect_refusal(run_touchafm("view --cluster --wall " + alone), 2, "[[node]]");
  expect_refusal(run_touchafm("view --wall " + wall), 2, "--cluster");
  expect_refusal(run_touchafm("view --cluster --interface 203.0.113.7 --wall " + wall), 2, "127.0.0.1 (lo)");
  expect_refusal(run_touchafm("view --headset --cluster --wall " + wall), 2, "--headset");
  expect_refusal(run_touchafm("node left"), 2, "--interface");
  expect_refusal(run_touchafm("node left --interface lo --haptics sim"), 2, "--haptics");
  expect_refusal(run_touchafm("node left --interface 203.0.113.7"), 2, "127.0.0.1 (lo)");
  expect_refusal(run_touchafm("node left --interface lo --master nowhere.invalid"), 4, "nowhere.invalid");
  expect_refusal(run_touchafm("doctor --cluster " + alone), 2, "[[node]]");
}

TEST(CommandLine, NamesEveryHapticDevice) {
  const std::string help = run_touchafm("view --help").out;
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    EXPECT_THAT(help, HasSubstr(std::string(kind.word) + " ("));
  }
  expect_refusal(run_touchafm("view --haptics falcon"), 2, "hdapi, forcedimension, haply, gamepad");
}

TEST(CommandLine, RefusesAFrictionThatTheLawDoesNotHave) {
  const support::ScratchFolder folder;
  expect_refusal(run_touchafm("demo --friction lattice --out " + folder.file("out")), 2, "choose the model dmt");
  expect_refusal(run_touchafm("demo --friction glue --out " + folder.file("out")), 2, "amontons");
}

TEST(CommandLine, ExplainsEveryScaleMode) {
  for (const char* command : {"demo", "view"}) {
    const std::string help = run_touchafm(std::string(command) + " --help").out;
    for (const scene::ScaleModeText& scale : scene::kScalesOfSamples)
      EXPECT_THAT(help, HasSubstr(scale.word)) << command;
  }
  expect_refusal(run_touchafm("demo --out x --scale logarithmic"), 2, "compressed");
}

const std::string kWalls = support::source("assets/walls/");

// Width and height as a PNG's header has them.
std::array<unsigned, 2> png_size(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<unsigned char, 24> header{};
  file.read(reinterpret_cast<char*>(header.data()), static_cast<std::streamsize>(header.size()));
  const auto number = [&](std::size_t at) {
    return 16777216U * header[at] + 65536U * header[at + 1] + 256U * header[at + 2] + header[at + 3];
  };
  return {number(16), number(20)};
}

TEST(CommandLine, NamesTheStereoModesForOneThatIsNone) {
  for (const char* command : {"render --session s --out x.png", "view", "wall w.toml"}) {
    const ProgramResult result = run_touchafm(std::string(command) + " --stereo 3d");
    expect_refusal(result, 2, "\"3d\" is not a stereo mode");
    EXPECT_THAT(result.err, AllOf(HasSubstr("side-by-side-half"), HasSubstr("frame-packed-1080p"), HasSubstr("dual")));
  }
  expect_refusal(run_touchafm("wall w.toml --ipd 10mm"), 2, "10mm is outside 30mm to 90mm");
  expect_refusal(run_touchafm("wall w.toml --ipd 63"), 2, "mm");
}

TEST(CommandLine, DrawsATestPatternOfTheSizeThatWasAskedForInEveryMode) {
  const support::ScratchFolder folder;
  const std::string out = folder.file("pattern.png");
  const std::string pattern = "wall " + kWalls + "powerwall.toml --test-pattern --out " + out;
  for (const auto& [mode, width, height] :
       {std::tuple("mono", 64U, 48U), std::tuple("side-by-side", 1U, 1U), std::tuple("top-bottom", 64U, 48U),
        std::tuple("row", 1U, 1U), std::tuple("anaglyph-amber-blue", 64U, 48U)}) {
    const ProgramResult result =
        run_touchafm(pattern + " --stereo " + mode + " --size " + std::to_string(width) + "x" + std::to_string(height));
    ASSERT_EQ(result.exit_code, 0) << mode << result.err;
    EXPECT_EQ(png_size(out), (std::array{width, height})) << mode;
  }
  ASSERT_EQ(run_touchafm(pattern + " --stereo dual --size 64x48").exit_code, 0);
  EXPECT_EQ(png_size(folder.file("pattern-left.png")), (std::array{64U, 48U}));
  EXPECT_EQ(png_size(folder.file("pattern-right.png")), (std::array{64U, 48U}));
}

TEST(CommandLine, RefusesPicturesThatCannotBe) {
  const support::ScratchFolder folder;
  const std::string wall = "wall " + kWalls + "powerwall.toml";
  const std::string pattern = wall + " --test-pattern --out " + folder.file("x.png");
  expect_refusal(run_touchafm(pattern + " --size 0x48"), 2, "0x48 pixels cannot be drawn");
  expect_refusal(run_touchafm(pattern + " --size 100000x48"), 2, "choose 1 to");
  expect_refusal(run_touchafm(pattern + " --size 64"), 2, "WIDTHxHEIGHT");
  expect_refusal(run_touchafm(pattern + " --stereo frame-packed-720p --size 640x480"), 2, "exactly 1280x1470");
  expect_refusal(run_touchafm(wall + " --test-pattern"), 2, "--out");
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.png")));
}

TEST(CommandLine, ChecksEveryPresetAndAParaViewConfiguration) {
  for (const char* name : {"powerwall", "two-projectors", "3d-tv", "desk-red-cyan", "tiled-2x2", "blended", "curved"}) {
    const ProgramResult result = run_touchafm("wall " + kWalls + name + ".toml");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("the wall file is valid"));
    EXPECT_THAT(result.out, ::testing::Not(HasSubstr("note:"))) << name;
  }
  const ProgramResult pvx = run_touchafm("wall " + support::source("tests/fuzz/corpus/wall/good.pvx --json"));
  ASSERT_EQ(pvx.exit_code, 0) << pvx.err;
  EXPECT_EQ(nlohmann::json::parse(pvx.out).at(0).at("screen"), "w");
}

TEST(CommandLine, SaysHowAWallIsBlendedAndWarped) {
  const auto json_of = [](const char* name) {
    const ProgramResult result = run_touchafm("wall " + kWalls + name + " --json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  };
  const nlohmann::json blended = json_of("blended.toml"), curved = json_of("curved.toml");
  EXPECT_EQ(blended.at(0).at("blend").at("screens"), nlohmann::json({"right"}));
  EXPECT_EQ(blended.at(0).at("blend").at("edges").size(), 1U);
  EXPECT_NEAR(blended.at(0).at("blend").at("edges").at("right").at("width_m").get<double>(), 0.4, 1e-9);
  EXPECT_EQ(blended.at(2).at("corrected_outputs").at(0).at("name"), "right projector");
  EXPECT_EQ(blended.at(2).at("corrected_outputs").at(0).at("gamma"), 2.2);
  EXPECT_NEAR(blended.at(2).at("corrected_outputs").at(0).at("brightest_black").get<double>(), 0.001, 1e-12);
  EXPECT_EQ(curved.at(0).at("corrected_outputs").at(0).at("warp_mesh").at("columns"), 17);
  EXPECT_FALSE(json_of("powerwall.toml").at(0).contains("corrected_outputs"));
  EXPECT_THAT(run_touchafm("wall " + kWalls + "blended.toml").out,
              AllOf(HasSubstr("blended with right: right edge 400 mm"), HasSubstr("black 0.0005 of white")));
  EXPECT_THAT(run_touchafm("wall " + kWalls + "curved.toml").out, HasSubstr("warp mesh of 17 x 10 nodes"));
}

TEST(CommandLine, DrawsTheTestPatternOfBlendedAndCurvedScreens) {
  const support::ScratchFolder folder;
  const std::string out = folder.file("pattern.png");
  for (const char* name : {"blended", "curved"}) {
    const ProgramResult result =
        run_touchafm("wall " + kWalls + name + ".toml --test-pattern --stereo mono --size 384x120 --out " + out);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(png_size(out), (std::array{384U, 120U})) << name;
  }
}

TEST(CommandLine, RefusesMissingAndBrokenModels) {
  const support::ScratchFolder folder;
  std::filesystem::copy(support::source("assets"), folder.file("assets"), std::filesystem::copy_options::recursive);
  const std::string demo = "demo --out " + folder.file("out") + " --assets " + folder.file("assets");
  std::filesystem::resize_file(folder.file("assets/models/probe.glb"), 1000);
  expect_refusal(run_touchafm(demo), 3, "probe.glb");
  std::filesystem::remove(folder.file("assets/models/probe.glb"));
  expect_refusal(run_touchafm(demo), 3, "probe.glb");
  EXPECT_FALSE(std::filesystem::exists(folder.file("out")));
}

TEST(CommandLine, RefusesAnOutputFolderThatCannotBeWritten) {
  const support::ScratchFolder folder;
  const std::string file = folder.write("file", "x");
  expect_refusal(run_touchafm("demo --out " + file), 1, file);
  expect_refusal(run_touchafm("paper --out " + file + "/below"), 1, file);
}

// doctor, wall and devices printed into a full disk and ended with 0.
TEST(CommandLine, FailsWhenWhatItPrintsCannotBeWritten) {
  for (const std::string& arguments : std::initializer_list<std::string>{
           "--help", "--version", "curve --help", "curve --material gold", "material", "material mica",
           "wall " + support::source("assets/walls/cave.toml"), "devices --json", "doctor --seconds 0.1",
           "render --describe --gltf " + support::source("assets/models/probe.glb")}) {
    SCOPED_TRACE(arguments);
    const ProgramResult result = support::run_program("(" + support::touchafm() + " " + arguments + " >/dev/full)");
    expect_refusal(result, 1, "cannot write to stdout: No space left on device");
  }
}

TEST(CommandLine, WritesTheReportOfAStudyOrNothing) {
  const support::ScratchFolder folder;
  expect_refusal(run_touchafm("study " + folder.file("class")), 2, "--out");
  const std::string command = "study " + folder.file("class") + " --out " + folder.file("report");
  expect_refusal(run_touchafm(command), 3, "there is no such folder");
  std::filesystem::create_directories(folder.file("class/sub-ABCDEF"));
  expect_refusal(run_touchafm(command), 3, "no participants.tsv is in it");
  folder.write("class/participants.tsv", "participant_id\torder\tage_band\tcomfort\nsub-ABCDEF\t0\tn/a\tfinished\n");
  const std::string events = "class/sub-ABCDEF/task-three_events.tsv";
  folder.write(events, "onset\tduration\n");
  expect_refusal(run_touchafm(command), 3, "task-three_events.tsv:1: there is no column \"step\"");
  EXPECT_FALSE(std::filesystem::exists(folder.file("report")));
  folder.write(events,
               "onset\tduration\tstep\ttrial_type\tcondition\tpractice\ttrial\tlevel\tstimulus\tresponse\tcorrect\trt\n"
               "1\t1\tblind\tidentify\thaptics\t0\t1\tn/a\tmica\tgold\t0\t0.5\n");
  expect_refusal(run_touchafm("study " + folder.file("class") + " --out " + folder.file(events)), 1,
                 "task-three_events.tsv");
  const ProgramResult done = run_touchafm(command);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* file : {"study.md", "study.html", "study.json", "identify-three.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.file("report/" + std::string(file)))) << file;
  }
}

TEST(CommandLine, SaysWhatToInstallWhenThereIsNoVulkanDriver) {
  const support::ScratchFolder folder;
  const ProgramResult result = support::run_program("VK_ICD_FILENAMES=/nowhere.json VK_DRIVER_FILES=/nowhere.json " +
                                                    support::touchafm() + " demo --out " + folder.file("out"));
  expect_refusal(result, 4, "mesa-vulkan-drivers");
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/report.html")));
}

TEST(CommandLine, ListsTheLegalValuesOfAChoiceThatIsNone) {
  for (const char* command : {"demo --out /tmp/x", "view"}) {
    expect_refusal(run_touchafm(std::string(command) + " --scale tiny"), 2, "choose common, fit, compressed");
    expect_refusal(run_touchafm(std::string(command) + " --servo fibre"), 2, "choose process, thread");
  }
  expect_refusal(run_touchafm("demo --out /tmp/x --model paper-rule"), 2, "cannot feel model \"paper-rule\"");
  expect_refusal(run_touchafm("analyse x.tab --spring-constant 0.1nm"), 2, "--spring-constant: ");
  expect_refusal(run_touchafm("analyse x.tab --spring-constant -1N/m"), 2, "is outside");
  expect_refusal(run_touchafm("analyse x.tab --sensitivity 70nm"), 2,
                 "\"nm\" is not its unit; write a number and one of the units um/V");
}

TEST(CommandLine, RefusesALeverThatCannotBeCalibrated) {
  const support::ScratchFolder folder;
  const std::string spectrum = folder.write("spectrum.txt", "Hz V2/Hz\n1 2\n2 3\n"),
                    of_it = "lever --thermal " + spectrum;
  expect_refusal(run_touchafm("lever"), 2, "nothing to calibrate by; give --thermal");
  expect_refusal(run_touchafm("lever --sader --length 120um --width 30um --resonance 70kHz"), 2,
                 "--sader needs --quality-factor");
  expect_refusal(run_touchafm("lever --gci 5e-5 --resonance 70kHz --quality-factor 150"), 2, "N/m/kHz^1.3");
  expect_refusal(run_touchafm("lever --sensitivity-from x.tab --length 120um"), 2, "--sader");
  expect_refusal(run_touchafm("lever --sensitivity-from x.tab --range 1kHz:2kHz"), 2, "--thermal");
  expect_refusal(run_touchafm(of_it + " --sensitivity 60nm"), 2, "nm/V");
  expect_refusal(run_touchafm(of_it + " --range 20kHz:5kHz"), 2, "does not go up");
  expect_refusal(run_touchafm(of_it + " --range 5kHz"), 2, "5kHz:20kHz");
  expect_refusal(run_touchafm(of_it + " --uncertainty tilt=3%"), 2, "known are sensitivity");
  expect_refusal(run_touchafm(of_it + " --uncertainty temperature=1"), 2, "%, K");
  expect_refusal(run_touchafm(of_it + " --uncertainty sensitivity=3% --uncertainty tilt=3%"), 2,
                 "known are sensitivity");
  expect_refusal(run_touchafm(of_it + " --uncertainty area=3% --uncertainty area=4%"), 2, "given twice");
  expect_refusal(run_touchafm(of_it + " --uncertainty area=0%"), 2, "above 0 %");
  expect_refusal(run_touchafm(of_it + " --sensitivity 60nm/V"), 3, "fewer than 20 points; give --range");
  expect_refusal(run_touchafm(of_it + " --units Hz"), 3, "has no density");
}

TEST(CommandLine, RefusesAHandThatIsNoHand) {
  expect_refusal(run_touchafm("demo --out /tmp/x --hand-speed 3m/s"), 2, "5mm/s to 200mm/s");
  expect_refusal(run_touchafm("demo --out /tmp/x --hand-speed 30"), 2, "mm/s");
}

TEST(CommandLine, RefusesASessionThatIsNone) {
  const support::ScratchFolder folder;
  expect_refusal(run_touchafm("render --session " + folder.write("s.afms", "no") + " --out " + folder.file("x.png")), 3,
                 "not a TouchAFM session");
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.png")));
}

TEST(CommandLine, TheServoAloneSaysWhoStartsIt) {
  const std::string servo = std::filesystem::path(support::touchafm()).replace_filename("touchafm-servo").string();
  expect_refusal(support::run_program(servo), 2, "touchafm starts this program");
}

}  // namespace command_line_test
}  // namespace afm::app
