// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/frame/wall_pictures.h"
#include "render/context.h"

namespace afm::exhibit {

// A wall that is about to be drawn into a file: a graphics device, and the picture that is planned for it.
class WallDrawing {
 public:
  // `wall` must outlive it. Fails as render::Context::open, check_picture_size and plan_wall do.
  static core::Result<WallDrawing> open(const scene::Wall& wall, const PictureOptions& options);

  const WallPlan& plan() const { return plan_; }

  // Draws each output of `scene` as `build` says, and writes the file or the two files of write_wall.
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
