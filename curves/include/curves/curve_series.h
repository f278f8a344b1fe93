// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "core/result.h"
#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// Curves of a file: one of most formats, several of an .h5, of the maps of JPK, Nanosurf and Asylum and of a force
// volume. Known files that cannot hold several are not opened. BadInputFile as load_curve().
core::Result<std::size_t> curve_count(const std::string& path, const CurveReading& reading = {});

// Contents of a file with one curve or more; only .h5 holds several. Errors as of curve_bytes(), and WrongUsage for a
// format that cannot hold so many.
core::Result<std::string> series_bytes(CurveFormat format, std::span<const RecordedCurve> curves);

// Every `step`-th curve from `first` on, so that several threads can share a file.
struct SeriesPart {
  std::size_t first = 0;
  std::size_t step = 1;
};

// Gets a curve and its index, or the reason why it cannot be read; returns false to end the series.
using TakeCurve = std::function<bool(std::size_t index, core::Result<RecordedCurve> curve)>;

// Reads a part of the curves of a file with `count` curves, in order, one in memory at a time, in one confined process;
// a curve that kills it is lost, and after eight in a row all that follow. `reading.index` is not used. One call a
// thread; any thread but the servo's.
void read_curves(const std::string& path, std::size_t count, const SeriesPart& part, const CurveReading& reading,
                 const TakeCurve& take);

}  // namespace afm::curves
