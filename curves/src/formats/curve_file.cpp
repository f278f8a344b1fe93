// SPDX-License-Identifier: Apache-2.0
#include "curves/curve_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/printable.h"
#include "core/whole_file.h"
#include "curves/curve_error.h"
#include "formats/confined_child.h"
#include "formats/igor_file.h"
#include "formats/igor_wave.h"
#include "formats/jpk_file.h"
#include "formats/tab_file.h"
#include "formats/touchafm_csv_file.h"
#include "formats/workshop_file.h"

namespace afm::curves {

namespace {

constexpr const char* kHdf5Program = "touchafm-hdf5";
constexpr const char* kNotSurvived = "it is damaged: its reader could not survive it";
constexpr std::uintmax_t kLargestCurveBytes = std::uintmax_t{256} << 20U;

constexpr std::size_t kLongestHeading = 65536;

std::optional<CurveFormat> known_format(std::string_view bytes) {
  const std::string_view heading = bytes.substr(0, kLongestHeading);
  if (bytes.starts_with("\x89HDF\r\n\x1a\n")) return CurveFormat::Hdf5;
  if (bytes.starts_with("PK\x03\x04")) return CurveFormat::JpkForce;
  if (bytes.starts_with("# TouchAFM force-displacement curve")) return CurveFormat::TouchAfmCsv;
  if (bytes.starts_with("#") && heading.find("# BEGIN METADATA") != std::string_view::npos) return CurveFormat::Tab;
  if (heading.substr(0, 64).find("Force-Distance Curve") != std::string_view::npos) return CurveFormat::AfmWorkshop;
  if (looks_like_igor(bytes)) return CurveFormat::IgorBinaryWave;
  return std::nullopt;
}

CurveFormat format_of(std::string_view bytes) {
  const auto format = known_format(bytes);
  if (!format) throw CurveError(fmt::format("it is no curve of a known kind; known are {}", kCurveFiles));
  return *format;
}

// Forces that the file gives in newtons scale with a calibration that replaces the one they were made with.
void recalibrate(const CurveReading& reading, RecordedCurve& curve) {
  CurveMetadata& made = curve.metadata;
  double factor = 1.0;
  if (reading.spring_constant && made.spring_constant) factor *= *reading.spring_constant / *made.spring_constant;
  if (reading.sensitivity_m_per_v && made.sensitivity_m_per_v) {
    factor *= *reading.sensitivity_m_per_v / *made.sensitivity_m_per_v;
  }
  for (physics::CurvePoint& point : curve.points) point.force = factor * point.force;
  if (reading.spring_constant) made.spring_constant = reading.spring_constant;
  if (reading.sensitivity_m_per_v) made.sensitivity_m_per_v = reading.sensitivity_m_per_v;
}

// The formats that others made, and of which we have the readers of others or have seen few files.
RecordedCurve read_foreign(CurveFormat format, std::string_view bytes, const CurveReading& reading) {
  switch (format) {
    case CurveFormat::JpkForce:
      return read_jpk(bytes, reading);
    case CurveFormat::AfmWorkshop:
      return read_workshop(bytes, reading);
    default:
      return read_igor(bytes);
  }
}

RecordedCurve read(std::string_view bytes, const CurveReading& reading) {
  const CurveFormat format = format_of(bytes);
  if (reading.index != 0 && format != CurveFormat::Hdf5) throw CurveError("it holds one curve alone");
  if (format == CurveFormat::TouchAfmCsv) return read_touchafm_csv(bytes);
  if (format == CurveFormat::Tab) return read_tab(bytes);
  // handed over in the format that holds the same and has a reader of our own
  if (format == CurveFormat::Hdf5) {
    return read_tab(from_confined_program(kHdf5Program, {"read", std::to_string(reading.index)}, bytes, kNotSurvived));
  }
  if (!reading.confined) return read_foreign(format, bytes, reading);
  return read_tab(in_confined_child([&] { return tab_bytes(read_foreign(format, bytes, reading)); }, kNotSurvived));
}

// What every curve is, wherever it came from.
void check(RecordedCurve& curve) {
  constexpr double kHighest_m = 1.0, kStrongest_n = 1.0, kStiffest_n_per_m = 1e6;
  if (curve.points.size() < physics::kFewestApproachPoints) {
    throw CurveError(fmt::format("it has only {} points", curve.points.size()));
  }
  for (const physics::CurvePoint& point : curve.points) {
    if (!(std::abs(point.z.si) <= kHighest_m) || !(std::abs(point.force.si) <= kStrongest_n)) {
      throw CurveError(fmt::format("a point at {} m with {} N is outside the range of a force microscope; is it in SI?",
                                   point.z.si, point.force.si));
    }
  }
  if (const auto k = curve.metadata.spring_constant; k && !(k->si > 0.0 && k->si <= kStiffest_n_per_m)) {
    throw CurveError(fmt::format("its spring constant of {} N/m is not within 0 to 1 MN/m", k->si));
  }
  const auto is_approach = [](const auto& point) { return point.branch == physics::Branch::Approach; };
  if (!std::is_partitioned(curve.points.begin(), curve.points.end(), is_approach)) {
    throw CurveError("it does not approach once and retract once");
  }
  if (!is_approach(curve.points.front())) throw CurveError("it has no approach");
}

// The texts go to terminals and into lines of files; the parameters are printable already.
void make_texts_printable(CurveMetadata& metadata) {
  for (std::string* text : {&metadata.instrument, &metadata.software, &metadata.software_version, &metadata.date,
                            &metadata.time, &metadata.curve_id}) {
    *text = core::printable_line(*text);
  }
}

}  // namespace

std::optional<CurveFormat> writable_format(std::string_view name) {
  if (name == "tab") return CurveFormat::Tab;
  if (name == "h5") return CurveFormat::Hdf5;
  if (name == "afm-workshop") return CurveFormat::AfmWorkshop;
  return std::nullopt;
}

bool is_curve_file(const std::string& path) {
  const auto beginning = core::read_beginning(path, kLongestHeading);
  return beginning && known_format(*beginning).has_value();
}

core::Result<RecordedCurve> load_curve(const std::string& path, const CurveReading& reading) {
  std::error_code missing;
  if (const auto size = std::filesystem::file_size(path, missing); !missing && size > kLargestCurveBytes) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("cannot read {}: it is larger than {} MiB", path, kLargestCurveBytes >> 20U));
  }
  const auto bytes = core::read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_curve(*bytes, path, reading);
}

core::Result<RecordedCurve> parse_curve(std::string_view bytes, const std::string& name, const CurveReading& reading) {
  const auto bad = [&](const char* why) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("cannot read the curve {}: {}", name, why));
  };
  try {
    RecordedCurve curve = read(bytes, reading);
    recalibrate(reading, curve);
    check(curve);
    make_texts_printable(curve.metadata);
    return curve;
  } catch (const CurveError& fault) {
    return bad(fault.what());
  } catch (const nlohmann::json::exception&) {
    return bad("its metadata is no valid JSON");
  } catch (const std::bad_alloc&) {
    return bad("there is too little memory for it");
  } catch (const std::runtime_error& fault) {
    return bad(fault.what());
  }
}

core::Result<std::string> curve_bytes(CurveFormat format, const RecordedCurve& curve) {
  try {
    switch (format) {
      case CurveFormat::Tab:
        return tab_bytes(curve);
      case CurveFormat::Hdf5:
        return from_confined_program(kHdf5Program, {"write"}, tab_bytes(curve), "HDF5 could not make it");
      case CurveFormat::AfmWorkshop:
        return workshop_bytes(curve);
      case CurveFormat::TouchAfmCsv:
      case CurveFormat::JpkForce:
      case CurveFormat::IgorBinaryWave:
        break;
    }
  } catch (const std::runtime_error& error) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot write the curve: {}", error.what()));
  }
  return core::failure(core::ErrorCategory::WrongUsage, "curves are written as tab, h5 or afm-workshop alone");
}

core::Result<void> write_curve(const std::string& path, CurveFormat format, const RecordedCurve& curve) {
  const auto bytes = curve_bytes(format, curve);
  if (!bytes) return tl::unexpected(bytes.error());
  return core::write_file(path, *bytes);
}

}  // namespace afm::curves
