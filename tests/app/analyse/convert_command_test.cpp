// SPDX-License-Identifier: Apache-2.0
// touchafm convert, and the options of touchafm analyse for a baseline, as a user types them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/whole_file.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace convert_command_test {

using support::expect_refusal;
using support::ProgramResult;
using support::run_touchafm;
using testing::HasSubstr;

std::string data(const std::string& name) { return support::source("tests/data/afm/" + name); }

TEST(ConvertCommand, WritesAFileThatAnalyseReads) {
  const support::ScratchFolder folder;
  const ProgramResult curve = run_touchafm("convert " + data("dwell.ibw") + " " + folder.file("new.h5"));
  EXPECT_EQ(curve.exit_code, 0) << curve.err;
  EXPECT_EQ(curve.out, folder.file("new.h5") + ": 1 curve of 400 points\n");
  EXPECT_THAT(curve.err, HasSubstr(data("dwell.ibw") + ": ")) << "what the reader left out";
  EXPECT_THAT(run_touchafm("analyse " + folder.file("new.h5")).out, HasSubstr("11.3"));
  EXPECT_EQ(run_touchafm("convert " + data("qnm-log.spm") + " " + folder.file("new.gwy")).exit_code, 0);
  EXPECT_THAT(run_touchafm("analyse " + folder.file("new.gwy")).out, HasSubstr("LogDMTModulus"));
}

TEST(ConvertCommand, RefusesAndLosesNothing) {
  const support::ScratchFolder folder;
  const std::string curve = data("bom.tab"), kept = folder.write("kept.tab", core::read_file(curve).value());
  expect_refusal(run_touchafm("convert " + kept + " " + kept), 2, "are one file, which would be lost");
  EXPECT_EQ(core::read_file(kept).value(), core::read_file(curve).value());
  expect_refusal(run_touchafm("convert " + curve + " " + folder.file("new.gwy")), 2, "is no name for them");
  expect_refusal(run_touchafm("convert " + curve + " " + folder.file("no/new.tab")), 2, "no/new.tab");
  expect_refusal(run_touchafm("convert " + data("ramp.spm") + " " + folder.file("new.tab")), 3, "without a deflection");
}

// "convert *.tab" in a folder of two measurements
TEST(ConvertCommand, ReplacesNoFile) {
  const support::ScratchFolder folder;
  const std::string other = folder.write("other.tab", "mine");
  expect_refusal(run_touchafm("convert " + data("bom.tab") + " " + other), 2, "there is already a file");
  EXPECT_EQ(core::read_file(other).value(), "mine");
  EXPECT_EQ(run_touchafm("convert " + data("bom.tab") + " " + folder.file("new.tab")).exit_code, 0);
}

// Bytes of SVG in a file called .png open in no viewer, and a folder called fit.csv is no table.
TEST(WrittenFile, HasNoNameOfAnotherKind) {
  const support::ScratchFolder folder;
  const std::string gel = folder.file("gel.tab");
  ASSERT_EQ(run_touchafm("generate curve --modulus 3kPa --noise 5pN --out " + gel).exit_code, 0);
  const std::string fit = "analyse " + gel + " --fit paraboloid --radius 1um --out ";
  for (const char* name : {"a.png", "a.PDF"}) {
    for (const std::string& command : {"analyse " + gel + " --out ", std::string("material gold --map "), fit}) {
      expect_refusal(run_touchafm(command + folder.file(name)), 2, ".svg");
    }
    expect_refusal(run_touchafm("curve --material gold --out " + folder.file(name)), 2, "name one that ends in .csv");
  }
  for (const char* name : {"a.csv", "a.tsv"}) expect_refusal(run_touchafm(fit + folder.file(name)), 2, "looks like");
  expect_refusal(run_touchafm("replay x.afms --sound " + folder.file("a.mp3")), 2, "ends in .wav");
  expect_refusal(run_touchafm("render --journey 3 --size 64x64 --out " + folder.file("a.jpg")), 2, "ends in .png");
  EXPECT_EQ(run_touchafm(fit + folder.file("A.SVG")).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_regular_file(folder.file("A.SVG")));
  EXPECT_EQ(run_touchafm(fit + folder.file("day2.1")).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_directory(folder.file("day2.1")));
  const std::string scan = "scan --material gold --pixels 16 --rate 20Hz --out " + folder.file("A.GWY");
  EXPECT_EQ(run_touchafm(scan + " --picture " + folder.file("A.PNG")).exit_code, 0);
}

TEST(WrittenFile, IsNoneThatTheCommandReads) {
  const support::ScratchFolder folder;
  const std::string curve = folder.write("curve.tab", core::read_file(data("bom.tab")).value()),
                    link = folder.file("link.tab");
  std::filesystem::create_symlink(curve, link);
  for (const std::string& command :
       {"analyse " + curve + " --out " + curve, "analyse " + data("bom.tab") + " --beside " + curve + " --out " + link,
        "curve --material mica --format svg --overlay " + link + " --out " + curve,
        "curve --material mica --materials " + curve + " --out " + curve,
        "scan --sample " + curve + " --picture " + curve, "lever --thermal " + curve + " --out " + curve,
        "replay " + curve + " --sound " + curve, "render --gltf " + curve + " --out " + curve,
        "wall " + curve + " --test-pattern --out " + curve,
        "view --haptics replay:" + curve + " --frame-log " + curve}) {
    expect_refusal(run_touchafm(command), 2, "would be lost");
  }
  expect_refusal(run_touchafm("analyse " + data("rising.tab") + " --out " + curve), 2,
                 "it is a curve, which a plot would replace");
  const std::string image = folder.write("image.spm", core::read_file(data("qnm-log.spm")).value());
  for (const std::string& command :
       {"material gold --map " + curve,
        "lever --thermal " + folder.write("thermal.txt", "Hz m2/Hz\n1 2\n") + " --out " + curve,
        "scan --material mica --picture " + curve, "render --journey 1 --out " + curve,
        "wall powerwall --test-pattern --out " + curve}) {
    expect_refusal(run_touchafm(command), 2, "it is a curve, which a picture would replace");
  }
  expect_refusal(run_touchafm("material gold --map " + image), 2, "it is an image, which a picture would replace");
  expect_refusal(run_touchafm("curve --material mica --format svg --out " + curve), 2, "which would be lost");
  expect_refusal(run_touchafm("curve --material mica --out " + image), 2, "it is an image, which would be lost");
  expect_refusal(run_touchafm("curve --material mica --out " + folder.file("mica.gwy")), 2, "a name for an image");
  const std::string igor = folder.write("curve.ibw", core::read_file(data("dwell.ibw")).value());
  expect_refusal(run_touchafm("curve --material mica --out " + igor), 2, "it is a curve, which would be lost");
  const std::string session =
      folder.write("hand.afms", core::read_file(support::source("tests/formats/0.2.0/session-mica.afms")).value());
  expect_refusal(run_touchafm("curve --material mica --json --out " + session), 2,
                 "it is a session, which would be lost");
  for (int twice = 0; twice < 2; ++twice)
    EXPECT_EQ(run_touchafm("curve --material mica --out " + folder.file("mica.txt")).exit_code, 0);
  EXPECT_EQ(core::read_file(curve).value(), core::read_file(data("bom.tab")).value());
  EXPECT_EQ(core::read_file(image).value(), core::read_file(data("qnm-log.spm")).value());
  EXPECT_EQ(run_touchafm("analyse " + curve + " --out " + folder.file("new.svg")).exit_code, 0);
  EXPECT_EQ(run_touchafm("analyse " + curve + " --out " + folder.file("new.svg")).exit_code, 0) << "a plot is replaced";
}

TEST(AnalyseCommand, RefusesABaselineThatIsNone) {
  expect_refusal(run_touchafm("analyse x.tab --baseline wavy"), 2,
                 "\"wavy\" is not a baseline; choose tilted, flat, waves");
  for (const char* range : {"1um", "2um:1um", "-1um:1um", "0:1um", ":", "1um:"}) {
    expect_refusal(run_touchafm(std::string("analyse x.tab --baseline-range ") + range), 2,
                   "is not a range of distances");
  }
  expect_refusal(run_touchafm("analyse x.tab --baseline-range 0,1um:1,5um"), 2,
                 "such as 0um:1.5um, with decimal points");
  expect_refusal(run_touchafm("analyse " + data("bom.tab") + " --baseline-range 1mm:2mm"), 3,
                 "the range of the baseline has 0 points of the approach");
}

// A terminal would obey them.
TEST(AnalyseCommand, PrintsNoControlCharacterOfAName) {
  const support::ScratchFolder folder;
  const std::string name = "a\x1b[31m\nzz",
                    curve = folder.write(name + ".tab", core::read_file(data("bom.tab")).value()),
                    image = folder.write(name + ".spm", core::read_file(data("qnm-log.spm")).value());
  for (const std::string& command :
       {"analyse '" + curve + "'", "analyse '" + image + "'",
        "convert '" + curve + "' '" + folder.file(name + ".h5") + "'",
        "analyse '" + curve + "' --fit cone --half-angle 20deg --out '" + folder.file(name) + "'"}) {
    const ProgramResult made = run_touchafm(command);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out + made.err, testing::Not(HasSubstr("\x1b")));
    EXPECT_THAT(made.out + made.err, testing::Not(HasSubstr("\nzz"))) << "the name breaks the line";
  }
}

TEST(AnalyseCommand, PrintsTheWavesOfABaseline) {
  const support::ScratchFolder folder;
  const ProgramResult made = run_touchafm(
      "generate curve --law sphere --modulus 2kPa --radius 5um --spring-constant 0.05N/m --most-force 2nN --wave 100pN "
      "--wave-period 400nm --seed 3 --out " +
      folder.file("wavy.tab"));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult read =
      run_touchafm("analyse " + folder.file("wavy.tab") + " --baseline waves --fit sphere --radius 5um");
  EXPECT_THAT(read.out, HasSubstr("its waves"));
  EXPECT_THAT(read.out, HasSubstr("their period"));
  EXPECT_THAT(read.out, HasSubstr("modulus E                  2 kPa")) << "the fit has no waves left";
  EXPECT_THAT(run_touchafm("analyse " + folder.file("wavy.tab") + " --json").out,
              HasSubstr("\"baseline_waves_N\": null"));
}

}  // namespace convert_command_test
}  // namespace afm::app
