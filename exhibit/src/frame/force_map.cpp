// SPDX-License-Identifier: Apache-2.0
#include "frame/force_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "core/interruption.h"
#include "core/log.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/fitting/map_fit.h"
#include "curves/force_volume.h"
#include "curves/measured_material.h"
#include "scene/shared/map_vibration.h"

namespace afm::exhibit {

namespace {

// Logs one line per second about the curves read; ends after an interruption.
curves::CurveMap::Progress progress_of(const std::string& file) {
  return [file, told = std::chrono::steady_clock::now()](std::size_t read, std::size_t count) mutable {
    const auto now = std::chrono::steady_clock::now();
    if (now - told >= std::chrono::seconds(1)) {
      told = now;
      core::log_line(fmt::format("force map {}: {} of {} curves, {} %", file, read, count, 100 * read / count));
    }
    return !core::interrupted();
  };
}

// Checks options that need others, or exclude them.
core::Result<void> check_options(const ExhibitFiles& files) {
  if (!files.particles.empty())
    return core::wrong_usage("--force-map: its law is no particle's: leave --particles out");
  if (files.whole_map && !(files.map_reading && files.map_reading->fit.shape))
    return core::wrong_usage("--felt map: the map is felt by its fits: add --fit SHAPE");
  if (!files.whole_map && files.viscous_map)
    return core::wrong_usage("--viscous-map: only a map that is felt whole is viscous: add --felt map");
  if (!files.whole_map && files.map_vibration != scene::MapVibration::None)
    return core::wrong_usage("--map-vibration: only a map that is felt whole vibrates: add --felt map");
  if (!files.whole_map && files.equal_force_n)
    return core::wrong_usage("--equal-force: the surface lies over a map that is felt whole: add --felt map");
  if (files.equal_force_n == 0.0)
    return core::wrong_usage("--equal-force: a surface of no force is everywhere: give a push, such as 1nN, or a pull");
  return {};
}

// Smallest and largest value of the map.
std::ranges::minmax_result<float> ends_of(const scene::SharedLawMap& map, std::span<const float> values) {
  return std::ranges::minmax(values.first(std::size_t{map.columns} * map.rows));
}

// Smallest ratio of the map's values. Below it the map has one value and noise, which would be felt at full range.
constexpr float kLeastRatio = 1.05F;

// Reason why the quantity cannot vibrate on this map; empty if it can be felt somewhere.
std::string why_nothing_vibrates(const curves::SampleModel& whole, scene::MapVibration quantity) {
  const scene::SharedLawMap& map = whole.felt_map->laws;
  switch (quantity) {
    case scene::MapVibration::None:
    case scene::MapVibration::Collision:
      break;
    case scene::MapVibration::Modulus:
      if (const auto ends = ends_of(map, map.ln_modulus); ends.max - ends.min < std::log(kLeastRatio))
        return "the modulus of this map differs by less than 5 %; choose another, or leave it out";
      break;
    case scene::MapVibration::Adhesion:
      if (whole.felt_map->law == physics::Law::Hertz)
        return "the tip hardly sticks to this map; choose another, or leave it out";
      if (const auto ends = ends_of(map, map.adhesion_j_per_m2); ends.max < kLeastRatio * ends.min)
        return "the adhesion of this map differs by less than 5 %; choose another, or leave it out";
      break;
    case scene::MapVibration::Loss:
      if (!whole.figures().hysteretic) return "a cycle on this map loses no energy; choose another, or leave it out";
      break;
  }
  return {};
}

// Sample of this pixel's whole map.
core::Result<std::shared_ptr<const curves::SampleModel>> felt_whole(const curves::SampleModel& pixel,
                                                                    const ExhibitFiles& files,
                                                                    const curves::FitOptions& fit,
                                                                    curves::ForceVolume::Gatherer& gatherer) {
  auto whole = curves::make_sample_model(pixel, fit, std::make_shared<const curves::ForceVolume>(gatherer.finish()));
  if (!whole) return tl::unexpected(whole.error());
  if (files.viscous_map && !whole->figures().hysteretic) {
    return core::wrong_usage(
        "--viscous-map: a cycle on this map loses no energy that could damp the hand; leave it out");
  }
  whole->parameters.viscous_map = files.viscous_map ? 1 : 0;
  if (const std::string flat = why_nothing_vibrates(*whole, files.map_vibration); !flat.empty())
    return core::wrong_usage(fmt::format("--map-vibration {}: {}", scene::text_of(files.map_vibration).word, flat));
  whole->parameters.map_vibration = files.map_vibration;
  if (files.map_vibration != scene::MapVibration::None) {
    core::log_line(fmt::format("force map {}: a hand that moves near the sample feels {} as a vibration",
                               files.force_map, scene::text_of(files.map_vibration).name));
  }
  core::log_line(
      fmt::format("force map {}: the whole map is felt: {}", files.force_map, curves::felt_text(*whole->felt_map)));
  return std::make_shared<const curves::SampleModel>(std::move(*whole));
}

}  // namespace

core::Result<std::shared_ptr<const curves::SampleModel>> load_force_map(const ExhibitFiles& files) {
  if (files.force_map.empty()) return nullptr;
  if (auto checked = check_options(files); !checked) return tl::unexpected(checked.error());
  const auto library = scene::load_materials(files.assets_dir + "/materials.toml");
  if (!library) return tl::unexpected(library.error());
  curves::MapReading reading = files.map_reading ? *files.map_reading : curves::MapReading{};
  if (auto prepared = curves::prepare(reading.fit); !prepared) return tl::unexpected(prepared.error());
  const auto fit = reading.fit.shape ? curves::fit_of_each(files.force_map, reading.fit) : curves::CurveMap::Fit{};
  // a map that is felt as a whole is also seen as a whole
  const auto gatherer = files.whole_map ? std::make_shared<curves::ForceVolume::Gatherer>() : nullptr;
  curves::CurveMap::Fit each = fit;
  if (gatherer) {
    each = [gatherer, fit](const curves::RecordedCurve& curve) {
      gatherer->add(curve);
      return fit(curve);
    };
  }
  auto read = curves::CurveMap::load(files.force_map, progress_of(files.force_map), reading.calibration, each);
  if (!read) return tl::unexpected(read.error());
  const auto map = std::make_shared<const curves::CurveMap>(std::move(*read));
  const curves::MapPlace place = files.pixel ? curves::MapPlace{(*files.pixel)[0], (*files.pixel)[1]} : map->middle();
  auto model = curves::make_sample_model(map, place, library->materials.front());
  if (!model && !files.pixel) {
    return core::failure(model.error().category, model.error().message + "; choose another with --pixel");
  }
  if (!model) return tl::unexpected(model.error());
  const std::size_t pixels = map->heights_m().size();
  const std::string missing = map->pixels_with_curve() < pixels
                                  ? fmt::format(", {} without a curve", pixels - map->pixels_with_curve())
                                  : std::string();
  core::log_line(
      fmt::format("force map {}: {} x {} pixels{}; felt first: {}{}", files.force_map, map->grid().columns,
                  map->grid().rows, missing, curves::text_of(model->pixel->place),
                  model->pixel->measured.features.contact_doubtful ? ", whose contact point is doubtful" : ""));
  if (fit) core::log_line(fmt::format("force map {}: {}", files.force_map, curves::fits_text(*map)));
  if (!files.whole_map) return std::make_shared<const curves::SampleModel>(std::move(*model));
  return felt_whole(*model, files, reading.fit, *gatherer);
}

scene::MaterialEntry entry_of(const curves::SampleModel& pixel) {
  scene::MaterialEntry entry = pixel.setup.material;
  entry.title = curves::title_of(pixel.pixel->map->path());
  return entry;
}

}  // namespace afm::exhibit
