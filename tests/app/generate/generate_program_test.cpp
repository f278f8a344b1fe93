// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/whole_file.h"
#include "support/deep.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

// `touchafm generate`: `touchafm analyse` finds the truth, and files are written with their truth or not at all.
namespace afm {
namespace generate_program_test {

using nlohmann::json;
using support::ProgramResult;
using support::run_touchafm;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kGel = "--modulus 3kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN";
constexpr const char* kSticky =
    "--law jkr --radius 1um --modulus 1MPa --work-of-adhesion 20mJ/m2 --spring-constant 1N/m --most-force 200nN";

void expect_done(const std::string& arguments) {
  const ProgramResult result = run_touchafm(arguments);
  EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
}

json truth_of(const std::string& file) {
  const auto text = core::read_file(file + ".truth.json");
  EXPECT_TRUE(text) << text.error().message;
  return text ? json::parse(*text) : json();
}

// Rows of a fit's table by the names of its columns.
using Row = std::map<std::string, std::string>;
std::vector<Row> fits_of(const support::ScratchFolder& folder, const std::string& file, const std::string& fit) {
  const ProgramResult result = run_touchafm("analyse " + file + " " + fit + " --out " + folder.file("fits"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream table(core::read_file(folder.file("fits/fits.tsv")).value_or(""));
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(table, line);) {
    std::istringstream cells(line);
    std::size_t column = 0;
    if (!names.empty()) rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, '\t'); ++column) {
      if (rows.empty()) {
        names.push_back(cell);
      } else {
        rows.back()[names.at(column)] = cell;
      }
    }
  }
  return rows;
}

double number(const Row& row, const char* column) { return std::stod(row.at(column)); }

// Half of a 95 % interval is 1.96 standard deviations.
double deviation(const Row& row, const char* low, const char* high) {
  return (number(row, high) - number(row, low)) / (2.0 * 1.96);
}

// 20 curves of different noise: each within three standard deviations, their mean too.
void expect_modulus(const std::vector<Row>& rows, const json& truth) {
  ASSERT_EQ(rows.size(), truth["curves"].size());
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double modulus_pa = truth["curves"][i]["modulus_Pa"];
    const double off =
        (number(rows[i], "modulus_Pa") - modulus_pa) / deviation(rows[i], "modulus_low_Pa", "modulus_high_Pa");
    EXPECT_LT(std::abs(off), 3.0 + 0.5) << i;  // the interval of so many curves is itself known to a tenth or so
    sum += off;
  }
  EXPECT_LT(std::abs(sum), 3.0 * std::sqrt(static_cast<double>(rows.size())));
}

// The contact point has no interval, so the scatter of the curves judges it.
void expect_contact(const std::vector<Row>& rows, const json& truth, double most_spread_m) {
  const double contact_m = truth["curves"][0]["contact_z_m"], count = static_cast<double>(rows.size());
  double mean_m = 0.0, square_m2 = 0.0;
  for (const Row& row : rows) mean_m += (number(row, "contact_m") - contact_m) / count;
  for (const Row& row : rows) square_m2 += std::pow(number(row, "contact_m") - contact_m - mean_m, 2.0) / (count - 1.0);
  const double spread_m = std::sqrt(square_m2);
  EXPECT_LT(spread_m, most_spread_m);
  EXPECT_LT(std::abs(mean_m), 3.0 * spread_m / std::sqrt(count));
  for (const Row& row : rows) EXPECT_NEAR(number(row, "contact_m"), contact_m, 3.0 * spread_m + std::abs(mean_m));
}

struct Kind {
  const char* name;
  const char* setup;
  const char* fit;
  double most_spread_m;  // largest standard deviation of the contact point
};

void PrintTo(const Kind& kind, std::ostream* to) { *to << kind.name; }

class GeneratedCurves : public testing::TestWithParam<Kind> {};

TEST_P(GeneratedCurves, GiveTheirTruthBack) {
  const support::ScratchFolder folder;
  const std::string file = folder.file("curves.h5");
  expect_done(
      fmt::format("generate curve {} --count 20 --points 400 --contact 200nm --out {}", GetParam().setup, file));
  const json truth = truth_of(file);
  const std::vector<Row> rows = fits_of(folder, file, GetParam().fit);
  expect_modulus(rows, truth);
  expect_contact(rows, truth, GetParam().most_spread_m);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!truth["curves"][i].contains("work_of_adhesion_J_per_m2")) continue;
    const double off = number(rows[i], "W_J_per_m2") - truth["curves"][i]["work_of_adhesion_J_per_m2"].get<double>();
    EXPECT_LT(std::abs(off), 3.5 * deviation(rows[i], "W_low_J_per_m2", "W_high_J_per_m2")) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, GeneratedCurves,
    testing::Values(
        Kind{"Paraboloid",
             "--modulus 3kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN --noise 15pN --level 2nN",
             "--fit paraboloid --radius 5um", 10e-9},
        Kind{"SphereOfColouredNoise",
             "--law sphere --modulus 3kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN --noise 15pN "
             "--noise-memory 0.8 --tilt 0.1mN/m",
             "--fit sphere --radius 5um --tilt", 40e-9},
        Kind{"DigitisedCone",
             "--law cone --modulus 10kPa --half-angle 20deg --spring-constant 0.05N/m --most-force 2nN --noise 15pN "
             "--sensitivity 50nm/V --bits 14",
             "--fit cone --half-angle 20deg", 20e-9},
        Kind{"Layer",
             "--law layer-exact-sphere --modulus 1kPa --radius 5um --layer 5um --poisson 0.4 --spring-constant 0.05N/m "
             "--most-force 1nN --noise 15pN",
             "--fit layer-exact-sphere --radius 5um --layer 5um --poisson 0.4", 40e-9},
        Kind{"Jkr",
             "--law jkr --radius 1um --modulus 1MPa --work-of-adhesion 20mJ/m2 --spring-constant 1N/m "
             "--most-force 200nN --noise 300pN",
             "--fit jkr --radius 1um", 2e-9}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(GeneratedMap, HasItsFieldInTheTableOfFits) {
  const support::ScratchFolder folder;
  const std::string file = folder.file("map.h5");
  expect_done(
      fmt::format("generate map {} --noise 15pN --points 300 --pixels 6x4 --size 12um --field step "
                  "--second-modulus 12kPa --out {}",
                  kGel, file));
  const json truth = truth_of(file);
  const std::vector<Row> rows = fits_of(folder, file, "--fit paraboloid --radius 5um");
  expect_modulus(rows, truth);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto column = static_cast<std::size_t>(number(rows[i], "column")),
               row = static_cast<std::size_t>(number(rows[i], "row"));
    EXPECT_EQ(column, i % 6);
    EXPECT_EQ(row, i / 6);
    EXPECT_EQ(truth["map"]["modulus_Pa"][row][column], column < 3 ? 3000.0 : 12000.0);
    EXPECT_NEAR(number(rows[i], "x_m"), (static_cast<double>(column) - 2.5) * 2e-6, 1e-15);
    EXPECT_NEAR(number(rows[i], "y_m"), (static_cast<double>(row) - 1.5) * 2e-6, 1e-15);
  }
  EXPECT_TRUE(fs::exists(folder.file("fits/map.gwy")));
}

TEST(GeneratedImage, ComesWithTheSurfaceOnItsGrid) {
  const support::ScratchFolder folder;
  const std::string file = folder.file("mica.gwy");
  expect_done("generate image --material mica --size 40nm --pixels 16 --rate 20Hz --seed 3 --out " + file);
  const json truth = truth_of(file);
  EXPECT_EQ(truth["seed"], 3);
  EXPECT_EQ(truth["surface"], "mica.gwy.truth.gwy");
  for (const std::string& image : {file, file + ".truth.gwy"}) {
    const ProgramResult read = run_touchafm("analyse --json " + image);
    ASSERT_EQ(read.exit_code, 0) << read.err;
    const json figures = json::parse(read.out);
    EXPECT_EQ(figures.dump().find("nan"), std::string::npos);
    EXPECT_THAT(read.out, HasSubstr("16"));
  }
}

void wait_for_the_next_second() {
  for (const std::time_t now = std::time(nullptr); std::time(nullptr) == now;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

// HDF5 writes the time, in whole seconds, into its files unless this is switched off.
TEST(Generated, AgainInAnotherSecondIsTheSameBytes) {
  const support::ScratchFolder folder;
  for (const char* ending : {"h5", "tab", "csv"}) {
    const std::string first = folder.file(std::string("a.") + ending), second = folder.file(std::string("b.") + ending);
    expect_done(fmt::format("generate curve {} --noise 15pN --seed 7 --out {}", kGel, first));
    wait_for_the_next_second();
    expect_done(fmt::format("generate curve {} --noise 15pN --seed 7 --out {}", kGel, second));
    EXPECT_EQ(core::read_file(first).value(), core::read_file(second).value()) << ending;
    EXPECT_EQ(core::read_file(first + ".truth.json").value(), core::read_file(second + ".truth.json").value());
    EXPECT_EQ(run_touchafm("analyse " + first).exit_code, 0) << ending;
  }
  const std::string other = folder.file("c.h5");
  expect_done(fmt::format("generate curve {} --noise 15pN --seed 8 --out {}", kGel, other));
  EXPECT_NE(core::read_file(folder.file("a.h5")).value(), core::read_file(other).value());
}

// Expects a refusal in one line, with no file left.
void expect_refusal(const std::string& arguments, const std::string& part, const std::string& name = "curve.h5") {
  const support::ScratchFolder folder;
  const ProgramResult result = run_touchafm("generate " + arguments + " --out " + folder.file(name));
  EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.err;
  EXPECT_THAT(result.err, HasSubstr(part)) << arguments;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(fs::is_empty(folder.path())) << arguments;
}

TEST(Generated, RefusesWhatItsLawDoesNotUse) {
  const std::string gel = std::string("curve ") + kGel, sticky = std::string("curve ") + kSticky;
  expect_refusal(gel + " --half-angle 20deg", "--half-angle: --law paraboloid has no use for it");
  expect_refusal(gel + " --work-of-adhesion 1mJ/m2", "--work-of-adhesion: --law paraboloid has no use for it");
  expect_refusal(gel + " --base sliding", "--law paraboloid has no use for --base");
  expect_refusal(gel + " --noise-memory 0.9", "it needs --noise");
  expect_refusal(gel + " --bits 12", "it needs --sensitivity");
  expect_refusal(gel + " --bits 12.5 --sensitivity 50nm/V", "--bits is a whole number");
  expect_refusal(gel + " --wave 10pN", "--wave needs --wave-period");
  expect_refusal(gel + " --law auto", "auto");
  expect_refusal(gel + " --law layer-sphere --layer 5um --poisson 0.3", "needs a Poisson's ratio of 0.5");
  expect_refusal("curve --radius 5um --most-force 1nN", "--law paraboloid needs --modulus");
  expect_refusal("curve --law jkr --modulus 1MPa", "--law jkr needs --work-of-adhesion");
  expect_refusal("curve --law layer-cone --modulus 1kPa", "--law layer-cone needs --layer");
  expect_refusal(sticky + " --atomic-distance 0.2nm", "--law jkr has no use for it");
  expect_refusal("map " + std::string(kGel) + " --field step", "needs --second-modulus");
  expect_refusal("map " + std::string(kGel) + " --second-modulus 1kPa", "--field uniform has no second value");
}

TEST(Generated, RefusesWhatIsUnphysical) {
  const std::string gel = std::string("curve ") + kGel;
  expect_refusal(gel + " --noise nanpN", "--noise: cannot read");
  expect_refusal(gel + " --noise -3pN", "is outside");
  expect_refusal(gel + " --noise 3", "it has no unit");
  expect_refusal(gel + " --seed soon", "--seed: cannot read \"soon\" as a number that it takes");
  expect_refusal(gel + " --seed=-1", "--seed: \"-1\" is negative");
  expect_refusal(gel + " --drift 0.9um/s", "faster than half the base's");
  expect_refusal("curve --modulus 3kPa --radius 5um --spring-constant 0.05N/m --most-force 1uN",
                 "more than its radius, where its paraboloid is no sphere");
  expect_refusal(
      "curve --law layer-sphere --layer 200nm --modulus 1kPa --radius 5um --spring-constant 0.05N/m "
      "--most-force 1nN",
      "deeper than the layer's formula holds");
  expect_refusal(std::string("curve ") + kSticky + " --clearance 1nm", "the tip comes off");
  expect_refusal("map " + std::string(kGel) + " --pixels 512x512", "lower their number or --points");
}

TEST(Generated, RefusesAFormatThatCannotHoldIt) {
  expect_refusal(std::string("curve ") + kGel, "name a file that ends in .h5", "curve.xyz");
  expect_refusal(std::string("curve --count 2 ") + kGel, "afmformats .tab holds one alone", "curve.tab");
  expect_refusal("image --material mica --pixels 8", "name a file that ends in .gwy", "image.gsf");
}

TEST(Generated, ReplacesNoFileAndLeavesNoneAlone) {
  for (const char* existing : {"curve.h5", "curve.h5.truth.json"}) {
    const support::ScratchFolder folder;
    folder.write(existing, "mine");
    const ProgramResult result = run_touchafm(fmt::format("generate curve {} --out {}", kGel, folder.file("curve.h5")));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(std::string(existing) + ": it exists already"));
    EXPECT_EQ(core::read_file(folder.file(existing)).value(), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  }
}

TEST(Generated, MapThatIsInterruptedLeavesNothing) {
  const support::ScratchFolder folder;
  const std::string file = folder.file("map.h5");
  support::LiveProgram map(
      {support::touchafm(), "generate", "map", "--modulus", "3kPa", "--radius", "5um", "--spring-constant", "0.05N/m",
       "--most-force", "1nN", "--pixels", "100x100", "--points", "100", "--out", file},
      "");
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (fs::is_empty(folder.path()) && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_FALSE(fs::is_empty(folder.path())) << "it has begun: " << map.said();
  map.signal(SIGTERM);
  EXPECT_EQ(map.ends().value_or(-1), 1) << map.said();
  EXPECT_THAT(map.said(), HasSubstr("interrupted"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// A limit on the size of files fails as a full disk does.
TEST(Generated, OnAFullDiskLeavesNothing) {
  const std::vector<std::string> made{fmt::format("curve {} --points 5000 --out curve.tab", kGel),
                                      fmt::format("curve {} --points 60 --count 40 --out curves.h5", kGel),
                                      fmt::format("map {} --points 100 --pixels 4x4 --out map.h5", kGel),
                                      "image --material mica --size 40nm --pixels 32 --rate 20Hz --out mica.gwy"};
  for (const std::string& arguments : made) {
    for (const int blocks : {1, 8}) {
      const support::ScratchFolder folder;
      const ProgramResult result = support::run_program(fmt::format(
          "bash -c 'cd {} && ulimit -f {} && {} generate {}'", folder.path(), blocks, support::touchafm(), arguments));
      EXPECT_EQ(result.exit_code, 1) << arguments << "\n" << result.err;
      EXPECT_THAT(result.err, HasSubstr("cannot write")) << arguments;
      EXPECT_TRUE(fs::is_empty(folder.path())) << arguments;
    }
  }
}

// The name of the file is legal, that of its truth is too long.
TEST(Generated, WithoutAPlaceForItsTruthIsNotWritten) {
  for (const auto& [arguments, ending] :
       {std::pair(fmt::format("curve {}", kGel), ".h5"), std::pair(fmt::format("map {} --pixels 2x2", kGel), ".h5"),
        std::pair(std::string("image --material mica --pixels 8"), ".gwy")}) {
    const support::ScratchFolder folder;
    const std::string file = folder.file(std::string(250, 'a') + ending);
    const ProgramResult result = run_touchafm("generate " + arguments + " --out " + file);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("cannot write"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
    fs::create_directory(folder.file("it" + std::string(ending) + ".truth.json"));
    EXPECT_EQ(run_touchafm("generate " + arguments + " --out " + folder.file("it") + ending).exit_code, 2);
    EXPECT_FALSE(fs::exists(folder.file("it") + ending));
  }
  const ProgramResult nowhere = run_touchafm(fmt::format("generate curve {} --out /proc/curve.h5", kGel));
  EXPECT_EQ(nowhere.exit_code, 1) << nowhere.err;
}

// Whenever it is killed: the truth is there wherever the file is, and after a signal that it can take also the reverse.
TEST(Generated, IsNeverWithoutItsTruthWhenItIsKilled) {
  std::size_t pairs = 0, none = 0;
  const int step = support::deep() ? 15 : 60;
  for (const int signal : {SIGTERM, SIGKILL}) {
    // up to later times on a busy machine, until one run has ended
    for (int tenths_ms = 0; tenths_ms < 600 || (pairs == 0 && tenths_ms < 60'000); tenths_ms += step) {
      const support::ScratchFolder folder;
      const std::string file = folder.file("curve.tab");
      support::LiveProgram curve(
          {support::touchafm(), "generate", "curve", "--modulus", "3kPa", "--radius", "5um", "--spring-constant",
           "0.05N/m", "--most-force", "1nN", "--points", "50", "--out", file},
          "");
      std::this_thread::sleep_for(std::chrono::microseconds(100 * tenths_ms));
      curve.signal(signal);
      ASSERT_TRUE(curve.ends());
      const bool has_file = fs::exists(file), has_truth = fs::exists(file + ".truth.json");
      EXPECT_TRUE(has_truth || !has_file) << signal << " after " << tenths_ms;
      EXPECT_TRUE(signal == SIGKILL || has_truth == has_file) << tenths_ms;
      ++(has_file ? pairs : none);
    }
  }
  EXPECT_GT(pairs, 0U);
  EXPECT_GT(none, 0U);
}

}  // namespace generate_program_test
}  // namespace afm
