// SPDX-License-Identifier: Apache-2.0
// Invariant: a moment of a session over a map is drawn with the very file that was felt, or refused; of one pixel
// also without it
#include "exhibit/frame/recorded_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "core/whole_file.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/fitting/map_fit.h"
#include "exhibit/frame/exhibit_setup.h"
#include "servo/session_file.h"
#include "support/archives/jpk_map.h"
#include "support/archives/stored_zip.h"
#include "support/places.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace recorded_map_test {

using testing::HasSubstr;

class RecordedMap : public ::testing::Test {
 protected:
  RecordedMap() {
    const auto gel = [](std::size_t /*index*/) { return test::hertz_curve(300); };
    curves::MapReading reading;
    reading.fit.shape = fits::Shape::Paraboloid;
    reading.fit.radius_m = test::kHertzRadiusM;
    files_.assets_dir = support::source("assets");
    files_.force_map = folder_.write("gel.jpk-force-map", test::stored_zip(test::jpk_map(gel)));
    files_.map_reading = std::make_shared<const curves::MapReading>(reading);
    files_.pixel = {{2, 1}};
    files_.whole_map = true;
    auto stage = load_exhibit(files_);
    EXPECT_TRUE(stage) << stage.error().message;
    auto map = recorded_map_of(*stage, files_);
    EXPECT_TRUE(map) << map.error().message;
    session_.force_map = *map;
    session_.law_map = std::make_shared<const scene::SharedLawMap>(stage->pixel->felt_map->laws);
    session_.parameters.law_map = 1;
  }

  // Files that draw a moment, with the map at this path if one is given.
  core::Result<ExhibitFiles> again(const std::string& force_map = {}) const {
    ExhibitFiles files;
    files.assets_dir = files_.assets_dir;
    files.force_map = force_map;
    return with_recorded_map(session_, folder_.file("kept/session.afms"), files);
  }
  std::string refusal(const std::string& force_map = {}) const {
    const auto files = again(force_map);
    return files ? std::string("accepted") : files.error().message;
  }

  support::ScratchFolder folder_;
  ExhibitFiles files_;
  servo::RecordedSession session_;
};

TEST_F(RecordedMap, IsReadAgainAsItWasFelt) {
  const auto files = again();
  ASSERT_TRUE(files) << files.error().message;
  const auto stage = load_exhibit(*files);
  ASSERT_TRUE(stage) << stage.error().message;
  ASSERT_TRUE(stage->pixel && stage->pixel->felt_map);
  EXPECT_EQ(stage->pixel->pixel->place, (curves::MapPlace{2, 1}));
  EXPECT_EQ(stage->pixel->felt_map->laws.ln_modulus, session_.law_map->ln_modulus);
  EXPECT_EQ(stage->pixel->felt_map->laws.adhesion_j_per_m2, session_.law_map->adhesion_j_per_m2);
}

TEST_F(RecordedMap, MayHaveMovedButNotChanged) {
  const std::string moved = folder_.file("moved.jpk-force-map");
  std::filesystem::rename(files_.force_map, moved);
  EXPECT_THAT(refusal(), HasSubstr("its force map " + files_.force_map + " is missing; give the place of the file"));
  EXPECT_EQ(refusal(moved), "accepted");
  folder_.write("moved.jpk-force-map", core::read_file(moved).value() + " ");
  EXPECT_THAT(refusal(moved), HasSubstr(moved + " is not the force map that was felt, or has changed since"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("it is a folder"));
}

TEST_F(RecordedMap, IsLookedForBesideItsSession) {
  std::filesystem::create_directory(folder_.file("kept"));
  std::filesystem::rename(files_.force_map, folder_.file("kept/gel.jpk-force-map"));
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(RecordedMap, IsMissingFromOlderSessionsAndNeedlessForOthers) {
  session_.force_map->reading = "{}";
  EXPECT_THAT(refusal(), HasSubstr("the reading of its force map is damaged: it has no fit"));
  session_.force_map.reset();
  EXPECT_THAT(refusal(), HasSubstr("it does not name the force map that was felt"));
  session_.law_map.reset();
  EXPECT_EQ(refusal(), "accepted");
  EXPECT_THAT(refusal(files_.force_map), HasSubstr("the hand of this session felt no map"));
}

// The session contains the curve of its pixel, so that the map is only a picture beside it.
TEST_F(RecordedMap, OfOnePixelIsShownIfItIsTheSame) {
  session_.law_map.reset();
  session_.force_map->reading = "{}";
  session_.force_map->pixel = {1, 0};
  const auto files = again();
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_FALSE(files->whole_map);
  const auto stage = load_exhibit(*files);
  ASSERT_TRUE(stage) << stage.error().message;
  ASSERT_TRUE(stage->pixel && !stage->pixel->felt_map);
  EXPECT_EQ(stage->pixel->pixel->place, (curves::MapPlace{1, 0}));

  const std::string moved = folder_.file("moved.jpk-force-map");
  std::filesystem::rename(files_.force_map, moved);
  ASSERT_TRUE(again());
  EXPECT_EQ(again()->force_map, "") << "left out";
  EXPECT_EQ(again(moved)->force_map, moved);
  folder_.write("moved.jpk-force-map", core::read_file(moved).value() + " ");
  EXPECT_THAT(refusal(moved), HasSubstr("is not the force map that was felt")) << "the user names it";
}

}  // namespace recorded_map_test
}  // namespace afm::exhibit
