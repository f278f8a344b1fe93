// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "bytes/text_table.h"
#include "confined/confined_child.h"
#include "confined/mapped_file.h"
#include "curves/curve_error.h"
#include "curves/curve_file.h"
#include "curves/curve_series.h"
#include "formats/format_table.h"
#include "formats/handed_curve.h"

namespace afm::curves {

// Counting and reading of curves in formats whose files hold several, without their bytes in this process. Throws
// CurveError.
struct SeriesRow {
  std::size_t (*count)(const std::string& path);
  // Stream with one message per curve, as of handed_bytes().
  std::unique_ptr<ConfinedStream> (*stream)(const std::string& path, const SeriesPart& part,
                                            const CurveReading& reading);
  std::string (*write)(std::span<const RecordedCurve> curves);  // writer of a file; null: read only
};

// Number in a child's message, checked because the child is not trusted.
inline std::size_t count_in(const std::string& text) {
  constexpr double kMostCurves = 4e6;
  const double count = number_in(text, "count", Lines({}));
  if (!(count >= 1.0 && count <= kMostCurves)) throw CurveError("it has no curves, or more than 4 million");
  return static_cast<std::size_t>(count);
}

// Row for an Archive(std::string_view bytes) with size() and curve(index, reading).
template <class Archive>
constexpr SeriesRow series_of() {
  return {[](const std::string& path) -> std::size_t {
            const MappedFile file(path);
            return count_in(in_confined_child([&] { return std::to_string(Archive(file.bytes()).size()); },
                                              kNotSurvived, kMapTime));
          },
          [](const std::string& path, const SeriesPart& part, const CurveReading& reading) {
            const MappedFile file(path);
            return std::make_unique<ConfinedStream>(
                [&](const PutMessage& put) {
                  constexpr std::size_t kCurvesKept = 256;  // number of curves after which memory is returned
                  const Archive archive(file.bytes());
                  for (std::size_t i = part.first, read = 1; i < archive.size(); i += part.step, ++read) {
                    try {
                      put({false, handed_bytes(archive.curve(i, reading))});
                    } catch (const CurveError& fault) {
                      put({true, fault.what()});
                    }
                    if (read % kCurvesKept == 0) file.forget();
                  }
                },
                kNotSurvived);
          },
          nullptr};
}

}  // namespace afm::curves
