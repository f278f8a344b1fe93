// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/exit_code.h"
#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/image_file.h"
#include "support/archives/jpk_map.h"
#include "support/archives/stored_zip.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace fit_batch_test {

using testing::HasSubstr;

AnalyseOptions paraboloid(const std::string& folder) {
  AnalyseOptions options;
  options.fit.shape = fits::Shape::Paraboloid;
  options.fit.radius_m = test::kHertzRadiusM;
  options.out = folder;
  return options;
}

// Three curves, each once; a broken file and one that is missing between them.
std::vector<std::string> files_in(const support::ScratchFolder& folder) {
  std::vector<std::string> files;
  for (const char* name : {"a.tab", "b.h5", "c.csv"}) {
    files.push_back(folder.file(name));
    const auto format = files.size() == 1   ? curves::CurveFormat::Tab
                        : files.size() == 2 ? curves::CurveFormat::Hdf5
                                            : curves::CurveFormat::AfmWorkshop;
    const auto written = curves::write_curve(files.back(), format, test::hertz_curve());
    EXPECT_TRUE(written) << written.error().message;
  }
  files.insert(files.begin() + 1, folder.write("broken.tab", "# {\"imaging mode\": \"force-distance\"\n1\t2\n"));
  files.insert(files.begin() + 3, folder.file("missing.tab"));
  return files;
}

std::vector<std::vector<std::string>> rows_of(const std::string& path) {
  std::istringstream text(core::read_file(path).value());
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back(1);
    for (const char letter : line) {
      if (letter == '\t') {
        rows.back().emplace_back();
      } else {
        rows.back().back() += letter;
      }
    }
  }
  return rows;
}

TEST(FitBatch, HasARowAFileWhateverIsInIt) {
  const support::ScratchFolder folder;
  const auto files = files_in(folder);
  const auto done = fit_files(files, paraboloid(folder.file("one")), 1);
  ASSERT_TRUE(done) << done.error().message;
  const auto rows = rows_of(folder.file("one/fits.tsv"));
  ASSERT_EQ(rows.size(), 1 + files.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].size(), rows[0].size());
    EXPECT_EQ(rows[i][0], files[i - 1]);
  }
  ASSERT_EQ(rows[0][3], "modulus_Pa");
  for (const std::size_t i : {1U, 3U, 5U}) {
    EXPECT_NEAR(std::stod(rows[i][3]), test::kHertzModulusPa, 1e-3 * test::kHertzModulusPa) << rows[i][0];
  }
  for (const std::size_t i : {2U, 4U}) {
    EXPECT_EQ(rows[i][1], "none");
    EXPECT_NE(rows[i][2], "");
    EXPECT_EQ(rows[i][3], "");
  }
  EXPECT_THAT(rows[4][2], HasSubstr("there is no such file"));
}

// A spreadsheet would compute "=1+1.tab" instead of showing it.
TEST(FitBatch, HasNoCellThatASpreadsheetTakesForAFormula) {
  const support::ScratchFolder folder;
  const std::string before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const std::vector<std::string> files{"=1+1.tab", "+1.tab", "-1.tab", "@SUM.tab", "\"=1+1\".tab", "a=1.tab"};
  const auto done = fit_files(files, paraboloid("out"), 1);
  std::filesystem::current_path(before);
  ASSERT_FALSE(done) << "none of them exists";
  const auto rows = rows_of(folder.file("out/fits.tsv"));
  ASSERT_EQ(rows.size(), 1 + files.size());
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(rows[i + 1][0], (i < 5 ? "./" : "") + files[i]);
}

// With the unit of --columns the forces are a thousand times too large.
TEST(FitBatch, RemarksOnAHeadingThatContradictsTheColumns) {
  const support::ScratchFolder folder;
  std::string table = "Height [nm]\tForce [pN]\n";
  for (int i = 0; i < 200; ++i) {
    const double z_nm = 400.0 - 4.0 * i, depth_nm = std::max(0.0, -z_nm);
    table += std::to_string(z_nm) + "\t" + std::to_string(std::pow(depth_nm, 1.5) + (i % 2 == 0 ? 0.5 : -0.5)) + "\n";
  }
  const std::string file = folder.write("gel.txt", table);
  const auto done = support::run_program(support::touchafm() + " analyse " + file +
                                         " --columns 'height:nm force:nN' --spring-constant 50N/m --fit paraboloid "
                                         "--radius 5um --out " +
                                         folder.file("out"));
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const auto rows = rows_of(folder.file("out/fits.tsv"));
  ASSERT_EQ(rows.size(), 2U);
  const std::size_t column = rows[0].size() - 3;
  EXPECT_EQ(rows[0][column], "remarks");
  const std::string remark = "the heading of column 2 is \"Force [pN]\", and --columns names another unit";
  EXPECT_EQ(rows[1][column], remark);
  EXPECT_THAT(done.err, HasSubstr("gel.txt: " + remark));
}

TEST(FitBatch, EndsWithAPageOfResultsSettingsAndReasons) {
  const support::ScratchFolder folder;
  const auto files = files_in(folder);
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("out")), 2));
  const std::string page = core::read_file(folder.file("out/report.html")).value();
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</body></html>\n"));
  EXPECT_THAT(page, HasSubstr("<h1>Fits of 5 curves</h1>"));
  EXPECT_THAT(page, HasSubstr("modulus of the trusted and the doubtful: median 3"));
  EXPECT_THAT(page, HasSubstr("<svg")) << "the histograms";
  for (const std::string& file : files) EXPECT_THAT(page, HasSubstr(file)) << file;
  EXPECT_THAT(page, HasSubstr("there is no such file"));
  EXPECT_THAT(page, HasSubstr("<td>radius_m</td>")) << "the settings";
  EXPECT_THAT(page, HasSubstr("paraboloid"));
  const auto again = fit_files(files, paraboloid(folder.file("out")), 1);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("already; name another folder"));
}

TEST(FitBatch, HasTheIntervalsOfABootstrapIfAskedTo) {
  const support::ScratchFolder folder;
  auto options = paraboloid(folder.file("out"));
  options.fit.bootstrap = true;
  ASSERT_TRUE(fit_files(files_in(folder), options, 1));
  const auto rows = rows_of(folder.file("out/fits.tsv"));
  const auto column =
      static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), "modulus_bootstrap_low_Pa") - rows[0].begin());
  ASSERT_LT(column + 1, rows[0].size());
  EXPECT_LE(std::stod(rows[1][column]), std::stod(rows[1][3]) * (1.0 + 1e-9));
  EXPECT_GE(std::stod(rows[1][column + 1]), std::stod(rows[1][3]) * (1.0 - 1e-9));
  EXPECT_EQ(rows[2][column], "") << "no fit";
  EXPECT_EQ(rows[2].size(), rows[0].size());
}

TEST(FitBatch, HasTheSameBytesWithOneThreadAndWithEight) {
  const support::ScratchFolder folder;
  const std::vector<std::string> five = files_in(folder);
  std::vector<std::string> files;
  for (int i = 0; i < 5; ++i) files.insert(files.end(), five.begin(), five.end());
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("one")), 1));
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("eight")), 8));
  EXPECT_EQ(core::read_file(folder.file("one/fits.tsv")).value(),
            core::read_file(folder.file("eight/fits.tsv")).value());
  EXPECT_EQ(core::read_file(folder.file("one/report.html")).value(),
            core::read_file(folder.file("eight/report.html")).value());
}

TEST(FitBatch, TakesAsManyThreadsAsRequested) {
  const support::ScratchFolder folder;
  std::string files;
  for (const std::string& file : files_in(folder)) files += " " + file;
  const auto fit = [&](const std::string& more) {
    return support::run_program(support::touchafm() + " analyse" + files + " --fit paraboloid --radius 5um " + more);
  };
  for (const char* threads : {"1", "8"}) {
    const auto done = fit("--threads " + std::string(threads) + " --out " + folder.file(threads));
    EXPECT_EQ(done.exit_code, 0) << done.err;
  }
  EXPECT_EQ(core::read_file(folder.file("1/fits.tsv")).value(), core::read_file(folder.file("8/fits.tsv")).value());
  EXPECT_EQ(fit("--threads 0 --out " + folder.file("none")).exit_code, 2);
  const auto one = support::run_program(support::touchafm() + " analyse " + folder.file("a.tab") + " --threads 2");
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_THAT(one.err, HasSubstr("--threads is for a table of fits"));
}

TEST(FitBatch, ReplacesNoTable) {
  const support::ScratchFolder folder;
  const auto files = files_in(folder);
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("out")), 2));
  const std::string before = core::read_file(folder.file("out/fits.tsv")).value();
  const auto again = fit_files(files, paraboloid(folder.file("out")), 2);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_EQ(core::read_file(folder.file("out/fits.tsv")).value(), before);
}

TEST(FitBatch, NamesAFolderThatCannotBe) {
  const support::ScratchFolder folder;
  const std::string file = folder.write("taken", "x");
  const auto done = fit_files(files_in(folder), paraboloid(file), 1);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("--out " + file + ": it is no folder"));
}

TEST(FitBatch, OfFilesWithoutACurveFailsAndSaysWhere) {
  const support::ScratchFolder folder;
  const auto done = fit_files({folder.file("a"), folder.file("b")}, paraboloid(folder.file("out")), 2);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(done.error().message, HasSubstr("fits.tsv has the reasons"));
  EXPECT_EQ(rows_of(folder.file("out/fits.tsv")).size(), 3U);
}

// The contact of each curve is 10 nm higher than that of the one before.
std::string map_in(const support::ScratchFolder& folder) {
  return folder.write("gel.jpk-force-map", test::stored_zip(test::jpk_map([](std::size_t index) {
                        curves::RecordedCurve curve = test::hertz_curve(200);
                        for (auto& point : curve.points)
                          point.z = point.z + physics::Length(10e-9 * static_cast<double>(index));
                        return curve;
                      })));
}

TEST(FitBatch, OfAFewCurvesOnALargeGridDrawsTheOthersEmpty) {
  const support::ScratchFolder folder;
  const auto hertz = [](std::size_t) { return test::hertz_curve(200); };
  const std::string map =
      folder.write("few.jpk-qi-data", test::stored_zip(test::on_finer_grid(test::jpk_map(hertz), 65)));
  const auto program = support::run_program(support::touchafm() + " analyse " + map +
                                            " --fit paraboloid --radius 5um --out " + folder.file("out"));
  ASSERT_EQ(program.exit_code, 0) << program.err;
  EXPECT_THAT(program.err, HasSubstr("6 curves on a grid of 195 x 130 pixels: the other pixels are empty"));
  const auto image = curves::load_image(folder.file("out/few.gwy"), {.channel = "Modulus"});
  ASSERT_TRUE(image) << image.error().message;
  const auto& moduli = image->image.channels[image->chosen].values;
  EXPECT_EQ(std::count_if(moduli.begin(), moduli.end(), [](double pa) { return std::isfinite(pa); }), 6);
}

// Two curves at one pixel, and one outside the grid.
TEST(FitBatch, NamesTheCurvesThatAreNotOnTheMap) {
  const support::ScratchFolder folder;
  auto entries = test::jpk_map([](std::size_t) { return test::hertz_curve(200); });
  entries["index/4/header.properties"] = entries["index/3/header.properties"];
  entries["index/0/header.properties"] =
      "force-scan-series.header.position.x=1e-3\nforce-scan-series.header.position.y=0\n";
  const std::string map = folder.write("gel.jpk-force-map", test::stored_zip(entries));
  const auto program = support::run_program(support::touchafm() + " analyse " + map +
                                            " --fit paraboloid --radius 5um --out " + folder.file("out"));
  ASSERT_EQ(program.exit_code, 0) << program.err;
  EXPECT_THAT(program.err, HasSubstr("gel.jpk-force-map: 1 of its curves are outside the grid"));
  EXPECT_THAT(program.err, HasSubstr("gel.jpk-force-map: 1 of its curves share a pixel with a later one"));
  EXPECT_EQ(rows_of(folder.file("out/fits.tsv")).size(), 7U) << "the table has all of them";
}

TEST(FitBatch, KeepsItsRowsWhenItIsInterrupted) {
  const support::ScratchFolder folder;
  std::vector<std::string> command{support::touchafm(), "analyse"};
  command.insert(command.end(), 1000, files_in(folder).front());
  command.insert(command.end(), {"--fit", "paraboloid", "--radius", "5um", "--out", folder.file("out")});
  support::LiveProgram program(command, "");
  const auto table = [&] { return core::read_file(folder.file("out/fits.tsv")).value_or(""); };
  ASSERT_TRUE(program.within(std::chrono::minutes(1), [&] {
    const std::string now = table();
    return std::count(now.begin(), now.end(), '\n') > 3;
  })) << program.said();
  program.signal(SIGINT);
  EXPECT_EQ(program.ends(), static_cast<int>(core::ExitCode::RunFailed)) << program.said();
  EXPECT_THAT(program.said(), HasSubstr("interrupted: "));
  EXPECT_TRUE(table().ends_with('\n'));
  EXPECT_LT(rows_of(folder.file("out/fits.tsv")).size(), 1001U);
}

TEST(FitBatch, OfAMapHasARowACurveAndMapsThatShowThem) {
  const support::ScratchFolder folder;
  const auto files = std::vector<std::string>{files_in(folder).front(), map_in(folder)};
  const auto done = fit_files(files, paraboloid(folder.file("out")), 2);
  ASSERT_TRUE(done) << done.error().message;
  const auto rows = rows_of(folder.file("out/fits.tsv"));
  ASSERT_EQ(rows.size(), 1U + 1U + 6U);
  const auto column = [&rows](const char* name) {
    return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
  };
  ASSERT_LT(column("row"), rows[0].size());
  EXPECT_EQ(rows[1][column("column")], "");
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& row = rows[2 + i];
    EXPECT_EQ(row[column("curve")], std::to_string(i));
    EXPECT_EQ(row[column("column")], std::to_string(test::map_column(i)));
    EXPECT_EQ(row[column("row")], std::to_string(test::map_row(i)));
    EXPECT_NEAR(std::stod(row[3]), test::kHertzModulusPa, 1e-3 * test::kHertzModulusPa);
  }

  const auto image = curves::load_image(folder.file("out/gel.gwy"), {.channel = "Contact height"});
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->image.columns, test::kMapColumns);
  EXPECT_EQ(image->image.rows, test::kMapRows);
  EXPECT_DOUBLE_EQ(image->image.width_m, test::kMapWidthM);
  // the rows from the top: 5 4 3, 0 1 2
  const std::vector<double>& heights = image->image.channels[image->chosen].values;
  const double steps[] = {5, 4, 3, 0, 1, 2};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(heights[i] - heights[3], 10e-9 * steps[i], 1e-10) << i;
  for (const char* picture : {"modulus", "contact", "depth", "trust"}) {
    EXPECT_TRUE(core::read_file(folder.file(std::string("out/gel-") + picture + ".png"))) << picture;
  }
}

TEST(MapBenchmark, ReadsAndFitsEveryCurve) {
  const support::ScratchFolder folder;
  const std::string bench = support::touchafm() + " bench maps " + map_in(folder) + " --json";
  const auto read = support::run_program(bench);
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const auto times = nlohmann::json::parse(read.out);
  EXPECT_EQ(times.at("curves"), 6);
  EXPECT_EQ(times.at("unread"), 0);
  EXPECT_GT(times.at("read_s"), 0.0);
  EXPECT_TRUE(times.at("fit_s").is_null());
  const auto fit = support::run_program(bench + " --fit paraboloid --radius 5um");
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const auto fitted = nlohmann::json::parse(fit.out);
  EXPECT_EQ(fitted.at("fitted"), 6);
  EXPECT_GT(fitted.at("fit_s"), 0.0);
  EXPECT_GT(fitted.at("fit_on_one_thread_s"), 0.0);
  EXPECT_GT(fitted.at("memory_bytes"), 1e6);
  EXPECT_EQ(support::run_program(support::touchafm() + " bench maps " + folder.file("none")).exit_code, 3);
}

TEST(FitBatch, OfAMapHasTheSameBytesWithOneThreadAndWithEight) {
  const support::ScratchFolder folder;
  const std::vector<std::string> files{map_in(folder), map_in(folder)};
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("one")), 1));
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("eight")), 8));
  for (const char* name : {"fits.tsv", "gel.gwy", "gel-2.gwy", "gel-modulus.png"}) {
    EXPECT_EQ(core::read_file(folder.file(std::string("one/") + name)).value(),
              core::read_file(folder.file(std::string("eight/") + name)).value())
        << name;
  }
}

}  // namespace fit_batch_test
}  // namespace afm::app
