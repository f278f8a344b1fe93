// SPDX-License-Identifier: Apache-2.0
#include "curves/curve_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

#include "curves/curve_file.h"
#include "curves/curve_series.h"

namespace afm::curves {

namespace {

constexpr unsigned kMostThreads = 8;

// Data kept of a curve.
struct Seen {
  std::optional<MapPixel> pixel;
  double lowest_m = std::numeric_limits<double>::quiet_NaN();
  PixelFit fit;
};

// All curves of a file, read by several threads.
class Survey {
 public:
  Survey(const std::string& path, std::size_t count, const CurveReading& calibration, const CurveMap::Fit& fit,
         const CurveMap::Progress& progress)
      : path_(path), calibration_(calibration), fit_(fit), progress_(progress), seen_(count) {}

  // Returns whether it was not ended.
  bool run() {
    const auto shares = static_cast<unsigned>(
        std::min<std::size_t>(std::clamp(std::thread::hardware_concurrency(), 1U, kMostThreads), seen_.size()));
    {
      std::vector<std::jthread> others;
      for (unsigned i = 1; i < shares; ++i) others.emplace_back([this, i, shares] { read({i, shares}); });
      read({0, shares});
    }
    return !ended_;
  }

  const std::vector<Seen>& seen() const { return seen_; }
  const std::string& why() const { return why_; }  // reason why the first unreadable curve cannot be read

 private:
  void read(const SeriesPart& part) {
    read_curves(path_, seen_.size(), part, calibration_,
                [&](std::size_t index, const core::Result<RecordedCurve>& curve) {
                  Seen now;
                  if (curve) {
                    now.pixel = curve->metadata.pixel;
                    const auto lower = [](const auto& a, const auto& b) { return a.z < b.z; };
                    now.lowest_m = std::min_element(curve->points.begin(), curve->points.end(), lower)->z.si;
                    if (fit_) now.fit = fit_(*curve);
                  }
                  const std::lock_guard lock(mutex_);
                  seen_[index] = now;
                  if (!curve && index < first_unread_) {
                    first_unread_ = index;
                    why_ = curve.error().message;
                  }
                  ended_ = ended_ || !progress_(++read_, seen_.size());
                  return !ended_;
                });
  }

  const std::string& path_;
  const CurveReading& calibration_;
  const CurveMap::Fit& fit_;
  const CurveMap::Progress& progress_;
  std::mutex mutex_;
  std::vector<Seen> seen_;
  std::string why_;
  std::size_t first_unread_ = std::numeric_limits<std::size_t>::max();
  std::size_t read_ = 0;
  bool ended_ = false;
};

tl::unexpected<core::Error> no_map(const std::string& path, const std::string& why) {
  return core::failure(core::ErrorCategory::BadInputFile, fmt::format("cannot use {} as a force map: {}", path, why));
}

}  // namespace

core::Result<CurveMap> CurveMap::load(const std::string& path, const Progress& progress,
                                      const CurveReading& calibration, const Fit& fit) {
  const auto count = curve_count(path, calibration);
  if (!count) return tl::unexpected(count.error());
  Survey survey(path, *count, calibration, fit, progress);
  if (!survey.run()) return core::failure(core::ErrorCategory::Failed, fmt::format("{}: interrupted", path));
  const std::vector<Seen>& seen = survey.seen();
  if (std::all_of(seen.begin(), seen.end(), [](const Seen& each) { return std::isnan(each.lowest_m); })) {
    if (*count == 1) return core::failure(core::ErrorCategory::BadInputFile, survey.why());
    return no_map(path, fmt::format("no curve of it can be read; the first: {}", survey.why()));
  }
  const auto first = std::find_if(seen.begin(), seen.end(), [](const Seen& each) { return each.pixel.has_value(); });
  if (*count == 1) return no_map(path, "it holds only one curve");
  if (first == seen.end()) return no_map(path, "its curves are not on a grid");
  CurveMap map;
  map.path_ = path;
  map.calibration_ = calibration;
  map.grid_ = first->pixel->grid;
  if (!is_map_of(seen.size(), map.grid_)) {
    return no_map(path, fmt::format("it has {} curves on a grid of {} x {} pixels", seen.size(), map.grid_.columns,
                                    map.grid_.rows));
  }
  map.heights_m_.assign(map.grid_.columns * map.grid_.rows, std::numeric_limits<double>::quiet_NaN());
  map.indexes_.assign(map.heights_m_.size(), kNoCurve);
  if (fit) map.fits_.resize(map.heights_m_.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i].pixel || !(seen[i].pixel->grid == map.grid_)) continue;
    const std::size_t cell = map.cell_of({seen[i].pixel->column, seen[i].pixel->row});
    map.heights_m_[cell] = seen[i].lowest_m;
    map.indexes_[cell] = static_cast<std::uint32_t>(i);
    if (fit) map.fits_[cell] = seen[i].fit;
  }
  return map;
}

std::size_t CurveMap::pixels_with_curve() const {
  return indexes_.size() - static_cast<std::size_t>(std::count(indexes_.begin(), indexes_.end(), kNoCurve));
}

MapPlace CurveMap::middle() const {
  const auto middle = [](std::size_t count) {
    const std::size_t half = count / 2;
    return static_cast<double>(half);
  };
  MapPlace nearest;
  double least = std::numeric_limits<double>::infinity();
  for (MapPlace place; place.row < grid_.rows; ++place.row) {
    for (place.column = 0; place.column < grid_.columns; ++place.column) {
      const double away = std::hypot(static_cast<double>(place.column) - middle(grid_.columns),
                                     static_cast<double>(place.row) - middle(grid_.rows));
      if (!has_curve(place) || away >= least) continue;
      least = away;
      nearest = place;
    }
  }
  return nearest;
}

core::Result<MeasuredMaterial> CurveMap::material(const MapPlace& place, const scene::MaterialEntry& like) const {
  if (!holds(place)) {
    return core::wrong_usage(
        fmt::format("pixel {} is outside the force map {}: its columns are 0 to {}, its rows 0 to {}", text_of(place),
                    path_, grid_.columns - 1, grid_.rows - 1));
  }
  if (!has_curve(place)) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("the force map {} has no curve at pixel {}", path_, text_of(place)));
  }
  const auto at_pixel = [&](const core::Error& error) {
    return core::failure(error.category, fmt::format("pixel {}: {}", text_of(place), error.message));
  };
  CurveReading reading = calibration_;
  reading.index = indexes_[cell_of(place)];
  const auto recorded = load_curve(path_, reading);
  if (!recorded) return at_pixel(recorded.error());
  const auto& pixel = recorded->metadata.pixel;
  if (!pixel || !(pixel->grid == grid_) || pixel->column != place.column || pixel->row != place.row) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("the force map {} was changed: start again", path_));
  }
  auto measured = measured_material(*recorded, path_, like);
  if (!measured) return at_pixel(measured.error());
  measured->curve.column = static_cast<std::int32_t>(place.column);
  measured->curve.row = static_cast<std::int32_t>(place.row);
  measured->entry.title = fmt::format("{} ({})", title_of(path_), text_of(place));
  return measured;
}

core::Result<SampleModel> make_sample_model(const std::shared_ptr<const CurveMap>& map, const MapPlace& place,
                                            const scene::MaterialEntry& like) {
  auto measured = map->material(place, like);
  if (!measured) return tl::unexpected(measured.error());
  auto pixel = std::make_shared<const MapCurve>(MapCurve{map, place, std::move(*measured)});
  auto model = make_sample_model(pixel->measured.entry, std::span(&pixel->measured.curve, 1), 0);
  if (!model) return model;
  model->pixel = std::move(pixel);
  return model;
}

std::shared_ptr<const scene::SharedMeasuredCurve> shared_curve(const SampleModel& material) {
  if (!material.pixel) return nullptr;
  return {material.pixel, &material.pixel->measured.curve};
}

std::optional<MapPlace> parse_map_place(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto number = [](std::string_view digits) -> std::optional<std::size_t> {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && end == digits.data() + digits.size() ? std::optional(value) : std::nullopt;
  };
  const auto column = number(text.substr(0, comma)), row = number(text.substr(comma + 1));
  if (!column || !row) return std::nullopt;
  return MapPlace{*column, *row};
}

std::string text_of(const MapPlace& place) { return fmt::format("{},{}", place.column, place.row); }

}  // namespace afm::curves
