// SPDX-License-Identifier: Apache-2.0
#include "exhibit/exhibit_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "exhibit/frame_builder.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

render::RendererOptions Stage::renderer_options(std::uint32_t eye_width) const {
  render::RendererOptions options;
  options.eye_width = eye_width;
  options.eye_height = static_cast<std::uint32_t>(std::lround(eye_width * screen.height_m() / screen.width_m()));
  options.panel_texels_per_m = 2.0 * eye_width / screen.width_m();
  options.panel_millimetre_m = wall_scene.panel_millimetre_m();
  return options;
}

glm::uvec2 Stage::eye_size_within(scene::StereoMode mode, glm::uvec2 window_px) const {
  const glm::uvec2 room = scene::eye_size(mode, window_px);
  if (const auto packing = scene::frame_packing(mode)) {
    // exact in a window of its own size; in a smaller one it is a preview
    const glm::dvec2 shrink = glm::dvec2(window_px) / glm::dvec2(scene::picture_size(mode, packing->eye_px));
    const double scale = std::min({1.0, shrink.x, shrink.y});
    return glm::max(glm::uvec2(glm::round(glm::dvec2(packing->eye_px) * scale)), glm::uvec2(1));
  }
  const double by_height = std::floor(room.y * screen.width_m() / screen.height_m());
  const auto options = renderer_options(std::clamp(static_cast<std::uint32_t>(by_height), 1U, room.x));
  return {options.eye_width, std::clamp(options.eye_height, 1U, room.y)};
}

namespace {

// Those that were asked for; else all of the user's own file, or the paper's three.
core::Result<scene::MaterialLibrary> shown_materials(const ExhibitFiles& files) {
  auto library = scene::load_materials(files.assets_dir + "/materials.toml");
  if (!library) return library;
  std::vector<std::string> names = files.shown;
  if (!files.materials.empty()) {
    auto own = scene::load_materials(files.materials);
    if (!own) return own;
    if (names.empty()) {
      for (const scene::MaterialEntry& entry : own->materials) names.push_back(entry.name);
    }
    library->add(std::move(*own));
  }
  auto shown = library->only(names.empty() ? std::span<const std::string>(scene::kPaperMaterials) : names);
  if (shown) shown->add({files.added});
  if (shown && shown->materials.size() > kMostMaterials) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("{} materials do not fit on the shelf, which holds {}: choose some with --material",
                    shown->materials.size(), kMostMaterials));
  }
  return shown;
}

// The rectangle around all screens if they are tiles of one plane, upright as the first is; else the first screen.
scene::Screen stage_screen(const scene::Wall& wall) {
  const scene::Screen& first = wall.screens.front();
  const glm::dvec3 right = glm::normalize(first.lower_right - first.lower_left);
  const glm::dvec3 up = glm::cross(first.normal(), right);
  glm::dvec2 least(0.0), most(0.0);
  constexpr double kFlatM = 5e-3;  // what a tape measure gets right
  for (const scene::Screen& screen : wall.screens) {
    for (const glm::dvec3& corner : {screen.lower_left, screen.lower_right, screen.upper_left}) {
      const glm::dvec3 from_first = corner - first.lower_left;
      if (std::abs(glm::dot(from_first, first.normal())) > kFlatM) return first;
      const glm::dvec2 place(glm::dot(from_first, right), glm::dot(from_first, up));
      least = glm::min(least, place);
      most = glm::max(most, place);
    }
    if (glm::dot(glm::normalize(screen.lower_right - screen.lower_left), right) < 0.9998) return first;
  }
  const auto corner = [&](double x, double y) { return first.lower_left + x * right + y * up; };
  return wall.screens.size() == 1 ? first
                                  : scene::Screen{.name = "all screens",
                                                  .lower_left = corner(least.x, least.y),
                                                  .lower_right = corner(most.x, least.y),
                                                  .upper_left = corner(least.x, most.y)};
}

}  // namespace

core::Result<Stage> load_exhibit(const ExhibitFiles& files) {
  auto materials = shown_materials(files);
  if (!materials) return tl::unexpected(materials.error());
  auto wall = scene::load_wall(files.wall.empty() ? files.assets_dir + "/walls/powerwall.toml" : files.wall);
  if (!wall) return tl::unexpected(wall.error());
  const scene::Screen screen = stage_screen(*wall);
  const scene::Viewer& viewer = wall->viewers.front();
  const auto eyes = eyes_before(screen, viewer.sweet_spot, viewer.ipd_m);
  if (!eyes) return tl::unexpected(eyes.error());
  const auto own = load_own_models(files.probe, files.sample);
  if (!own) return tl::unexpected(own.error());
  auto wall_scene = WallScene::load(files.assets_dir, *materials, screen, viewer.sweet_spot.position_m, *own);
  if (!wall_scene) return tl::unexpected(wall_scene.error());
  auto guidance = Guidance::load(files.guidance.empty() ? files.assets_dir + "/guidance/en.toml" : files.guidance);
  if (!guidance) return tl::unexpected(guidance.error());
  return Stage{std::move(*materials), std::move(*wall), screen, *eyes, std::move(*wall_scene), std::move(*guidance)};
}

bool is_model_file(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  return ending == ".glb" || ending == ".gltf";
}

}  // namespace afm::exhibit
