// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/frame/wall_pictures.h"
#include "render/context.h"

namespace afm::exhibit {

// A wall that will be drawn into a file: the graphics device and the planned picture.
class WallDrawing {
 public:
  // `wall` must outlive the object. Fails as render::Context::open, check_picture_size and plan_wall do.
  static core::Result<WallDrawing> open(const scene::Wall& wall, const PictureOptions& options);

  const WallPlan& plan() const { return plan_; }

  // Draws each output of `scene` with the frames of `build`, and writes the file or files of write_wall.
  core::Result<void> write(const scene::Scene& scene, double panel_millimetre_m, const BuildFrame& build,
                           const std::string& path);

 private:
  WallDrawing(const scene::Wall& wall, const PictureOptions& options, render::Context context, WallPlan plan);

  const scene::Wall* wall_;
  PictureOptions options_;
  render::Context context_;
  WallPlan plan_;
};

}  // namespace afm::exhibit
