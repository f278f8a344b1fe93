// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "exhibit/scenery/wall_scene.h"
#include "scene/display/wall.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::test {

// The paper's samples in front of the paper's wall, as displayed.
class PaperWall : public ::testing::Test {
 protected:
  const std::string assets_ = support::source("assets");
  const scene::MaterialLibrary materials_ =
      scene::load_materials(assets_ + "/materials.toml").value().only(scene::kPaperMaterials).value();
  const scene::Wall wall_ = scene::load_wall(assets_ + "/walls/powerwall.toml").value();
  const exhibit::WallScene scene_ =
      exhibit::WallScene::load(assets_, materials_, exhibit::stage_place(wall_), english()).value();

  scene::NodeIndex node(const std::string& name) const { return scene_.scene().find_node(name).value(); }
};

}  // namespace afm::test
