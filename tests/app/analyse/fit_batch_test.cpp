// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "support/hertz_curve.h"
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

TEST(FitBatch, HasTheSameBytesWithOneThreadAndWithEight) {
  const support::ScratchFolder folder;
  const std::vector<std::string> five = files_in(folder);
  std::vector<std::string> files;
  for (int i = 0; i < 5; ++i) files.insert(files.end(), five.begin(), five.end());
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("one")), 1));
  ASSERT_TRUE(fit_files(files, paraboloid(folder.file("eight")), 8));
  EXPECT_EQ(core::read_file(folder.file("one/fits.tsv")).value(),
            core::read_file(folder.file("eight/fits.tsv")).value());
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

TEST(FitBatch, OfFilesWithoutACurveFailsAndSaysWhere) {
  const support::ScratchFolder folder;
  const auto done = fit_files({folder.file("a"), folder.file("b")}, paraboloid(folder.file("out")), 2);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(done.error().message, HasSubstr("fits.tsv has the reasons"));
  EXPECT_EQ(rows_of(folder.file("out/fits.tsv")).size(), 3U);
}

}  // namespace fit_batch_test
}  // namespace afm::app
