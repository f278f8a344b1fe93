// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/wall_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/enumerators.h"
#include "core/fnv1a.h"
#include "core/whole_file.h"
#include "curves/contact_setup.h"
#include "render/renderer.h"
#include "scene/samples/particle_files.h"

namespace afm::exhibit {

namespace {

using nlohmann::json;

constexpr std::size_t kMostNames = 64;

template <class Enum>
Enum enumerator_of(const json& value) {
  const auto number = value.get<std::uint32_t>();
  const auto known = static_cast<Enum>(number);
  if (!core::is_enumerator(known)) throw std::invalid_argument("an enumerator is unknown");
  return known;
}

// Path on the master's computer, never used as a folder on this one.
std::string checked_name(const json& value) {
  auto name = value.get<std::string>();
  if (name.size() > 4096 || name.find('\0') != std::string::npos) throw std::invalid_argument("a file name is invalid");
  return name;
}

std::map<std::string, std::string> meshes_of(const json& root) {
  auto meshes = root.get<std::map<std::string, std::string>>();
  const bool beside =
      std::all_of(meshes.begin(), meshes.end(), [](const auto& mesh) { return lies_beside(checked_name(mesh.first)); });
  if (!beside || meshes.size() > kMostNames) throw std::invalid_argument("the place of a warp mesh is invalid");
  return meshes;
}

// Settings of a lever in tapping mode as typed by its user; each sample checks if it can be felt.
curves::TappedHand tapping_of(const json& root) {
  curves::TappedHand hand;
  root.at("mode").get_to(hand.choice.mode);
  root.at("free_amplitude").get_to(hand.choice.numbers.free_amplitude);
  root.at("drive").get_to(hand.choice.numbers.drive);
  root.at("viscosity").get_to(hand.choice.numbers.viscosity);
  root.at("model").get_to(hand.model);
  for (auto& [option, text] : root.at("values").get<std::map<std::string, std::string>>()) {
    if (curves::find_contact_parameter(option) == nullptr)
      throw std::invalid_argument("a number of the lever is unknown");
    hand.values.emplace(option, text);
  }
  if (hand.choice.mode != "contact" && hand.choice.mode != "tapping")
    throw std::invalid_argument("its mode is unknown");
  return hand;
}

json json_of(const curves::TappedHand& hand) {
  return {{"mode", hand.choice.mode},
          {"free_amplitude", hand.choice.numbers.free_amplitude},
          {"drive", hand.choice.numbers.drive},
          {"viscosity", hand.choice.numbers.viscosity},
          {"model", hand.model},
          {"values", hand.values}};
}

WallModel model_of(const json& root) {
  WallModel model;
  root.at("build").get_to(model.build);
  root.at("scene").get_to(model.scene);
  root.at("wall").get_to(model.wall);
  root.at("guidance").get_to(model.guidance);
  root.at("materials").get_to(model.materials);
  model.meshes = meshes_of(root.at("meshes"));
  root.at("language").get_to(model.files.language);
  model.files.probe = checked_name(root.at("probe"));
  model.files.sample = checked_name(root.at("sample"));
  model.files.particles = checked_name(root.at("particles"));
  model.files.force_map = checked_name(root.at("force_map"));
  if (const auto pixel = root.at("pixel").get<std::vector<std::size_t>>(); pixel.size() == 2) {
    model.files.pixel = {pixel[0], pixel[1]};
  }
  root.at("sample_channel").get_to(model.files.sample_channel);
  model.files.sample_levelling = enumerator_of<physics::Levelling>(root.at("sample_levelling"));
  root.at("shown").get_to(model.files.shown);
  root.at("text_size").get_to(model.files.text_size);
  model.friction = enumerator_of<physics::FrictionLaw>(root.at("friction"));
  model.tapping = tapping_of(root.at("tapping"));
  const auto mode = root.at("stereo").get<std::string>();
  if (!mode.empty()) {
    const auto parsed = scene::parse_stereo_mode(mode);
    if (!parsed) throw std::invalid_argument(parsed.error().message);
    model.picture.mode = *parsed;
  }
  if (root.at("eyes_swapped").get<bool>()) model.picture.order = scene::EyeOrder::Swapped;
  if (root.at("high_contrast").get<bool>()) model.contrast = render::PanelContrast::High;
  const bool known = std::any_of(kLanguages.begin(), kLanguages.end(),
                                 [&](const LanguageRow& row) { return row.word == model.files.language; });
  const bool readable = model.files.text_size >= 1.0 && model.files.text_size <= kLargestText;
  if (!known || !readable || model.files.shown.size() > kMostNames || model.wall.empty()) {
    throw std::invalid_argument("its language, its text size, its samples or its wall are invalid");
  }
  return model;
}

core::Result<std::string> unpacked(const std::string& text, const std::string& path) {
  if (text.empty()) return std::string();
  if (auto written = core::write_file(path, text); !written) return tl::unexpected(written.error());
  return path;
}

core::Result<void> own_file_is_here(const std::string& file, const char* what) {
  std::error_code ignored;
  if (file.empty() || std::filesystem::is_regular_file(file, ignored)) return {};
  return core::failure(
      core::ErrorCategory::BadInputFile,
      fmt::format("the master shows the {} {}, which this machine lacks: copy it to the same place", what, file));
}

}  // namespace

bool lies_beside(const std::string& name) {
  const std::filesystem::path path(name);
  return path.has_filename() && path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

std::vector<std::byte> document_of(const WallModel& model) {
  std::vector<std::size_t> pixel;
  if (const auto& chosen = model.files.pixel) pixel = {chosen->front(), chosen->back()};
  const json root{{"build", model.build},
                  {"scene", model.scene},
                  {"wall", model.wall},
                  {"guidance", model.guidance},
                  {"materials", model.materials},
                  {"meshes", model.meshes},
                  {"language", model.files.language},
                  {"probe", model.files.probe},
                  {"sample", model.files.sample},
                  {"particles", model.files.particles},
                  {"force_map", model.files.force_map},
                  {"pixel", pixel},
                  {"sample_channel", model.files.sample_channel},
                  {"sample_levelling", static_cast<std::uint32_t>(model.files.sample_levelling)},
                  {"shown", model.files.shown},
                  {"text_size", model.files.text_size},
                  {"friction", static_cast<std::uint32_t>(model.friction)},
                  {"tapping", json_of(model.tapping)},
                  {"stereo", model.picture.mode ? std::string(scene::name_of(*model.picture.mode)) : std::string()},
                  {"eyes_swapped", model.picture.order == scene::EyeOrder::Swapped},
                  {"high_contrast", model.contrast == render::PanelContrast::High}};
  const std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

core::Result<WallModel> read_wall_model(std::span<const std::byte> document) {
  const std::string_view text(reinterpret_cast<const char*>(document.data()), document.size());
  try {
    return model_of(json::parse(text));
  } catch (const std::exception& why) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("the master's description of the wall is invalid: {}", why.what()));
  }
}

core::Result<ExhibitFiles> unpack(const WallModel& model, const std::string& assets_dir, const std::string& folder) {
  ExhibitFiles files = model.files;
  files.assets_dir = assets_dir;
  const std::string particles = scene::is_particle_path(files.particles) ? files.particles : "";
  for (const auto& [file, what] : {std::pair(files.probe, "probe"), std::pair(files.sample, "sample"),
                                   std::pair(particles, "particle file"), std::pair(files.force_map, "force map")}) {
    if (auto here = own_file_is_here(file, what); !here) return tl::unexpected(here.error());
  }
  const std::filesystem::path beside = std::filesystem::path(folder) / "wall";
  std::error_code failed;  // unused, since a file whose folder is missing is not written
  std::filesystem::create_directories(beside, failed);
  for (const auto& [name, text] : model.meshes) {
    std::filesystem::create_directories((beside / name).parent_path(), failed);
    if (auto written = core::write_file((beside / name).string(), text); !written) {
      return tl::unexpected(written.error());
    }
  }
  const auto put = [&](const std::string& text, const char* name, std::string& path) -> core::Result<void> {
    auto written = unpacked(text, fmt::format("{}/{}.toml", folder, name));
    if (!written) return tl::unexpected(written.error());
    path = std::move(*written);
    return {};
  };
  if (auto done = put(model.wall, "wall/wall", files.wall); !done) return tl::unexpected(done.error());
  if (auto done = put(model.guidance, "guidance", files.guidance); !done) return tl::unexpected(done.error());
  if (auto done = put(model.materials, "materials", files.materials); !done) return tl::unexpected(done.error());
  return files;
}

core::Result<std::uint64_t> build_digest(const std::string& program) {
  const auto bytes = core::read_file(program);
  if (!bytes) return tl::unexpected(bytes.error());
  return core::fnv1a(*bytes);
}

}  // namespace afm::exhibit
