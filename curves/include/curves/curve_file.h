// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "curves/recorded_curve.h"

// Reading and writing of force-distance curves; docs/curves.md says what each format holds.
namespace afm::curves {

// In the order in which a file's content is looked at; what is done with each is a row of kCurves in
// curve_file.cpp (docs/adding-a-curve-format.md).
enum class CurveFormat {
  TouchAfmCsv,     // output of `touchafm curve`
  Tab,             // afmformats, text
  Hdf5,            // afmformats, HDF5
  JpkForce,        // JPK's .jpk-force; read only
  AfmWorkshop,     // AFM Workshop's .csv; Gwyddion reads it too
  IgorBinaryWave,  // Asylum Research's .ibw; read only
};

// All of them, as help and refusals list them.
inline constexpr const char* kCurveFiles =
    "TouchAFM .csv, afmformats .tab or .h5, AFM Workshop .csv, JPK .jpk-force, Igor .ibw";

// Whether the beginning of a regular file is that of a curve.
bool is_curve_file(const std::string& path);

// Format that write_curve() writes.
struct WritableFormat {
  CurveFormat format = CurveFormat::Tab;
  std::string_view word;  // name on command lines, and the ending of files: "tab"
  bool binary = false;
};

// In the order of CurveFormat.
std::vector<WritableFormat> writable_formats();

// How a recording becomes forces and which of several is meant. A given calibration replaces the file's: forces scale
// with the spring constant and the sensitivity that they were made with.
struct CurveReading {
  std::optional<physics::Stiffness> spring_constant;
  std::optional<double> sensitivity_m_per_v;
  std::size_t index = 0;  // index of the curve, in an .h5 with several
  bool confined = true;   // formats of others in a process that can open nothing; false: here, so that a fuzzer sees
};

// Knows the format by its content. BadInputFile, in one line that names the file, for whatever is not wholly
// understood: truncated, altered, larger than 256 MiB, of another kind, without a calibration that it needs. Takes at
// most 1 GiB.
core::Result<RecordedCurve> load_curve(const std::string& path, const CurveReading& reading = {});

// The same for the bytes of a file called `name`.
core::Result<RecordedCurve> parse_curve(std::string_view bytes, const std::string& name,
                                        const CurveReading& reading = {});

// The whole file. AFM Workshop's format wants evenly spaced heights and as many of them up as down: there a curve that
// has not is interpolated. Errors are Failed, for a format that is only read WrongUsage.
core::Result<std::string> curve_bytes(CurveFormat format, const RecordedCurve& curve);

// Whole or not at all.
core::Result<void> write_curve(const std::string& path, CurveFormat format, const RecordedCurve& curve);

}  // namespace afm::curves
