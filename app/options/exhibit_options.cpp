// SPDX-License-Identifier: Apache-2.0
#include "app/options/exhibit_options.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/options/enum_option.h"
#include "app/options/levelling_option.h"
#include "app/options/quantity_option.h"
#include "curves/curve_map.h"
#include "curves/fitting/map_fit.h"
#include "curves/image_file.h"
#include "scene/shared/map_vibration.h"
#include "scene/shared/particle_blocks.h"

namespace afm::app {

namespace {

constexpr QuantityRange<physics::Length> kEyeDistances{physics::Length(scene::kSmallestIpdM),
                                                       physics::Length(scene::kLargestIpdM)};

}  // namespace

void add_stereo_options(OptionList& command, exhibit::PictureOptions& options, const std::string& default_mode) {
  enum_option(command, "--stereo", options.mode, "a stereo mode", scene::kStereoModes, &scene::StereoModeTraits::name,
              &scene::StereoModeTraits::mode, "stereo mode; default: " + default_mode);
  command.add_flag(
      "--swap-eyes", [&options] { options.order = scene::EyeOrder::Swapped; }, "swap the left and right eyes");
  quantity_option(
      command, "--ipd", [&options](physics::Length distance) { options.ipd_m = distance.si; }, physics::kLengthUnits,
      "distance between the eyes; default: that of the viewer in the wall file", std::optional(kEyeDistances));
}

Option add_gpu_option(OptionList& command, std::string& gpu) {
  const auto read = [&gpu](const std::string& text) -> core::Result<void> {
    if (text.empty()) return core::wrong_usage("give the name of a device, or leave --gpu out for the best");
    gpu = text;
    return {};
  };
  return command
      .add_parsed_option("--gpu", read,
                         "graphics device that draws: its name as touchafm devices prints it, or a part that no other "
                         "has; default: the best, a GPU rather than the processor")
      .type_name("NAME");
}

void add_own_model_options(OptionList& command, exhibit::ExhibitFiles& files, scene::LevelChoice* particles) {
  command
      .add_option("--probe", files.probe,
                  "glTF model of your own cantilever, with nodes for the roles base and tip (see docs/gltf.md)")
      .type_name("FILE");
  add_own_sample_option(command, files, particles);
}

void add_own_sample_option(OptionList& command, exhibit::ExhibitFiles& files, scene::LevelChoice* particles) {
  command
      .add_option("--sample", files.sample,
                  fmt::format("your own sample, drawn and felt: a glTF model with a node for the role surface, or a "
                              "measured image ({}); the file's first bytes decide",
                              curves::kImageFiles))
      .type_name("FILE");
  const auto [channel, level] =
      add_channel_options(command, files.sample_channel, files.sample_levelling, "--channel", particles);
  if (particles == nullptr) return;
  command.add_option("--seed", particles->seed, "with --level 2: choice of the drift's direction and of the scatter")
      .type_name("NUMBER")
      .within(1, static_cast<int>(scene::kLargestSeed))
      .needs(level)
      .show_default();
}

void add_particles_option(OptionList& command, exhibit::ExhibitFiles& files) {
  command
      .add_option(
          "--particles", files.particles,
          "particles to push with the tip, or a sample to scratch or to write on with ink: a particle file (TOML), or "
          "the name of a built-in set, such as gold-row; the scale is then particles unless --scale chooses another")
      .type_name("FILE");
}

namespace {

struct FeltPart {
  std::string_view name;
  bool whole;
};
constexpr std::array kFeltParts{FeltPart{"pixel", false}, FeltPart{"map", true}};

}  // namespace

std::vector<NamedOption> add_force_map_options(OptionList& command, exhibit::ExhibitFiles& files) {
  const Option map =
      command
          .add_option(
              "--force-map", files.force_map,
              "map of force curves from an instrument (.jpk-force-map, .jpk-qi-data, a Nanoscope force volume, "
              ".nid, .nhf, .ardf or .h5), felt pixel by pixel: the panel shows its picture, and the curve of the "
              "chosen pixel is the force law")
          .type_name("FILE");
  const auto read = [&files](const std::string& text) -> core::Result<void> {
    const auto place = curves::parse_map_place(text);
    if (!place) {
      return core::wrong_usage(fmt::format("\"{}\" is not COLUMN,ROW, two whole numbers such as 12,3", text));
    }
    files.pixel = {place->column, place->row};
    return {};
  };
  command
      .add_parsed_option(
          "--pixel", read,
          "pixel of the force map to feel first, counted from 0 at the left and at the bottom, as touchafm "
          "analyse prints it; default: the middle")
      .needs(map)
      .type_name("COLUMN,ROW");
  const Option felt = enum_option(command, "--felt", files.whole_map, "a part of the map", kFeltParts, &FeltPart::name,
                                  &FeltPart::whole,
                                  "what is felt of the force map: pixel, the curve of one pixel, or map, the whole map "
                                  "by the modulus and the adhesion of its fits; default: pixel");
  const Option viscous = command.add_flag(
      "--viscous-map", files.viscous_map,
      "with --felt map: damp the hand near the sample, the more the more energy a cycle loses at the place");
  const Option vibration =
      enum_option(command, "--map-vibration", files.map_vibration, "a quantity that vibrates", scene::kMapVibrations,
                  &scene::MapVibrationText::word, &scene::MapVibrationText::quantity,
                  "with --felt map: a quantity of the map that a moving hand feels as a vibration of at most 0.1 N "
                  "near the sample: "
                  "modulus, adhesion, loss (the energy that a cycle loses), or collision (each touch); default: none");
  const Option equal_force = quantity_option(
      command, "--equal-force", [&files](physics::Force force) { files.equal_force_n = force.si; },
      physics::kForceUnits,
      "with --felt map: show the surface on which the curves have this force, a push on the approach, or a negative "
      "pull on the retract; F10 shows and hides it");
  const auto reading = std::make_shared<curves::MapReading>();
  files.map_reading = reading;
  std::vector<NamedOption> own{add_sensitivity_option(command, reading->calibration)};
  std::vector<NamedOption> of_fit = add_shape_options(
      command, reading->fit,
      "fit every curve of the force map, and show the modulus on the panel; F4 shows the heights and the adhesion:");
  own.insert(own.end(), of_fit.begin(), of_fit.end());
  const std::array whole{NamedOption{felt, "--felt"}, NamedOption{equal_force, "--equal-force"},
                         NamedOption{viscous, "--viscous-map"}, NamedOption{vibration, "--map-vibration"}};
  own.insert(own.end(), whole.begin(), whole.end());
  for (NamedOption& each : own) each.option.needs(map);
  return own;
}

core::Result<void> set_map_spring_constant(const std::string& text, exhibit::ExhibitFiles& files) {
  const auto lever = parse_spring_constant(text);
  if (!lever) return tl::unexpected(lever.error());
  auto reading = std::make_shared<curves::MapReading>(files.map_reading ? *files.map_reading : curves::MapReading{});
  reading->calibration.spring_constant = *lever;
  files.map_reading = std::move(reading);
  return {};
}

void add_scale_option(OptionList& command, std::optional<scene::ScaleMode>& mode) {
  std::string meanings;
  for (const scene::ScaleModeText& row : scene::kScalesOfSamples) {
    meanings += fmt::format("{}{} ({})", meanings.empty() ? "" : ", ", row.word, row.meaning);
  }
  enum_option(command, "--scale", mode, "a scale of the hand", scene::kScalesOfSamples, &scene::ScaleModeText::word,
              &scene::ScaleModeText::mode,
              fmt::format("scaling of nm and nN to mm and N in the hand: {}; default: {}", meanings,
                          scene::text_of(scene::ScaleMode::Fit).word));
}

void add_friction_option(OptionList& command, physics::FrictionLaw& friction) {
  std::string meanings;
  for (const physics::FrictionLawText& row : physics::kFrictionLaws) {
    meanings += fmt::format("{}{} ({})", meanings.empty() ? "" : ", ", row.word, row.meaning);
  }
  enum_option(command, "--friction", friction, "a friction", physics::kFrictionLaws, &physics::FrictionLawText::word,
              &physics::FrictionLawText::law,
              fmt::format("friction model: {}; default: {}", meanings, physics::text_of(friction).word));
}

void add_phrase_options(OptionList& command, exhibit::ExhibitFiles& files, const CommandContext& context) {
  files.assets_dir = context.assets_dir;
  files.language = context.language;
  enum_option(command, "--language", files.language, "a language", exhibit::kLanguages, &exhibit::LanguageRow::word,
              &exhibit::LanguageRow::word,
              "language of wall and report; default: that of the locale (LC_ALL, LC_MESSAGES or LANG), else en");
  command
      .add_option(
          "--guidance", files.guidance,
          fmt::format("your own phrase file (TOML), such as a part of {}/guidance/en.toml in your words; --language "
                      "supplies the phrases that it lacks",
                      context.assets_dir))
      .type_name("FILE");
  command.add_option("--assets", files.assets_dir, "folder of models, walls, materials and languages").type_name("DIR");
}

Option add_wall_option(OptionList& command, exhibit::ExhibitFiles& files) {
  return command
      .add_option("--wall", files.wall,
                  "wall file (TOML): the corners of the screens and the position of the viewer; or the name of an "
                  "included one, such as cave; default: the paper's wall, 10 ft x 7.5 ft")
      .or_included_in(files.assets_dir + "/walls")
      .type_name("FILE");
}

void add_stage_options(OptionList& command, exhibit::ExhibitFiles& files, const CommandContext& context) {
  add_phrase_options(command, files, context);
  add_wall_option(command, files);
  command
      .add_option("--materials", files.materials,
                  "material file (TOML), shown instead of the paper's mica, gold and silicon nitride")
      .type_name("FILE");
}

}  // namespace afm::app
