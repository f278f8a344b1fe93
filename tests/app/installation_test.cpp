// SPDX-License-Identifier: Apache-2.0
// The installed program, in a folder to which it was moved after it had been installed: what a package's user has.
// Invariant: the installed program can be moved and contains no path of its sources
// Invariant: man page and completion list every command and option
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "app/options/command.h"
#include "core/whole_file.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace installation_test {

namespace fs = std::filesystem;
using support::ProgramResult;
using support::run_program;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

class InstalledProgram : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new support::ScratchFolder;
    const std::string first = folder_->file("first");
    installation_ = run_program(support::cmake() + " --install " + support::built() + " --prefix " + first);
    ASSERT_EQ(installation_.exit_code, 0) << installation_.err;
    fs::rename(first, folder_->file("moved"));
    fs::create_directory(folder_->file("elsewhere"));
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string prefix() { return folder_->file("moved"); }

  // Runs the program in another folder, with an empty environment.
  static ProgramResult touchafm(const std::string& arguments) {
    return run_program("cd " + folder_->file("elsewhere") + " && env -i PATH=/usr/bin:/bin HOME=" + folder_->path() +
                       " " + prefix() + "/bin/touchafm " + arguments);
  }
  static std::string elsewhere(const std::string& name) { return folder_->file("elsewhere/" + name); }
  static std::string read(const std::string& path) { return core::read_file(path).value(); }

  static inline support::ScratchFolder* folder_ = nullptr;
  static inline ProgramResult installation_;
};

TEST_F(InstalledProgram, ComputesAndAnalysesACurveThroughItsHelperForHdf5) {
  const ProgramResult curve = touchafm("curve --material gold --out gold.h5");
  ASSERT_EQ(curve.exit_code, 0) << curve.err;
  const ProgramResult analysis = touchafm("analyse gold.h5");
  EXPECT_EQ(analysis.exit_code, 0) << analysis.err;
  EXPECT_THAT(analysis.out, HasSubstr("pull-off"));
}

TEST_F(InstalledProgram, FindsItsMaterialsWallsModelsAndPrograms) {
  EXPECT_THAT(touchafm("material").out, AllOf(HasSubstr("mica"), HasSubstr("mlct-c")));
  // the examples of the help name files that are there, and included walls
  EXPECT_THAT(touchafm("wall --help").out, HasSubstr(prefix() + "/share/touchafm/guidance/en.toml"));
  EXPECT_EQ(touchafm("wall powerwall").exit_code, 0);
  const std::string examples = prefix() + "/share/doc/touchafm/examples/";
  const ProgramResult wall = touchafm("wall " + examples + "walls/powerwall.toml");
  EXPECT_EQ(wall.exit_code, 0) << wall.err;
  EXPECT_TRUE(fs::exists(examples + "wands/dtrack.toml"));
  EXPECT_TRUE(fs::exists(examples + "guidance/de.toml"));
  EXPECT_THAT(touchafm("doctor --seconds 0.1 --json").out, HasSubstr(prefix() + "/libexec/touchafm/touchafm-servo"));
  const ProgramResult picture = touchafm("render --journey 5 --material mica --eye-width 160 --out lever.png");
  EXPECT_EQ(picture.exit_code, 0) << picture.err;
  EXPECT_TRUE(fs::exists(elsewhere("lever.png")));
}

TEST_F(InstalledProgram, NamesTheAssetsThatItLacks) {
  const support::ScratchFolder broken;
  fs::copy(prefix() + "/libexec", broken.file("libexec"), fs::copy_options::recursive);
  const ProgramResult result = run_program(broken.file("libexec/touchafm/touchafm") + " material");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr(broken.file("share/touchafm/materials.toml")));
}

class InstalledDemonstration : public InstalledProgram {};

TEST_F(InstalledDemonstration, EndsWell) {
  const std::string command = "demo --out out --material mica --hand-speed 200mm/s --eye-width 160";
  ProgramResult demo = touchafm(command);
  // a stalled virtual machine makes the servo release the hand repeatedly: tries again, as a person would
  for (int more = 0; more < 2 && demo.err.find("reduce the load on this machine") != std::string::npos; ++more) {
    demo = touchafm(command);
  }
  EXPECT_EQ(demo.exit_code, 0) << demo.err;
  EXPECT_TRUE(fs::exists(elsewhere("out/report.html")));
}

TEST_F(InstalledProgram, HoldsNoPathOfTheMachineThatBuiltIt) {
  std::vector<std::string> programs;
  for (const fs::directory_entry& file : fs::directory_iterator(prefix() + "/libexec/touchafm")) {
    programs.push_back(file.path().filename());
    const std::string bytes = read(file.path());
    EXPECT_EQ(bytes.find(support::source() + "/"), std::string::npos) << file.path();
  }
  std::sort(programs.begin(), programs.end());
  EXPECT_THAT(programs, ElementsAre("touchafm", "touchafm-bench", "touchafm-guard", "touchafm-hdf5", "touchafm-servo"));
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(prefix())) {
    EXPECT_TRUE(!fs::is_symlink(file) || fs::read_symlink(file).is_relative()) << file.path();
  }
}

TEST_F(InstalledProgram, NamesItsVersionAndCommit) {
  EXPECT_THAT(touchafm("--version").out,
              ::testing::MatchesRegex("touchafm [0-9.]+ \\((commit [0-9a-f]{12,40}(, with uncommitted changes)?|"
                                      "built without git: the commit is not known)\\)\n"));
}

// Sources that were unpacked within somebody else's checkout are not of its commit.
TEST_F(InstalledProgram, ClaimsNoCommitOfSourcesWithoutGit) {
  const support::ScratchFolder tarball;
  fs::create_directory(tarball.file("sources"));
  ASSERT_EQ(run_program("git init -q " + tarball.path()).exit_code, 0);
  const ProgramResult result =
      run_program(support::cmake() + " -DSOURCE=" + tarball.file("sources") + " -DFILE=" + tarball.file("commit.cpp") +
                  " -P " + support::source("cmake/WriteCommit.cmake"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read(tarball.file("commit.cpp")), HasSubstr("built without git"));
}

TEST_F(InstalledProgram, HasADesktopEntryWhoseIconAndProgramExist) {
  const std::string entry = prefix() + "/share/applications/touchafm.desktop";
  const ProgramResult check = run_program("desktop-file-validate " + entry);
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_EQ(check.out, "");
  EXPECT_THAT(read(entry),
              AllOf(HasSubstr("\nExec=env TOUCHAFM_FROM_MENU=1 touchafm view\n"), HasSubstr("\nIcon=touchafm\n")));
  EXPECT_TRUE(fs::exists(prefix() + "/share/icons/hicolor/scalable/apps/touchafm.svg"));
  EXPECT_TRUE(fs::exists(prefix() + "/lib/udev/rules.d/70-touchafm-haptics.rules"));
  EXPECT_TRUE(fs::exists(prefix() + "/lib/udev/rules.d/70-touchafm-wands.rules"));
}

// The --options that a command's help lists.
std::set<std::string> options_of(const std::string& help) {
  std::set<std::string> options;
  const std::regex option(R"(\n +(?:-h,)?(--[a-z-]+))");
  for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found) {
    options.insert((*found)[1]);
  }
  return options;
}

TEST_F(InstalledProgram, HasAManPageOfEveryCommandAndOption) {
  const std::string page = prefix() + "/share/man/man1/touchafm.1.gz";
  // complaints of groff
  const ProgramResult check = run_program("zcat " + page + " | groff -man -ww -z -Kutf8");
  EXPECT_EQ(check.err, "");
  const ProgramResult text = run_program("zcat " + page + " | groff -man -Kutf8 -Tutf8 -P-cbou -rLL=500n");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("touchafm - feel and see"));
  EXPECT_THAT(text.out, HasSubstr("2 wrong usage"));
  EXPECT_THAT(text.out, Not(HasSubstr(support::source())));
  for (const Command& command : kCommands) {
    const std::string name = "touchafm " + std::string(command.name);
    const std::size_t begin = text.out.find("\n   " + name + "\n");
    ASSERT_NE(begin, std::string::npos) << name;
    for (const std::string& option : options_of(touchafm(std::string(command.name) + " --help").out)) {
      if (option == "--help") continue;
      EXPECT_NE(text.out.find("\n       " + option, begin), std::string::npos) << name << " " << option;
    }
  }
}

class Completion : public InstalledProgram {
 protected:
  // Completions that bash offers for the last word.
  static std::vector<std::string> offered(const std::vector<std::string>& words) {
    std::string line = "source " + prefix() + "/share/bash-completion/completions/touchafm; COMP_WORDS=(";
    for (const std::string& word : words) line += "\"" + word + "\" ";
    line += "); COMP_CWORD=" + std::to_string(words.size() - 1) + "; _touchafm; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
    const ProgramResult result = run_program("cd " + prefix() + " && bash -uc '" + line + "'");
    EXPECT_EQ(result.err, "");
    std::vector<std::string> lines;
    std::istringstream text(result.out);
    for (std::string one; std::getline(text, one);) {
      if (!one.empty()) lines.push_back(one);
    }
    return lines;
  }
};

TEST_F(Completion, OffersCommands) {
  EXPECT_THAT(offered({"touchafm", "de"}), ElementsAre("demo", "devices"));
  std::vector<std::string> all;
  for (const Command& command : kCommands) all.emplace_back(command.name);
  EXPECT_THAT(offered({"touchafm", ""}), ::testing::ElementsAreArray(all));
  EXPECT_THAT(offered({"touchafm", "bench", ""}),
              ElementsAre("physics", "fits", "maps", "tapping", "haptics", "render", "cluster"));
}

TEST_F(Completion, OffersEveryOptionOfACommandAndNoOther) {
  for (const Command& command : kCommands) {
    const std::string name(command.name);
    const std::vector<std::string> options = offered({"touchafm", name, "--"});
    EXPECT_EQ(std::set(options.begin(), options.end()), options_of(touchafm(name + " --help").out)) << name;
    EXPECT_EQ(std::set(options.begin(), options.end()).size(), options.size()) << name;
  }
}

TEST_F(Completion, OffersTheValuesOfAnOption) {
  EXPECT_THAT(offered({"touchafm", "curve", "--material", "mi"}), ElementsAre("mica", "mica-air", "mica-water"));
  EXPECT_THAT(offered({"touchafm", "material", "pd"}), ElementsAre("pdms-air"));
  EXPECT_THAT(offered({"touchafm", "view", "--stereo", "=", "side"}), ElementsAre("side-by-side", "side-by-side-half"));
  EXPECT_THAT(offered({"touchafm", "view", "--haptics", ""}), IsSupersetOf({"auto", "hdapi", "sim"}));
  EXPECT_THAT(offered({"touchafm", "curve", "--model", "dynamic-d"}), ElementsAre("dynamic-dmt"));
  EXPECT_THAT(offered({"touchafm", "curve", "--format", ""}), Contains("h5"));
  EXPECT_THAT(offered({"touchafm", "curve", "--tip-radius", ""}), ElementsAre());
  EXPECT_THAT(offered({"touchafm", "wall", "sh"}), ElementsAre("share"));
  EXPECT_THAT(offered({"touchafm", "demo", "--out", "sh"}), ElementsAre("share"));
}

}  // namespace installation_test
}  // namespace afm::app
