// SPDX-License-Identifier: Apache-2.0
#include "app/stage_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "app/frame_builder.h"

namespace afm::app {

render::RendererOptions Stage::renderer_options(std::uint32_t eye_width) const {
  const scene::Screen& screen = wall.screens.front();
  render::RendererOptions options;
  options.eye_width = eye_width;
  options.eye_height = static_cast<std::uint32_t>(std::lround(eye_width * screen.height_m() / screen.width_m()));
  options.panel_texels_per_m = 2.0 * eye_width / screen.width_m();
  return options;
}

glm::uvec2 Stage::eye_size_within(scene::StereoMode mode, glm::uvec2 window_px) const {
  const glm::uvec2 room = scene::eye_size(mode, window_px);
  if (scene::frame_packing(mode)) return room;
  const scene::Screen& screen = wall.screens.front();
  const double by_height = std::floor(room.y * screen.width_m() / screen.height_m());
  const auto options = renderer_options(std::clamp(static_cast<std::uint32_t>(by_height), 1U, room.x));
  return {options.eye_width, std::clamp(options.eye_height, 1U, room.y)};
}

namespace {

// Those that were asked for; else all of the user's own file, or the paper's three.
core::Result<scene::MaterialLibrary> shown_materials(const StageFiles& files) {
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

std::string stereo_mode_list() {
  std::string names;
  for (const scene::NamedStereoMode& entry : scene::kStereoModes) {
    names += names.empty() ? std::string(entry.name) : ", " + std::string(entry.name);
  }
  return names;
}

}  // namespace

core::Result<Stage> load_stage(const StageFiles& files) {
  auto materials = shown_materials(files);
  if (!materials) return tl::unexpected(materials.error());
  auto wall = scene::load_wall(files.wall.empty() ? files.assets_dir + "/walls/powerwall.toml" : files.wall);
  if (!wall) return tl::unexpected(wall.error());
  const auto eyes = eyes_at_sweet_spot(*wall);
  if (!eyes) return tl::unexpected(eyes.error());
  const auto own = load_own_models(files.probe, files.sample);
  if (!own) return tl::unexpected(own.error());
  auto wall_scene = WallScene::load(files.assets_dir, *materials, wall->screens.front(),
                                    wall->viewers.front().sweet_spot.position_m, *own);
  if (!wall_scene) return tl::unexpected(wall_scene.error());
  auto guidance = Guidance::load(files.guidance.empty() ? files.assets_dir + "/guidance/en.toml" : files.guidance);
  if (!guidance) return tl::unexpected(guidance.error());
  return Stage{std::move(*materials), std::move(*wall), *eyes, std::move(*wall_scene), std::move(*guidance)};
}

void add_stereo_options(CLI::App& command, render::Composition& composition) {
  command
      .add_option_function<std::string>(
          "--stereo",
          [&composition](const std::string& name) {
            const auto mode = scene::parse_stereo_mode(name);
            if (!mode) throw CLI::ValidationError("--stereo", mode.error().message);
            composition.mode = *mode;
          },
          fmt::format("how both eyes are shown: {}; default: {}", stereo_mode_list(), scene::name_of(composition.mode)))
      ->type_name("MODE");
  command.add_flag_callback(
      "--swap-eyes", [&composition] { composition.order = scene::EyeOrder::Swapped; }, "left and right exchanged");
}

void add_own_model_options(CLI::App& command, StageFiles& files) {
  command
      .add_option("--probe", files.probe,
                  "glTF model of your own cantilever, with nodes for the roles base and tip (docs/gltf.md)")
      ->type_name("FILE");
  add_own_sample_option(command, files);
}

void add_own_sample_option(CLI::App& command, StageFiles& files) {
  command
      .add_option("--sample", files.sample,
                  "glTF model of your own sample, with a node for the role surface; it is felt as it is drawn")
      ->type_name("FILE");
}

bool is_model_file(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  return ending == ".glb" || ending == ".gltf";
}

void add_stage_options(CLI::App& command, StageFiles& files, const CommandContext& context) {
  files.assets_dir = context.assets_dir;
  command
      .add_option("--wall", files.wall,
                  "wall file (TOML): the screen's corners and the viewer; default: the paper's 10 ft x 7.5 ft wall")
      ->type_name("FILE");
  command
      .add_option("--materials", files.materials,
                  "material file (TOML) of your own, shown instead of mica, gold and silicon nitride of the paper")
      ->type_name("FILE");
  command
      .add_option("--guidance", files.guidance,
                  "what the wall tells a person to do, in another language (TOML, such as assets/guidance/de.toml)")
      ->type_name("FILE");
  command.add_option("--assets", files.assets_dir, "folder of the models, walls and materials")->type_name("DIR");
}

}  // namespace afm::app
