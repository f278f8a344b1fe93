// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "curves/recorded_curve.h"
#include "curves/table_columns.h"

// Reading and writing of force-distance curves. docs/curves.md describes the contents of each format.
namespace afm::curves {

// Formats in the order in which a file's content is tested. Each one's functions are a row of kCurves in curve_file.cpp
// (docs/adding-a-curve-format.md).
enum class CurveFormat {
  TouchAfmCsv,     // output of `touchafm curve`
  Tab,             // afmformats, text
  Hdf5,            // afmformats, HDF5; Nanosurf Studio's .nhf, read only
  JpkForce,        // JPK's .jpk-force and its maps; read only
  AfmWorkshop,     // AFM Workshop's .csv; Gwyddion reads it too
  NanoscopeForce,  // Bruker's ramps and force volumes, .spm, .000, .pfc; read only
  Nanosurf,        // Nanosurf's spectroscopy, .nid; read only
  IgorBinaryWave,  // Asylum Research's .ibw; read only
  AsylumMap,       // Asylum Research's .ardf; read only
};

// All formats, for help and error messages.
inline constexpr const char* kCurveFiles =
    "TouchAFM .csv, afmformats .tab or .h5, AFM Workshop .csv, JPK .jpk-force, .jpk-force-map or .jpk-qi-data, "
    "Nanoscope .spm or .000, Nanosurf .nid or .nhf, Igor .ibw, Asylum .ardf";

// Returns whether a regular file begins like a curve.
bool is_curve_file(const std::string& path);

// Returns whether the bytes of a file begin like a curve.
bool begins_like_curve(std::string_view bytes);

// Format that write_curve() writes.
struct WritableFormat {
  CurveFormat format = CurveFormat::Tab;
  std::string_view word;    // spelling on command lines: "tab"
  std::string_view ending;  // ending of a file's name: ".tab"
  bool binary = false;
};

// Writable formats in the order of CurveFormat.
std::vector<WritableFormat> writable_formats();

// Format for the ending of a file's name; empty: none. AFM Workshop's is the only .csv.
std::optional<WritableFormat> writable_format_of(std::string_view name);

// Conversion of a recording to forces, and the curve to read. A given calibration replaces the file's: forces scale
// with their original spring constant and sensitivity.
struct CurveReading {
  std::optional<physics::Stiffness> spring_constant;
  std::optional<double> sensitivity_m_per_v;
  std::size_t index = 0;                  // number of the curve in a file with several (curves/curve_series.h)
  std::optional<TableColumns> columns{};  // contents of a plain table; if given, the file is read as a table
  bool confined = true;  // foreign formats are read in a process that cannot open anything; false: here, for a fuzzer
};

// Detects the format by its content. BadInputFile, in one line that names the file, for any content that is not
// completely understood: truncated, altered, of another kind, without a necessary calibration, or larger than 256 MiB
// (a map: 16 GiB).
// Takes at most 1 GiB.
core::Result<RecordedCurve> load_curve(const std::string& path, const CurveReading& reading = {});

// Reads the bytes of a file called `name`, as load_curve() does.
core::Result<RecordedCurve> parse_curve(std::string_view bytes, const std::string& name,
                                        const CurveReading& reading = {});

// Contents of the whole file. AFM Workshop's format needs evenly spaced heights and equally long branches; other curves
// are interpolated. Errors are Failed, or WrongUsage for a read-only format.
core::Result<std::string> curve_bytes(CurveFormat format, const RecordedCurve& curve);

// Writes the file completely or not at all.
core::Result<void> write_curve(const std::string& path, CurveFormat format, const RecordedCurve& curve);

}  // namespace afm::curves
