// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/wall_model.h"

#include <gtest/gtest.h>

#include <span>

#include "core/whole_file.h"
#include "support/samples/tapped_sample.h"
#include "support/scratch_folder.h"

namespace wall_model_test {

using namespace afm;
using namespace afm::exhibit;

TEST(WallModelTest, ComesBackAndRefusesWhatIsNotValid) {
  WallModel model;
  model.build = 0xFEDCBA9876543210ULL;
  model.scene = 12;
  model.wall = "[[screen]]";
  model.meshes = {{"meshes/left.csv", "0,0"}};
  model.files.language = "de";
  model.files.shown = {"mica", "gold"};
  model.picture.mode = scene::StereoMode::SideBySide;
  model.picture.order = scene::EyeOrder::Swapped;
  model.files.text_size = 1.25;
  model.files.pixel = {3, 1};
  model.contrast = render::PanelContrast::High;
  model.tapping = test::tapped_hand();
  const auto document = document_of(model);
  const auto came = read_wall_model(document);
  ASSERT_TRUE(came) << came.error().message;
  EXPECT_EQ(came->build, model.build);
  EXPECT_EQ(came->files.shown, model.files.shown);
  EXPECT_EQ(came->picture.mode, model.picture.mode);
  EXPECT_EQ(came->picture.order, model.picture.order);
  EXPECT_EQ(came->files.text_size, 1.25);
  EXPECT_EQ(came->files.pixel, model.files.pixel);
  EXPECT_EQ(came->contrast, render::PanelContrast::High);
  EXPECT_EQ(came->tapping.choice.mode, "tapping");
  EXPECT_EQ(came->tapping.choice.numbers.free_amplitude, "20nm");
  EXPECT_EQ(came->tapping.model, "dmt");
  EXPECT_EQ(came->tapping.values, model.tapping.values);
  for (std::size_t length = 0; length < document.size(); ++length) {
    EXPECT_FALSE(read_wall_model(std::span(document).first(length))) << length;
  }
  EXPECT_EQ(came->meshes, model.meshes);
  const support::ScratchFolder folder;
  const auto files = unpack(*came, "assets", folder.path());
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_EQ(core::read_file(files->wall), model.wall);
  EXPECT_EQ(core::read_file(folder.file("wall/meshes/left.csv")), "0,0");
  for (const char* const elsewhere : {"/etc/passwd", "../left.csv", "meshes/../../left.csv", "meshes/", ""}) {
    model.meshes = {{elsewhere, "0,0"}};
    EXPECT_FALSE(read_wall_model(document_of(model))) << elsewhere;
  }
  model.meshes.clear();
  model.files.text_size = 100.0;
  EXPECT_FALSE(read_wall_model(document_of(model)));
  model.files.text_size = 1.0;
  model.files.language = "xx";
  EXPECT_FALSE(read_wall_model(document_of(model)));
  model.files.language = "de";
  EXPECT_TRUE(read_wall_model(document_of(model)));
  model.tapping.values["no-such-option"] = "1";
  EXPECT_FALSE(read_wall_model(document_of(model)));
  model.tapping = {};
  model.tapping.choice.mode = "no-such-mode";
  EXPECT_FALSE(read_wall_model(document_of(model)));
}

}  // namespace wall_model_test
