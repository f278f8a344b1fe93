// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <string>
#include <string_view>

#include "core/whole_file.h"
#include "places.h"
#include "servo/session_file.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// Every command on damaged copies of the files that it reads: it does its work, or ends with a code of the table and
// one line that names the file. 2000 runs a row, drawn by a fixed seed, on demand (label long).
namespace afm::app {
namespace {

using ::testing::HasSubstr;

constexpr int kRuns = 2000;
constexpr std::size_t kLongestError = 1500;

struct Reading {
  const char* name;
  const char* before;  // of the command line, before the file
  const char* after;
  const char* file;    // that is damaged, from the sources
  const char* ending;  // of its name
};

// Of 0.1.0, saved as this version does: one that is cut holds what came before.
constexpr const char* kSession = "/tests/formats/0.1.0/session-gold.afms";

#define AFM_CORPUS "/tests/fuzz/corpus/"

constexpr Reading kReadings[]{
    {"AnalyseTouchafmCsv", "analyse ", "", AFM_CORPUS "curve_files/touchafm.csv", ".csv"},
    {"AnalyseWorkshopCsv", "analyse ", "", AFM_CORPUS "curve_files/workshop-volts.csv", ".csv"},
    {"AnalyseTab", "analyse ", "", AFM_CORPUS "curve_files/adhesive.tab", ".tab"},
    {"AnalyseHdf5", "analyse ", "", AFM_CORPUS "hdf5/adhesive.h5", ".h5"},
    {"AnalyseJpk", "analyse ", "", AFM_CORPUS "curve_files/adhesive.jpk-force", ".jpk-force"},
    {"AnalyseIgor", "analyse ", "", AFM_CORPUS "curve_files/adhesive.ibw", ".ibw"},
    {"AnalyseGsf", "analyse ", "", AFM_CORPUS "image_files/relief.gsf", ".gsf"},
    {"AnalyseGwy", "analyse ", "", AFM_CORPUS "image_files/two.gwy", ".gwy"},
    {"AnalyseNanoscope", "analyse ", "", AFM_CORPUS "image_files/four-bytes.spm", ".spm"},
    {"AnalyseIgorImage", "analyse ", "", AFM_CORPUS "image_files/trace.ibw", ".ibw"},
    {"AnalyseJpkImage", "analyse ", "", AFM_CORPUS "image_files/slots.jpk", ".jpk"},
    {"CurveOverlay", "curve --material mica --step 1nm --format svg --overlay ", "",
     AFM_CORPUS "curve_files/touchafm.csv", ".csv"},
    {"CurveMaterials", "curve --material gold --step 1nm --materials ", "", "/tests/formats/0.1.0/materials.toml",
     ".toml"},
    {"CurveProbes", "curve --material gold --step 1nm --probe mlct-c --probes ", "", "/tests/formats/0.1.0/probes.toml",
     ".toml"},
    {"Material", "material gold --materials ", "", "/tests/formats/0.1.0/materials.toml", ".toml"},
    {"Wall", "wall ", " --json", "/assets/walls/cave.toml", ".toml"},
    {"Replay", "replay ", "", kSession, ".afms"},
    {"RenderSession", "render --at 0.1 --size 48x36 --out /dev/null --session ", "", kSession, ".afms"},
    {"RenderGltf", "render --size 48x36 --out /dev/null --gltf ", "", AFM_CORPUS "gltf/triangle.glb", ".glb"},
};

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

class MutatedFiles : public ::testing::TestWithParam<Reading> {};

TEST_P(MutatedFiles, AreReadOrRefusedInOneLine) {
  const Reading& reading = GetParam();
  const support::ScratchFolder folder;
  const std::string path = folder.file(std::string("damaged") + reading.ending);
  const auto read = [&] {
    return support::run_program(std::string("timeout 30 " AFM_PROGRAM " ") + reading.before + path + reading.after);
  };
  std::string whole = core::read_file(std::string(AFM_SOURCE_DIR) + reading.file).value();
  ASSERT_TRUE(core::write_file(path, whole));
  if (reading.file == kSession) {
    ASSERT_TRUE(servo::save_session(servo::load_session(path).value(), path));
    whole = core::read_file(path).value();
  }
  ASSERT_EQ(read().exit_code, 0) << "the file itself: " << read().err;
  std::mt19937 random(1515);
  int refused = 0;
  for (int run = 0; run < kRuns; ++run) {
    ASSERT_TRUE(core::write_file(path, damaged(whole, random)));
    const auto done = read();
    EXPECT_TRUE(done.exit_code == 0 || done.exit_code == 1 || done.exit_code == 3)
        << "run " << run << " ended with " << done.exit_code << ": " << done.err;
    if (done.exit_code == 0) continue;
    ++refused;
    const auto error = done.err.find("error: ");
    ASSERT_NE(error, std::string::npos) << "run " << run << ": " << done.err;
    const std::string said = done.err.substr(error);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << "run " << run << ": " << said;
    EXPECT_LT(said.size(), kLongestError) << "run " << run << ": " << said;
    EXPECT_THAT(said, HasSubstr(path)) << "run " << run;
  }
  std::printf("%s: %d of %d were refused\n", reading.name, refused, kRuns);
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, MutatedFiles, testing::ValuesIn(kReadings),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace afm::app
