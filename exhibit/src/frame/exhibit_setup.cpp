// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/exhibit_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/log.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/tapping/driven_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/models/topography_model.h"
#include "exhibit/models/user_models.h"
#include "frame/force_map.h"
#include "physics/quantity_text.h"
#include "render/renderer.h"
#include "scene/display/wall_doubts.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

std::vector<std::string> Stage::titles() const {
  std::vector<std::string> titles;
  titles.reserve(materials.materials.size());
  for (const scene::MaterialEntry& entry : materials.materials) titles.push_back(phrases().word(entry.title));
  return titles;
}

std::span<const scene::SharedMeasuredCurve> Stage::recorded_curves() const {
  if (!pixel || pixel->felt_map) return {};
  return {&pixel->pixel->measured.curve, 1};
}

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
    // exact in a window of this size, a preview in a smaller one
    const glm::dvec2 shrink = glm::dvec2(window_px) / glm::dvec2(scene::picture_size(mode, packing->eye_px));
    const double scale = std::min({1.0, shrink.x, shrink.y});
    return glm::max(glm::uvec2(glm::round(glm::dvec2(packing->eye_px) * scale)), glm::uvec2(1));
  }
  const double by_height = std::floor(room.y * screen.width_m() / screen.height_m());
  const auto options = renderer_options(std::clamp(static_cast<std::uint32_t>(by_height), 1U, room.x));
  return {options.eye_width, std::clamp(options.eye_height, 1U, room.y)};
}

namespace {

// Requested materials; otherwise all of the user's file, or the paper's three.
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

// Loads the set of particles; null if none is wanted.
core::Result<std::shared_ptr<const scene::ParticleSet>> load_particles(const ExhibitFiles& files) {
  if (files.particles.empty() && files.recorded_particles == nullptr) return nullptr;
  if (!files.sample.empty()) {
    return core::wrong_usage("particles rest on a level sample of their own: leave --sample out");
  }
  if (files.recorded_particles != nullptr) return files.recorded_particles;
  const auto path = scene::particle_file(files.particles, files.assets_dir);
  if (!path) return tl::unexpected(path.error());
  auto set = scene::load_particle_set(*path);
  if (!set) return tl::unexpected(set.error());
  if (set->ink && !(set->ink->surface_tension.si > 0.0)) {
    return core::wrong_usage(
        fmt::format("{}: a hand cannot write with this ink: add [tip], [lever] and a surface_tension, or play it with "
                    "touchafm particles",
                    *path));
  }
  return std::make_shared<const scene::ParticleSet>(std::move(*set));
}

// Fits the screen to the ratio at the same height. Nearly the same ratio keeps the screen unchanged.
void take_aspect(double aspect, scene::Screen& screen) {
  constexpr double kSame = 0.01;
  if (std::abs(aspect * screen.height_m() / screen.width_m() - 1.0) < kSame) return;
  const glm::dvec3 right = glm::normalize(screen.lower_right - screen.lower_left);
  const double more_m = 0.5 * (aspect * screen.height_m() - screen.width_m());
  screen.lower_left -= more_m * right;
  screen.upper_left -= more_m * right;
  screen.lower_right += more_m * right;
}

}  // namespace

std::string language_of_locale(std::span<const std::string> values) {
  const auto set = std::find_if(values.begin(), values.end(), [](const std::string& value) { return !value.empty(); });
  if (set != values.end()) {
    const std::string_view language = std::string_view(*set).substr(0, set->find_first_of("_.@-"));
    for (const LanguageRow& row : kLanguages) {
      if (row.word == language) return std::string(language);
    }
  }
  return std::string(kLanguages.front().word);
}

core::Result<LoadedPhrases> load_phrases(const ExhibitFiles& files) {
  const auto of_language = [&](std::string_view language) {
    return Phrases::load(fmt::format("{}/guidance/{}.toml", files.assets_dir, language));
  };
  auto english = of_language(kLanguages.front().word);
  if (!english) return tl::unexpected(english.error());
  auto wall = files.language == kLanguages.front().word ? english : of_language(files.language);
  if (wall && !files.guidance.empty()) wall = Phrases::load(files.guidance, *wall);
  if (!wall) return tl::unexpected(wall.error());
  return LoadedPhrases{std::move(*english), std::move(*wall)};
}

core::Result<Stage> load_exhibit(const ExhibitFiles& files) {
  auto phrases = load_phrases(files);
  if (!phrases) return tl::unexpected(phrases.error());
  auto pixel = load_force_map(files);
  if (!pixel) return tl::unexpected(pixel.error());
  ExhibitFiles with_pixel = files;
  if (*pixel) with_pixel.added.push_back(entry_of(**pixel));
  auto materials = shown_materials(with_pixel);
  if (!materials) return tl::unexpected(materials.error());
  auto wall = scene::load_wall(files.wall.empty() ? files.assets_dir + "/walls/powerwall.toml" : files.wall);
  if (!wall) return tl::unexpected(wall.error());
  for (const std::string& note : scene::notes_of(*wall)) {
    core::log_line(fmt::format("wall file {}: {}", std::filesystem::path(files.wall).filename().string(), note));
  }
  if (files.wall.empty() && files.aspect) take_aspect(*files.aspect, wall->screens.front());
  const StagePlace place = stage_place(*wall);
  const auto eyes = eyes_before(place.main, wall->viewers.front().sweet_spot, place.ipd_m);
  if (!eyes) return tl::unexpected(eyes.error());
  auto particles = load_particles(files);
  if (!particles) return tl::unexpected(particles.error());
  auto own = load_own_models(files.probe, files.sample, {{.channel = files.sample_channel}, files.sample_levelling});
  if (!own) return tl::unexpected(own.error());
  own->particles = *particles;
  own->force_volume = *pixel && (*pixel)->felt_map;
  // a map that is felt whole lies on its own heights
  if (*pixel && (*pixel)->felt_map && files.sample.empty()) {
    own->topography = topography_model((*pixel)->felt_map->heights);
  }
  auto wall_scene = WallScene::load(files.assets_dir, *materials, place, phrases->wall, *own);
  if (!wall_scene) return tl::unexpected(wall_scene.error());
  wall_scene->set_text_size(files.text_size);
  return Stage{std::move(*materials),       std::move(*wall), place.main,       *eyes, std::move(*wall_scene),
               std::move(phrases->english), *particles,       std::move(*pixel)};
}

core::Result<std::vector<curves::SampleModel>> felt_samples(const Stage& stage, physics::FrictionLaw friction,
                                                            const curves::TappedHand* tapping) {
  std::vector<curves::SampleModel> materials;
  // the paper's law has no friction: with friction, begins with the law of the adhesion map
  curves::ModelName law;
  law.automatic = friction != physics::FrictionLaw::None;
  for (const scene::MaterialEntry& entry : stage.materials.materials) {
    const bool is_pixel = stage.pixel && entry.name == stage.pixel->setup.material.name;
    const auto setup = tapping != nullptr && tapping->choice.mode == "tapping"
                           ? curves::tapped_setup(entry, *tapping)
                           : core::Result<curves::ContactSetup>(curves::ContactSetup{entry, {}, law, friction});
    if (!setup) return tl::unexpected(setup.error());
    auto model = is_pixel ? core::Result<curves::SampleModel>(*stage.pixel) : curves::make_sample_model(*setup);
    if (!model) return tl::unexpected(model.error());
    stage.wall_scene.lay_surface_on(model->parameters, materials.size());
    if (stage.wall_scene.topography().columns > 0) {
      core::log_line(smoothing_note(*model, stage.wall_scene.topography()));
    }
    materials.push_back(std::move(*model));
  }
  return materials;
}

bool is_model_file(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  return ending == ".glb" || ending == ".gltf";
}

}  // namespace afm::exhibit
