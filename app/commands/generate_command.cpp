// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/scan_command.h"
#include "app/options/command.h"
#include "app/options/enum_option.h"
#include "app/options/pixel_size_option.h"
#include "app/options/quantity_option.h"
#include "core/file_names.h"
#include "core/output_folder.h"
#include "curves/curve_file.h"
#include "curves/curve_series.h"
#include "curves/synthetic_curve.h"
#include "physics/quantity_text.h"

namespace afm::app {
namespace {

using core::wrong_usage;

// Options of `touchafm generate curve` and `map`.
struct GenerateOptions {
  curves::SyntheticSetup setup;
  std::vector<curves::GivenNumber> given;
  std::size_t count = 1;
  std::optional<glm::uvec2> pixels;
  double size_m = curves::kUsualMapWidthM;
  curves::SyntheticMap map;
  std::string out;
};

struct NamedBytes {
  std::string ending;  // text after the name of the file
  std::string bytes;
};

// FILE and the files that belong to it, all or none. Opened before the work, so that a folder that is not writable ends
// it at once.
class Together {
 public:
  static core::Result<Together> open(const std::string& file) {
    const std::filesystem::path path(file);
    auto folder = core::OutputFolder::open(path.has_parent_path() ? path.parent_path().string() : ".");
    if (!folder) return tl::unexpected(folder.error());
    return Together(path.filename().string(), std::move(*folder));
  }

  core::Result<void> write(const std::vector<NamedBytes>& parts) {
    for (const NamedBytes& part : parts) {
      if (const auto written = folder_.write(name_ + part.ending, part.bytes); !written) return written;
    }
    return folder_.commit_new();
  }

 private:
  Together(std::string name, core::OutputFolder folder) : name_(std::move(name)), folder_(std::move(folder)) {}

  std::string name_;
  core::OutputFolder folder_;
};

core::Result<curves::CurveFormat> curve_format_of(const std::string& file) {
  if (const auto format = curves::writable_format_of(file)) return format->format;
  return wrong_usage(fmt::format("--out {}: name a file that ends in .h5, .tab or, for AFM Workshop's, .csv", file));
}

core::Result<void> generate_curves(const GenerateOptions& options, bool is_map) {
  curves::SyntheticSetup setup(options.setup);
  if (const auto applied = curves::apply(options.given, setup); !applied) return applied;
  const auto format = curve_format_of(options.out);
  if (!format) return tl::unexpected(format.error());
  curves::SyntheticMap map(options.map);
  if (is_map) {
    const glm::uvec2 pixels = options.pixels.value_or(glm::uvec2(curves::kUsualMapPixels));
    map.grid = curves::map_grid(pixels.x, pixels.y, options.size_m);
  }
  auto files = Together::open(options.out);
  if (!files) return tl::unexpected(files.error());
  const auto made = is_map ? curves::synthetic_map(setup, map) : curves::synthetic_curves(setup, options.count);
  if (!made) return tl::unexpected(made.error());
  auto bytes = curves::series_bytes(*format, made->curves);
  if (!bytes) return tl::unexpected(bytes.error());
  return files->write({{"", std::move(*bytes)}, {".truth.json", made->truth}});
}

core::Result<void> generate_image(const ScanOptions& options) {
  if (!core::has_ending(options.out, ".gwy")) {
    return wrong_usage(fmt::format("--out {}: name a file that ends in .gwy", options.out));
  }
  auto files = Together::open(options.out);
  if (!files) return tl::unexpected(files.error());
  auto scan = scan_with_truth(options);
  if (!scan) return tl::unexpected(scan.error());
  return files->write({{"", std::move(scan->image)},
                       {".truth.gwy", std::move(scan->true_image)},
                       {".truth.json", std::move(scan->truth)}});
}

void add_out(OptionList& command, std::string& out, const std::string& files) {
  command.add_option("--out", out, fmt::format("write {}; the truth goes to FILE.truth.json", files))
      .required()
      .writable_file()
      .type_name("FILE");
}

// Laws with which a curve can be made: all but `auto`, which chooses one for a measured curve.
const std::vector<fits::ShapeRow>& laws_of_curves() {
  static const std::vector<fits::ShapeRow> laws = [] {
    std::vector<fits::ShapeRow> named(fits::kShapes.begin(), fits::kShapes.end());
    std::erase_if(named, [](const fits::ShapeRow& row) { return row.shape == fits::Shape::Auto; });
    return named;
  }();
  return laws;
}

void add_setup_options(OptionList& command, GenerateOptions& options) {
  std::string laws;
  for (const fits::ShapeRow& row : laws_of_curves()) laws += fmt::format("\n  {}: {}", row.name, row.meaning);
  enum_option(command, "--law", options.setup.shape, "a law of force", laws_of_curves(), &fits::ShapeRow::name,
              &fits::ShapeRow::shape, "law of the contact, as after --fit of touchafm analyse:" + laws);
  for (const curves::SyntheticField& field : curves::kSyntheticFields) {
    si_option(
        command, "--" + std::string(field.option),
        [&options, &field](double si) { options.given.push_back({&field, si}); },
        {field.units->sort, field.units->units, QuantityRange<double>{field.smallest, field.largest}},
        std::string(field.help));
  }
  enum_option(command, "--base", options.setup.base, "a base", fits::kBases, &fits::BaseName::name,
              &fits::BaseName::base, "with --law layer-exact-...: contact of layer and base; default: bonded");
  command.add_option("--points", options.setup.points, "points of each branch")
      .within(static_cast<int>(curves::kFewestSyntheticPoints), 500'000)
      .show_default()
      .type_name("NUMBER");
  command.add_option("--seed", options.setup.seed, "seed of noise and places; the same seed gives the same bytes")
      .show_default()
      .type_name("NUMBER");
}

template <class Q>
QuantityRange<Q> typed(const curves::QuantityRange<double>& range) {
  return {Q(range.least), Q(range.most)};
}

void add_map_options(OptionList& command, GenerateOptions& options) {
  pixel_size_option(command, "--pixels", options.pixels, "curves in x and y; default: 16x16",
                    PixelRange{1, curves::kMostMapPixels});
  quantity_option(
      command, "--size", [&options](physics::Length size) { options.size_m = size.si; }, physics::kLengthUnits,
      "width of the map; its pixels are squares; default: 10um",
      std::optional(typed<physics::Length>(curves::kMapWidthsM)));
  std::string shapes;
  for (const curves::FieldShapeRow& row : curves::kFieldShapes)
    shapes += fmt::format("\n  {}: {}", row.name, row.meaning);
  enum_option(command, "--field", options.map.shape, "a field", curves::kFieldShapes, &curves::FieldShapeRow::name,
              &curves::FieldShapeRow::shape, "variation of the sample over the map; default: uniform" + shapes);
  quantity_option(
      command, "--second-modulus",
      [&options](physics::Pressure modulus) { options.map.second_modulus_pa = modulus.si; }, physics::kPressureUnits,
      "second modulus of --field", std::optional(typed<physics::Pressure>(curves::kMapModuliPa)));
  quantity_option(
      command, "--second-work-of-adhesion",
      [&options](physics::SurfaceEnergy work) { options.map.second_work_j_per_m2 = work.si; },
      physics::kSurfaceEnergyUnits, "second work of adhesion of --field, of dmt, jkr and maugis",
      std::optional(typed<physics::SurfaceEnergy>(curves::kMapWorksJPerM2)));
}

}  // namespace

void add_generate_command(OptionList& program, const CommandContext& context) {
  OptionList generate =
      program.add_command("generate", "write curves, maps and images whose truth is known, each with its truth");
  generate.footer(
      "Either both FILE and FILE.truth.json are written, or neither; no file is replaced.\n"
      "example: touchafm generate curve --radius 5um --modulus 3kPa --spring-constant 0.05N/m --most-force 1nN "
      "--noise 15pN --out gel.h5");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto curve_options = std::make_shared<GenerateOptions>(), map_options = std::make_shared<GenerateOptions>();
  const auto image_options = std::make_shared<ScanOptions>();

  OptionList curve = generate.add_command("curve", "curves as an instrument records them, with noise, tilt and drift");
  add_setup_options(curve, *curve_options);
  curve.add_option("--count", curve_options->count, "curves in the file, which differ in their noise; several in .h5")
      .within(1, 20'000)
      .show_default()
      .type_name("NUMBER");
  add_out(curve, curve_options->out, "the curves to FILE: .h5 or .tab of afmformats, or AFM Workshop's .csv");
  curve.footer(
      "example: touchafm generate curve --law jkr --radius 1um --modulus 1MPa --work-of-adhesion 20mJ/m2 "
      "--spring-constant 1N/m --most-force 200nN --noise 300pN --out sticky.tab");
  curve.when_chosen([curve_options] { return generate_curves(*curve_options, false); });

  OptionList map = generate.add_command("map", "a map of curves over a sample that differs from place to place");
  add_setup_options(map, *map_options);
  add_map_options(map, *map_options);
  add_out(map, map_options->out, "the map to FILE, .h5 of afmformats");
  map.footer(
      "example: touchafm generate map --pixels 16x16 --field islands --modulus 2kPa --second-modulus 20kPa "
      "--radius 5um --spring-constant 0.05N/m --most-force 1nN --noise 15pN --points 300 --out cells.h5");
  map.when_chosen([map_options] { return generate_curves(*map_options, true); });

  OptionList image = generate.add_command("image", "an image of touchafm scan, with the surface without artefacts");
  const Option tip = add_scan_options(image, *image_options, context);
  add_out(image, image_options->out, "the image to FILE.gwy, the surface to FILE.gwy.truth.gwy");
  image.footer("example: touchafm generate image --material mica --size 40nm --pixels 64 --rate 20Hz --out mica.gwy");
  image.when_chosen([image_options, tip] {
    complete(*image_options, tip.given());
    return generate_image(*image_options);
  });
}

}  // namespace afm::app
