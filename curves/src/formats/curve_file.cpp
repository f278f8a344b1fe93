// SPDX-License-Identifier: Apache-2.0
#include "curves/curve_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "bytes/igor_wave.h"
#include "bytes/nanosurf_header.h"
#include "confined/confined_child.h"
#include "confined/mapped_file.h"
#include "core/enumerators.h"
#include "core/file_names.h"
#include "core/printable.h"
#include "core/whole_file.h"
#include "curves/curve_error.h"
#include "curves/curve_series.h"
#include "curves/image_file.h"
#include "formats/ardf_file.h"
#include "formats/column_table.h"
#include "formats/confined_series.h"
#include "formats/format_table.h"
#include "formats/handed_curve.h"
#include "formats/igor_file.h"
#include "formats/jpk_file.h"
#include "formats/nanoscope_curve.h"
#include "formats/nanosurf_curve.h"
#include "formats/segments.h"
#include "formats/tab_file.h"
#include "formats/touchafm_csv_file.h"
#include "formats/workshop_file.h"

namespace afm::curves {

namespace {

constexpr const char* kHdf5Program = "touchafm-hdf5";
constexpr std::size_t kLongestHeading = 65536;

bool begins_as_tab(std::string_view bytes) {
  return bytes.starts_with("#") && bytes.substr(0, kLongestHeading).find("# BEGIN METADATA") != std::string_view::npos;
}

// Arguments for touchafm-hdf5; a calibration that is not given is 0.
std::vector<std::string> hdf5_arguments(const char* how, const SeriesPart& part, const CurveReading& reading) {
  const double spring = reading.spring_constant ? reading.spring_constant->si : 0.0;
  return {how, std::to_string(part.first), std::to_string(part.step), fmt::format("{}", spring),
          fmt::format("{}", reading.sensitivity_m_per_v.value_or(0.0))};
}

// Transfers the curve in a format of the same content that has a reader here.
RecordedCurve read_hdf5(std::string_view bytes, const CurveReading& reading) {
  return read_tab(
      from_confined_program(kHdf5Program, hdf5_arguments("read", {reading.index, 1}, reading), bytes, kNotSurvived));
}
std::size_t count_hdf5(const std::string& path) {
  const auto bytes = bytes_of_file(path);
  if (!bytes) throw CurveError(bytes.error().message);
  return count_in(from_confined_program(kHdf5Program, {"count"}, *bytes, kNotSurvived));
}
std::unique_ptr<ConfinedStream> stream_hdf5(const std::string& path, const SeriesPart& part,
                                            const CurveReading& reading) {
  const auto bytes = bytes_of_file(path);
  if (!bytes) throw CurveError(bytes.error().message);
  return std::make_unique<ConfinedStream>(kHdf5Program, hdf5_arguments("stream", part, reading), *bytes, kNotSurvived);
}
std::string hdf5_bytes(std::span<const RecordedCurve> curves) {
  std::string tabs;
  for (const RecordedCurve& curve : curves) tabs.append(tab_bytes(curve)).push_back('\0');
  return from_confined_program(kHdf5Program, {"write"}, tabs, "HDF5 could not make it", kMapTime);
}

// Reads a curve of a format whose files may hold several.
template <class Archive>
RecordedCurve read_one(std::string_view bytes, const CurveReading& reading) {
  const Archive archive(bytes);
  if (reading.index >= archive.size()) {
    throw CurveError(fmt::format("it has no curve {}; it has {}, counted from 0", reading.index, archive.size()));
  }
  RecordedCurve curve = archive.curve(reading.index, reading);
  remark_index(reading.index, archive.size(), curve.metadata);
  return curve;
}

constexpr SeriesRow kHdf5Series{count_hdf5, stream_hdf5, hdf5_bytes},
    kJpkSeries = series_of<JpkArchive>(), kNanoscopeSeries = series_of<NanoscopeCurves>(),
    kNanosurfSeries = series_of<NanosurfCurves>(), kArdfSeries = series_of<ArdfCurves>();

enum class Reader { Ours, Foreign };  // origin of a format; Foreign: of other programs, read in a confined child

struct CurveRow {
  CurveFormat format;
  std::string_view files;   // names and endings, as listed in kCurveFiles
  std::string_view word;    // value of --format; empty: read only
  std::string_view ending;  // file ending, ".tab"; empty: read only
  bool (*begins)(std::string_view bytes);
  Reader reader;
  const SeriesRow* series;  // functions for files with several curves; null: files contain one curve
  RecordedCurve (*read)(std::string_view bytes, const CurveReading& reading);
  std::string (*write)(const RecordedCurve& curve);  // writer of a file; null: read only
  bool binary = false;                               // true: not text, so unsuitable for a terminal
};

constexpr FormatTable kCurves{
    "curve",
    [](std::string_view b) {
      return begins_like_image(b) ? std::string_view("an image, not a curve") : std::string_view();
    },
    kCurveFiles, kLongestHeading,
    std::array{
        CurveRow{CurveFormat::TouchAfmCsv, "TouchAFM .csv", "", "",
                 [](std::string_view b) { return b.starts_with("# TouchAFM force-displacement curve"); }, Reader::Ours,
                 nullptr, [](std::string_view b, const CurveReading&) { return read_touchafm_csv(b); }, nullptr},
        CurveRow{CurveFormat::Tab, "afmformats .tab", "tab", ".tab", begins_as_tab, Reader::Ours, nullptr,
                 [](std::string_view b, const CurveReading&) { return read_tab(b); }, tab_bytes},
        CurveRow{CurveFormat::Hdf5, ".h5", "h5", ".h5",
                 [](std::string_view b) { return b.starts_with("\x89HDF\r\n\x1a\n"); }, Reader::Ours, &kHdf5Series,
                 read_hdf5, [](const RecordedCurve& curve) { return hdf5_bytes({&curve, 1}); }, true},
        CurveRow{CurveFormat::JpkForce, "JPK .jpk-force, .jpk-force-map or .jpk-qi-data", "", "",
                 [](std::string_view b) { return b.starts_with("PK\x03\x04"); }, Reader::Foreign, &kJpkSeries,
                 read_one<JpkArchive>, nullptr},
        CurveRow{
            CurveFormat::AfmWorkshop, "AFM Workshop .csv", "afm-workshop", ".csv",
            [](std::string_view b) { return b.substr(0, 64).find("Force-Distance Curve") != std::string_view::npos; },
            Reader::Foreign, nullptr, read_workshop, workshop_bytes},
        CurveRow{CurveFormat::NanoscopeForce, "Nanoscope .spm or .000", "", "",
                 [](std::string_view b) { return b.starts_with(kNanoscopeForceMagic); }, Reader::Foreign,
                 &kNanoscopeSeries, read_one<NanoscopeCurves>, nullptr},
        CurveRow{CurveFormat::Nanosurf, "Nanosurf .nid", "", "", has_nanosurf_spectroscopy, Reader::Foreign,
                 &kNanosurfSeries, read_one<NanosurfCurves>, nullptr},
        CurveRow{CurveFormat::IgorBinaryWave, "Igor .ibw", "", "", looks_like_igor, Reader::Foreign, nullptr, read_igor,
                 nullptr},
        CurveRow{CurveFormat::AsylumMap, "Asylum .ardf", "", "",
                 [](std::string_view b) { return b.size() > 12 && b.substr(8, 4) == "ARDF"; }, Reader::Foreign,
                 &kArdfSeries, read_one<ArdfCurves>, nullptr}}};
// Row of a plain table, whose content does not identify it: the user does.
constexpr CurveRow kColumnTable{CurveFormat{},     "",     "", "", nullptr, Reader::Foreign, nullptr,
                                read_column_table, nullptr};
static_assert(core::has_row_for_each(kCurves.rows, &CurveRow::format));
static_assert(kCurves.names_all(), "kCurveFiles names the files of every format");

// Forces given in newtons scale with a calibration that replaces the original one.
void recalibrate(const CurveReading& reading, RecordedCurve& curve) {
  CurveMetadata& made = curve.metadata;
  double factor = 1.0;
  const auto replace = [&](const auto& given, const auto& own, const char* name) {
    if (!given) return;
    const double ratio = own ? *given / *own : 0.0;
    const bool known = own && std::isfinite(ratio);  // false for 0 as well, which some programs write for none
    if (known) factor *= ratio;
    if (!known) {
      made.remarks.push_back(fmt::format(
          "its forces are in newtons, and it does not say with which {} they were made: they do not change", name));
    }
  };
  replace(reading.spring_constant, made.spring_constant, "spring constant");
  replace(reading.sensitivity_m_per_v, made.sensitivity_m_per_v, "sensitivity");
  for (physics::CurvePoint& point : curve.points) point.force = factor * point.force;
  if (reading.spring_constant) made.spring_constant = reading.spring_constant;
  if (reading.sensitivity_m_per_v) made.sensitivity_m_per_v = reading.sensitivity_m_per_v;
}

// Checks the requirements on any curve.
void check(RecordedCurve& curve) {
  constexpr double kStiffest_n_per_m = 1e6;
  if (curve.points.size() < physics::kFewestApproachPoints) {
    throw CurveError(fmt::format("it has only {} point{}; a curve needs {}", curve.points.size(),
                                 curve.points.size() == 1 ? "" : "s", physics::kFewestApproachPoints));
  }
  for (const physics::CurvePoint& point : curve.points) {
    if (const std::string doubt = doubt_of(point); !doubt.empty()) throw CurveError("a point " + doubt);
  }
  if (const auto k = curve.metadata.spring_constant; k && !(k->si > 0.0 && k->si <= kStiffest_n_per_m)) {
    throw CurveError(fmt::format("its spring constant of {} N/m is not within 0 to 1 MN/m", k->si));
  }
  const auto is_approach = [](const auto& point) { return point.branch == physics::Branch::Approach; };
  const auto approach = std::find_if(curve.points.begin(), curve.points.end(), is_approach);
  if (approach != curve.points.begin() && std::all_of(approach, curve.points.end(), is_approach) &&
      approach != curve.points.end()) {
    put_second_part_first(static_cast<std::size_t>(approach - curve.points.begin()), curve);
  }
  if (!std::is_partitioned(curve.points.begin(), curve.points.end(), is_approach)) {
    throw CurveError("it does not approach once and retract once");
  }
  if (!is_approach(curve.points.front())) throw CurveError("it has no approach");
  set_directions(curve);
}

// Makes the texts safe for terminals and lines of files; the parameters are printable already.
void make_texts_printable(CurveMetadata& metadata) {
  for (std::string* text : {&metadata.instrument, &metadata.software, &metadata.software_version, &metadata.date,
                            &metadata.time, &metadata.curve_id}) {
    *text = core::printable_line(*text);
  }
  for (std::string& remark : metadata.remarks) remark = core::printable_line(remark);
}

// Last steps for a curve of any format: calibration, checks and printable texts.
RecordedCurve finished(RecordedCurve curve, const CurveReading& reading) {
  recalibrate(reading, curve);
  check(curve);
  make_texts_printable(curve.metadata);
  return curve;
}

// True for a map, which may be larger than memory: its bytes are only for the confined child.
bool is_mapped(const CurveRow& row) { return row.reader == Reader::Foreign && row.series != nullptr; }

RecordedCurve parsed(const CurveRow& row, std::string_view text, const CurveReading& reading) {
  if (reading.index != 0 && row.series == nullptr) throw CurveError("it holds only one curve");
  const bool confined = row.reader == Reader::Foreign && reading.confined;
  RecordedCurve curve = read_confined(
      confined, [&] { return row.read(text, reading); }, tab_bytes, read_tab, is_mapped(row) ? kMapTime : kFileTime);
  return finished(std::move(curve), reading);
}

// Row of a file that may hold several curves; null for any other.
const CurveRow* row_with_series(const std::string& path, const CurveReading& reading) {
  const CurveRow* const row = reading.columns ? nullptr : kCurves.row_of_file(path);
  return row != nullptr && row->series != nullptr ? row : nullptr;
}

// Reader of a part of a file, curve by curve. A child that dies costs the curve that it was to read.
class PartReader {
 public:
  PartReader(const SeriesRow& series, const std::string& path, const SeriesPart& part, const CurveReading& reading)
      : series_(series), path_(path), rest_(part), reading_(reading) {}

  // The next curve. Throws if it cannot be read; the next call goes on after it.
  RecordedCurve next() {
    constexpr int kMostDeaths = 8;
    if (deaths_ == kMostDeaths) throw CurveError("it is damaged: its reader died at each of the eight curves before");
    const SeriesPart rest = std::exchange(rest_, {rest_.first + rest_.step, rest_.step});
    const ChildMessage message = message_of(rest);
    if (message.fault) throw CurveError(message.text);
    return finished(read_handed(message.text), reading_);
  }

 private:
  ChildMessage message_of(const SeriesPart& rest) {
    try {
      if (!stream_) stream_ = series_.stream(path_, rest, reading_);
      if (auto message = stream_->next()) {
        deaths_ = 0;
        return std::move(*message);
      }
      throw CurveError("the file ended before this curve; was it changed while it was read?");
    } catch (const CurveError&) {
      stream_.reset();
      ++deaths_;
      throw;
    }
  }

  const SeriesRow& series_;
  const std::string& path_;
  SeriesPart rest_;
  const CurveReading& reading_;
  std::unique_ptr<ConfinedStream> stream_;
  int deaths_ = 0;
};

}  // namespace

std::vector<WritableFormat> writable_formats() {
  std::vector<WritableFormat> formats;
  for (const CurveRow& row : kCurves.rows) {
    if (row.write != nullptr) formats.push_back({row.format, row.word, row.ending, row.binary});
  }
  return formats;
}

std::optional<WritableFormat> writable_format_of(std::string_view name) {
  for (const WritableFormat& format : writable_formats()) {
    if (core::has_ending(name, format.ending)) return format;
  }
  return std::nullopt;
}

bool is_curve_file(const std::string& path) { return kCurves.row_of_file(path) != nullptr; }

bool begins_like_curve(std::string_view bytes) { return kCurves.row_of(without_byte_order_mark(bytes)) != nullptr; }

core::Result<RecordedCurve> load_curve(const std::string& path, const CurveReading& reading) {
  if (const CurveRow* const row = row_with_series(path, reading); row != nullptr && is_mapped(*row)) {
    return kCurves.named(path, [&] { return parsed(*row, MappedFile(path).bytes(), reading); });
  }
  const auto bytes = bytes_of_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_curve(*bytes, path, reading);
}

core::Result<RecordedCurve> parse_curve(std::string_view bytes, const std::string& name, const CurveReading& reading) {
  if (reading.columns) {
    return kCurves.named(name, [&] { return parsed(kColumnTable, without_byte_order_mark(bytes), reading); });
  }
  return kCurves.parse(bytes, name,
                       [&](const CurveRow& row, std::string_view text) { return parsed(row, text, reading); });
}

core::Result<std::size_t> curve_count(const std::string& path, const CurveReading& reading) {
  const CurveRow* const row = row_with_series(path, reading);
  if (row == nullptr) return 1;
  return kCurves.named(path, [&] { return row->series->count(path); });
}

void read_curves(const std::string& path, std::size_t count, const SeriesPart& part, const CurveReading& reading,
                 const TakeCurve& take) {
  const CurveRow* const row = row_with_series(path, reading);
  if (row == nullptr) {
    if (part.first == 0) take(0, load_curve(path, reading));
    return;
  }
  PartReader reader(*row->series, path, part, reading);
  for (std::size_t index = part.first; index < count; index += part.step) {
    if (!take(index, kCurves.named(path, [&] { return reader.next(); }))) return;
  }
}

core::Result<std::string> curve_bytes(CurveFormat format, const RecordedCurve& curve) {
  const CurveRow& row = kCurves.rows[core::index_of(format)];
  if (row.write == nullptr) {
    std::vector<std::string_view> words;
    for (const WritableFormat& known : writable_formats()) words.push_back(known.word);
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("curves are written only as {}", fmt::join(words, ", ")));
  }
  try {
    return row.write(curve);
  } catch (const std::runtime_error& error) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot write the curve: {}", error.what()));
  }
}

core::Result<std::string> series_bytes(CurveFormat format, std::span<const RecordedCurve> curves) {
  if (curves.size() == 1) return curve_bytes(format, curves.front());
  const CurveRow& row = kCurves.rows[core::index_of(format)];
  if (row.series == nullptr || row.series->write == nullptr) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("cannot write {} curves: {} holds one alone; name a file that ends in .h5",
                                     curves.size(), row.files));
  }
  try {
    return row.series->write(curves);
  } catch (const std::runtime_error& error) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot write the curves: {}", error.what()));
  }
}

core::Result<void> write_curve(const std::string& path, CurveFormat format, const RecordedCurve& curve) {
  const auto bytes = curve_bytes(format, curve);
  if (!bytes) return tl::unexpected(bytes.error());
  return core::write_file(path, *bytes);
}

}  // namespace afm::curves
