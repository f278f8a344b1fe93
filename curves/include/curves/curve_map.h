// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "curves/curve_file.h"
#include "curves/map_place.h"
#include "curves/measured_material.h"
#include "curves/recorded_curve.h"
#include "curves/sample_model.h"
#include "fits/elastic_fit.h"

namespace afm::curves {

// Fit of one pixel's curve, with the hardest pull found without it. Not a number: not known.
struct PixelFit {
  double modulus_pa = std::numeric_limits<double>::quiet_NaN();
  double adhesion_n = std::numeric_limits<double>::quiet_NaN();         // strongest pull of the retract, a magnitude
  double adhesion_j_per_m2 = std::numeric_limits<double>::quiet_NaN();  // W, from a fit to a law of adhesion
  std::optional<fits::Trust> trust;                                     // verdict on the fit; empty: no fit

  // Returns whether the fit is meaningful: its verdict is not "no".
  bool usable() const { return trust && *trust != fits::Trust::No; }
};

// A map of force curves in a file: the places of its curves, and the heights of its sample. Its curves stay in the
// file, which must not change. Const after loading; any thread but the servo's.
class CurveMap {
 public:
  // Gets the numbers of curves that were read and of all; returns whether to go on.
  using Progress = std::function<bool(std::size_t read, std::size_t count)>;

  // Fits one curve (curves/fitting/map_fit.h); called by several threads at a time.
  using Fit = std::function<PixelFit(const RecordedCurve& curve)>;

  // Reads every curve once, on all processors, and fits it with `fit`, if that is not empty; of two curves at one pixel
  // the later counts. `calibration` counts for all curves, also for those that are read later; its index does not.
  // BadInputFile as curve_count(), for a file without a grid, and if no curve of it can be read; Failed if `progress`
  // ends it.
  static core::Result<CurveMap> load(const std::string& path, const Progress& progress,
                                     const CurveReading& calibration = {}, const Fit& fit = {});

  const std::string& path() const { return path_; }
  const MapGrid& grid() const { return grid_; }

  // Number of pixels with a curve.
  std::size_t pixels_with_curve() const;

  // Height of the lever's base where each curve was pressed hardest, metres, row by row from the top; NaN: no curve.
  const std::vector<double>& heights_m() const { return heights_m_; }

  // The fits in the order of heights_m(); empty: none requested. A pixel without a curve has no fit.
  const std::vector<PixelFit>& fits() const { return fits_; }

  bool holds(const MapPlace& place) const { return place.column < grid_.columns && place.row < grid_.rows; }
  bool has_curve(const MapPlace& place) const { return holds(place) && indexes_[cell_of(place)] != kNoCurve; }

  // The pixel with a curve that is nearest to the middle.
  MapPlace middle() const;

  // The curve of a pixel, read from the file. WrongUsage outside the map; BadInputFile for a pixel without a curve, and
  // as load_measured_material().
  core::Result<MeasuredMaterial> material(const MapPlace& place, const scene::MaterialEntry& like) const;

 private:
  static constexpr std::uint32_t kNoCurve = 0xFFFFFFFFU;

  CurveMap() = default;
  std::size_t cell_of(const MapPlace& place) const {
    return (grid_.rows - 1 - place.row) * grid_.columns + place.column;
  }

  std::string path_;
  CurveReading calibration_;
  MapGrid grid_;
  std::vector<double> heights_m_;
  std::vector<PixelFit> fits_;
  std::vector<std::uint32_t> indexes_;  // number of each pixel's curve in the file, in the order of the heights
};

// The curve of a pixel, and its map.
struct MapCurve {
  std::shared_ptr<const CurveMap> map;
  MapPlace place;
  MeasuredMaterial measured;
};

// The pixel as a sample. Lever, tip and look are those of `like`, as of load_measured_material(). Errors as of
// CurveMap::material(), and as of make_sample_model().
core::Result<SampleModel> make_sample_model(const std::shared_ptr<const CurveMap>& map, const MapPlace& place,
                                            const scene::MaterialEntry& like);

// The curve of a sample's pixel for the servo; null without one.
std::shared_ptr<const scene::SharedMeasuredCurve> shared_curve(const SampleModel& material);

// "COLUMN,ROW", two whole numbers; empty for any other text.
std::optional<MapPlace> parse_map_place(std::string_view text);

// Text of a place: "3,1".
std::string text_of(const MapPlace& place);

}  // namespace afm::curves
