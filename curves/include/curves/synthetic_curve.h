// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumerators.h"
#include "core/result.h"
#include "curves/quantity_domain.h"
#include "curves/recorded_curve.h"
#include "curves/synthetic_setup.h"

// Curves as an instrument would record them, whose truth is known (docs/generate.md). The same set-up gives the same
// bytes on every machine with the same mathematical library. Any thread; allocates.
namespace afm::curves {

// Curves of one file, and their truth: JSON in SI with the unit in each key. The curves do not contain the truth.
struct SyntheticFile {
  std::vector<RecordedCurve> curves;
  std::string truth;
};

// Limit of the points of all curves of a file.
inline constexpr std::size_t kMostSyntheticPoints = 2'000'000;

// `count` curves that differ in their noise. `setup` is of apply(). WrongUsage, with the option to change, for a tip
// that goes deeper than its law holds, a base that begins where the tip still sticks, and more than
// kMostSyntheticPoints.
core::Result<SyntheticFile> synthetic_curves(const SyntheticSetup& setup, std::size_t count);

// Shapes of a field over a map.
enum class FieldShape { Uniform, Step, Gradient, Islands };
struct FieldShapeRow {
  FieldShape shape;
  std::string_view name;
  std::string_view meaning;
};
inline constexpr std::array kFieldShapes{
    FieldShapeRow{FieldShape::Uniform, "uniform", "the same everywhere"},
    FieldShapeRow{FieldShape::Step, "step", "the second value in the right half"},
    FieldShapeRow{FieldShape::Gradient, "gradient", "from the left column to the second value in the right one"},
    FieldShapeRow{FieldShape::Islands, "islands", "the second value in five discs, whose places follow from the seed"}};
static_assert(core::has_row_for_each(kFieldShapes, &FieldShapeRow::shape));

// Pixels and width of a map, unless others are given, and legal values of a request.
inline constexpr std::size_t kUsualMapPixels = 16, kMostMapPixels = 512;  // number along a side
inline constexpr double kUsualMapWidthM = 10e-6;
inline constexpr QuantityRange<double> kMapWidthsM{1e-9, 1e-3}, kMapModuliPa{1.0, 1e12}, kMapWorksJPerM2{1e-6, 10.0};

// Grid of square pixels around the origin.
constexpr MapGrid map_grid(std::size_t columns, std::size_t rows, double width_m) {
  return {columns, rows, width_m, width_m * static_cast<double>(rows) / static_cast<double>(columns), 0.0, 0.0};
}

struct SyntheticMap {
  MapGrid grid = map_grid(kUsualMapPixels, kUsualMapPixels, kUsualMapWidthM);
  FieldShape shape = FieldShape::Uniform;
  double second_modulus_pa = 0, second_work_j_per_m2 = 0;  // second values; zero: equal to the first
};

// A curve a pixel, the bottom row first and each from the left. WrongUsage as synthetic_curves(), and for second values
// that the shape or the law does not use.
core::Result<SyntheticFile> synthetic_map(const SyntheticSetup& setup, const SyntheticMap& map);

}  // namespace afm::curves
