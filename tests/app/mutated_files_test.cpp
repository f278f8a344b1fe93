// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "core/whole_file.h"
#include "servo/session_file.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

// Every command on damaged copies of the files that it reads: it does its work, or ends with a code of the table and
// one line that names the file. 2000 runs a row, drawn by a fixed seed, on demand (label long).
namespace afm::app {
namespace mutated_files_test {

using ::testing::HasSubstr;

constexpr int kRuns = 2000;
constexpr std::size_t kLongestError = 1500;

struct Reading {
  const char* name;
  const char* command;  // command in which {} is the folder of the test
  const char* file;     // source file that is damaged
  const char* place;    // path of the damaged copy in the folder
  bool live = false;    // the command goes on until SIGINT, which it gets after 3 s
};

// Session of version 0.1.0, saved again by this version; a part of it must still contain its beginning.
constexpr const char* kSession = "/tests/formats/0.1.0/session-gold.afms";

#define AFM_CORPUS "/tests/fuzz/corpus/"
#define AFM_SMALL_WINDOW "--size 160x120 --eye-width 64 --frame-rate 10 --haptics sim"

constexpr Reading kReadings[]{
    {"AnalyseTouchafmCsv", "analyse {}/damaged.csv", AFM_CORPUS "curve_files/touchafm.csv", "damaged.csv"},
    {"AnalyseWorkshopCsv", "analyse {}/damaged.csv", AFM_CORPUS "curve_files/workshop-volts.csv", "damaged.csv"},
    {"AnalyseTab", "analyse {}/damaged.tab", AFM_CORPUS "curve_files/adhesive.tab", "damaged.tab"},
    {"AnalyseHdf5", "analyse {}/damaged.h5", AFM_CORPUS "hdf5/adhesive.h5", "damaged.h5"},
    {"AnalyseJpk", "analyse {}/damaged.jpk-force", AFM_CORPUS "curve_files/adhesive.jpk-force", "damaged.jpk-force"},
    {"AnalyseIgor", "analyse {}/damaged.ibw", AFM_CORPUS "curve_files/adhesive.ibw", "damaged.ibw"},
    {"AnalyseGsf", "analyse {}/damaged.gsf", AFM_CORPUS "image_files/relief.gsf", "damaged.gsf"},
    {"AnalyseGwy", "analyse {}/damaged.gwy", AFM_CORPUS "image_files/two.gwy", "damaged.gwy"},
    {"AnalyseNanoscope", "analyse {}/damaged.spm", AFM_CORPUS "image_files/four-bytes.spm", "damaged.spm"},
    {"AnalyseIgorImage", "analyse {}/damaged.ibw", AFM_CORPUS "image_files/trace.ibw", "damaged.ibw"},
    {"AnalyseJpkImage", "analyse {}/damaged.jpk", AFM_CORPUS "image_files/slots.jpk", "damaged.jpk"},
    {"CurveOverlay", "curve --material mica --step 1nm --format svg --overlay {}/damaged.csv",
     AFM_CORPUS "curve_files/touchafm.csv", "damaged.csv"},
    {"CurveMaterials", "curve --material gold --step 1nm --materials {}/damaged.toml",
     "/tests/formats/0.1.0/materials.toml", "damaged.toml"},
    {"CurveProbes", "curve --material gold --step 1nm --probe mlct-c --probes {}/damaged.toml",
     "/tests/formats/0.1.0/probes.toml", "damaged.toml"},
    {"Demo", "demo --eye-width 64 --out {}/demo --wall {}/damaged.toml", "/assets/walls/desk-red-cyan.toml",
     "damaged.toml", true},
    {"Devices", "devices --wand-file {}/damaged.toml", AFM_CORPUS "wand/wide.toml", "damaged.toml"},
    {"Lesson", "lesson {}/damaged.toml " AFM_SMALL_WINDOW, AFM_CORPUS "lesson/short.toml", "damaged.toml", true},
    {"Material", "material gold --materials {}/damaged.toml", "/tests/formats/0.1.0/materials.toml", "damaged.toml"},
    {"Paper", "paper --summary {}/damaged.json --out {}/paper", AFM_CORPUS "summary/two.json", "damaged.json"},
    {"Scan", "scan --material gold --pixels 8 --rate 100Hz --json --materials {}/damaged.toml",
     "/tests/formats/0.1.0/materials.toml", "damaged.toml"},
    {"StudyPeople", "study {}/class --out {}/report", AFM_CORPUS "study/people.tsv", "class/participants.tsv"},
    {"StudyEvents", "study {}/class --out {}/report", AFM_CORPUS "study/events.tsv",
     "class/sub-ABCDEF/task-three_events.tsv"},
    {"StudyFacts", "study {}/class --out {}/report", AFM_CORPUS "study/facts.json",
     "class/sub-ABCDEF/task-three_events.json"},
    {"View", "view --wall {}/damaged.toml " AFM_SMALL_WINDOW, "/assets/walls/desk-red-cyan.toml", "damaged.toml", true},
    {"Wall", "wall {}/damaged.toml --json", "/assets/walls/cave.toml", "damaged.toml"},
    {"Replay", "replay {}/damaged.afms", kSession, "damaged.afms"},
    {"RenderSession", "render --at 0.1 --size 48x36 --out /dev/null --session {}/damaged.afms", kSession,
     "damaged.afms"},
    {"RenderGltf", "render --size 48x36 --out /dev/null --gltf {}/damaged.glb", AFM_CORPUS "gltf/triangle.glb",
     "damaged.glb"},
};

std::string whole_file(const char* from_sources) { return core::read_file(support::source() + from_sources).value(); }

std::string in_folder(std::string text, const std::string& folder) {
  for (std::size_t at = text.find("{}"); at != std::string::npos; at = text.find("{}", at)) text.replace(at, 2, folder);
  return text;
}

// Two people, of whom one stopped.
void write_study(const std::string& folder) {
  for (const char* code : {"sub-ABCDEF", "sub-GHIJKL"}) {
    const std::string own = folder + "/" + code;
    std::filesystem::create_directories(own);
    ASSERT_TRUE(core::write_file(own + "/task-three_events.tsv", whole_file(AFM_CORPUS "study/events.tsv")));
    ASSERT_TRUE(core::write_file(own + "/task-three_events.json", whole_file(AFM_CORPUS "study/facts.json")));
  }
  ASSERT_TRUE(core::write_file(folder + "/participants.tsv", whole_file(AFM_CORPUS "study/people.tsv")));
}

std::string damaged(std::string bytes, std::mt19937& random) {
  const auto at = [&] { return bytes.empty() ? 0 : random() % bytes.size(); };
  constexpr std::array<std::string_view, 8> kPieces{"-1", "1e309",   "nan", "\"", "\n", "99999999999999999999",
                                                    "]",  "\xff\xfe"};
  for (auto changes = 1 + random() % 4; changes > 0; --changes) {
    switch (random() % 6) {
      case 0:
        if (!bytes.empty()) bytes[at()] = static_cast<char>(random());
        break;
      case 1:
        if (!bytes.empty()) bytes[at()] ^= static_cast<char>(1U << random() % 8);
        break;
      case 2:
        bytes.resize(at());
        break;
      case 3:
        bytes.erase(at(), 1 + random() % 64);
        break;
      case 4:
        bytes.insert(at(), bytes.substr(at(), random() % 256));
        break;
      default:
        bytes.insert(at(), kPieces[random() % kPieces.size()]);
    }
  }
  return bytes;
}

bool is_interrupted(const support::ProgramResult& done) {
  return done.exit_code == 1 && done.err.ends_with("touchafm: interrupted\n");
}

class MutatedFiles : public ::testing::TestWithParam<Reading> {};

TEST_P(MutatedFiles, AreReadOrRefusedInOneLine) {
  const Reading& reading = GetParam();
  const support::ScratchFolder folder;
  const std::string path = folder.file(reading.place);
  const std::string command = in_folder(reading.command, folder.path());
  std::optional<support::VirtualDisplay> display;
  if (reading.live) display.emplace(640, 480);
  const std::string started = display ? "DISPLAY=" + display->name() + " timeout --preserve-status -s INT -k 30 3 "
                                      : std::string("timeout 30 ");
  const auto read = [&] { return support::run_program(started + support::touchafm() + " " + command); };
  write_study(folder.path() + "/class");
  std::string whole = whole_file(reading.file);
  ASSERT_TRUE(core::write_file(path, whole));
  if (reading.file == kSession) {
    ASSERT_TRUE(servo::save_session(servo::load_session(path).value(), path));
    whole = core::read_file(path).value();
  }
  const auto itself = read();
  ASSERT_TRUE(itself.exit_code == 0 || is_interrupted(itself)) << "the file itself: " << itself.err;
  std::mt19937 random(1515);
  int refused = 0;
  for (int run = 0; run < kRuns; ++run) {
    ASSERT_TRUE(core::write_file(path, damaged(whole, random)));
    const auto done = read();
    EXPECT_TRUE(done.exit_code == 0 || done.exit_code == 1 || done.exit_code == 3)
        << "run " << run << " ended with " << done.exit_code << ": " << done.err;
    if (done.exit_code == 0 || is_interrupted(done)) continue;
    ++refused;
    const auto error = done.err.find("error: ");
    ASSERT_NE(error, std::string::npos) << "run " << run << ": " << done.err;
    const std::string said = done.err.substr(error);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << "run " << run << ": " << said;
    EXPECT_LT(said.size(), kLongestError) << "run " << run << ": " << said;
    EXPECT_THAT(said, HasSubstr(path)) << "run " << run << ": " << said;
  }
  std::printf("%s: %d of %d were refused\n", reading.name, refused, kRuns);
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, MutatedFiles, testing::ValuesIn(kReadings),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace mutated_files_test
}  // namespace afm::app
