// SPDX-License-Identifier: Apache-2.0
#include "app/options/exhibit_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "physics/quantity_text.h"

namespace afm::app {

namespace {

std::string stereo_mode_list() {
  std::string names;
  for (const scene::StereoModeTraits& entry : scene::kStereoModes) {
    names += names.empty() ? std::string(entry.name) : ", " + std::string(entry.name);
  }
  return names;
}

}  // namespace

void add_stereo_options(CLI::App& command, exhibit::PictureOptions& options, const std::string& default_mode) {
  command
      .add_option_function<std::string>(
          "--stereo",
          [&options](const std::string& name) {
            const auto mode = scene::parse_stereo_mode(name);
            if (!mode) throw CLI::ValidationError("--stereo", mode.error().message);
            options.mode = *mode;
          },
          fmt::format("how both eyes are shown: {}; default: {}", stereo_mode_list(), default_mode))
      ->type_name("MODE");
  command.add_flag_callback(
      "--swap-eyes", [&options] { options.order = scene::EyeOrder::Swapped; }, "left and right exchanged");
  command
      .add_option_function<std::string>(
          "--ipd",
          [&options](const std::string& text) {
            const auto parsed = physics::parse_quantity(text, physics::kLengthUnits);
            if (!parsed.value) throw CLI::ValidationError("--ipd", parsed.error);
            const double ipd_m = parsed.value->si;
            if (!(ipd_m >= scene::kSmallestIpdM && ipd_m <= scene::kLargestIpdM)) {
              throw CLI::ValidationError("--ipd", fmt::format("{:g} mm is not between {:g} mm and {:g} mm", ipd_m * 1e3,
                                                              scene::kSmallestIpdM * 1e3, scene::kLargestIpdM * 1e3));
            }
            options.ipd_m = ipd_m;
          },
          "distance between the eyes, 30mm to 90mm; default: the viewer's in the wall file")
      ->type_name("LENGTH");
}

void add_own_model_options(CLI::App& command, exhibit::ExhibitFiles& files) {
  command
      .add_option("--probe", files.probe,
                  "glTF model of your own cantilever, with nodes for the roles base and tip (docs/gltf.md)")
      ->type_name("FILE");
  add_own_sample_option(command, files);
}

void add_own_sample_option(CLI::App& command, exhibit::ExhibitFiles& files) {
  command
      .add_option("--sample", files.sample,
                  "glTF model of your own sample, with a node for the role surface; it is felt as it is drawn")
      ->type_name("FILE");
}

void add_stage_options(CLI::App& command, exhibit::ExhibitFiles& files, const CommandContext& context) {
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
