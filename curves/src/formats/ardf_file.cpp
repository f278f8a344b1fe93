// SPDX-License-Identifier: Apache-2.0
#include "formats/ardf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_set>
#include <utility>

#include "bytes/igor_wave.h"
#include "bytes/nanoscope_header.h"
#include "bytes/scaled_unit.h"
#include "bytes/text_table.h"
#include "core/printable.h"
#include "curves/curve_error.h"
#include "formats/igor_file.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

constexpr std::size_t kArdfWord = 32, kMostArdfChannels = 16, kArdfArrayHead = 56, kArdfSegments = 5;
constexpr const char* kNotMeasured = "it has no curve that was measured";

std::uint64_t ardf_pointer(const ArdfSection& section, std::size_t offset) {
  return number_at<std::uint64_t>(section.bytes, offset);
}
std::uint32_t ardf_number(const ArdfSection& section, std::size_t offset) {
  return number_at<std::uint32_t>(section.bytes, offset);
}

// Step of a definition in metres; 0 if it is no length.
double ardf_step_m(const ArdfSection& definition, std::size_t number, std::size_t unit) {
  const ScaledUnit scale = scaled_unit(ardf_text(definition, unit, kArdfWord));
  const double step_m = number_at<double>(definition.bytes, number) * scale.factor;
  return scale.unit == "m" && step_m > 0.0 && step_m < 1.0 ? step_m : 0.0;
}

// Motion of the tip in a segment of this name.
std::optional<physics::Branch> ardf_branch(std::string_view segment) {
  const std::string name = lower_key(segment);
  if (name.starts_with("ext") || name.starts_with("app")) return physics::Branch::Approach;
  if (name.starts_with("ret")) return physics::Branch::Retract;
  return std::nullopt;
}

// Remarks on a segment in which the tip neither approaches nor retracts.
void leave_ardf_out(const std::string& segment, std::size_t points, RecordedCurve& curve) {
  if (points == 0) return;
  const char* when = curve.points.empty()                                      ? kBeforeApproach
                     : curve.points.back().branch == physics::Branch::Approach ? kBetweenBranches
                                                                               : kAfterRetract;
  const bool rests = lower_key(segment).starts_with("dwell");
  remark_left_out(points, when, rests ? "rests" : fmt::format("is in a segment \"{}\"", core::printable_line(segment)),
                  std::nullopt, curve.metadata);
}

}  // namespace

// Floats of a channel, and the beginning of each segment.
struct ArdfCurves::Array {
  std::string_view floats;
  std::array<std::uint32_t, kArdfSegments> begins{};

  std::size_t size() const { return floats.size() / sizeof(float); }
  double at(std::size_t i) const { return static_cast<double>(number_at<float>(floats, i * sizeof(float))); }
};

ArdfCurves::ArdfCurves(std::string_view bytes) : bytes_(bytes) {
  const ArdfSection begin = ardf_section(bytes, 0, "ARDF");
  const ArdfTable contents = ardf_table(bytes, begin.end(), "FTOC", 24);
  read_note(contents);
  std::optional<std::uint64_t> first;
  for (const ArdfSection& entry : contents.entries) {
    if (entry.name != "VOLM") continue;
    ++volumes_;
    if (!first) first = ardf_pointer(entry, kArdfHead);
  }
  if (!first) throw CurveError("it has no force map: it holds images alone");
  read_volume(*first);
}

// Reads the note, the first text of the file.
void ArdfCurves::read_note(const ArdfTable& contents) {
  const ArdfTable texts = ardf_table(bytes_, contents.end, "TTOC", 32);
  if (texts.entries.empty()) return;
  const ArdfSection text = ardf_section(bytes_, ardf_pointer(texts.entries.front(), 24), "TEXT");
  note_ = part(text.bytes, 24, ardf_number(text, 20));
}

void ArdfCurves::read_volume(std::uint64_t offset) {
  const ArdfTable volume = ardf_table(bytes_, offset, "VOLM", 24);
  const ArdfTable texts = ardf_table(bytes_, volume.end, "TTOC", 32);
  const ArdfSection definition = ardf_section(bytes_, texts.end, "VDEF");
  columns_ = ardf_number(definition, 16);
  rows_ = ardf_number(definition, 20);
  if (columns_ < 1 || rows_ < 1 || columns_ > kMostMapSide || rows_ > kMostMapSide) {
    throw CurveError(
        fmt::format("its map has {} x {} curves; 1 to {} along a side are read", columns_, rows_, kMostMapSide));
  }
  step_x_m_ = ardf_step_m(definition, 48, 72);
  step_y_m_ = ardf_step_m(definition, 56, 104);
  std::vector<std::string_view> names;
  split(ardf_text(definition, 168, kArdfWord), ';', names);
  for (const std::string_view name : names) {
    if (!trimmed(name).empty()) segments_.emplace_back(trimmed(name));
  }
  if (segments_.size() > kArdfSegments)
    throw CurveError(fmt::format("its curves have {} segments; at most {} are read", segments_.size(), kArdfSegments));
  const ArdfSection experiment = ardf_section(bytes_, read_channels(definition.end()), "XDEF");
  find_sets(ardf_table(bytes_, experiment.end(), "VTOC", 40));
}

// Reads the channels. Returns the offset after them.
std::uint64_t ArdfCurves::read_channels(std::uint64_t offset) {
  while (channels_.size() < kMostArdfChannels) {
    const ArdfSection section = ardf_section(bytes_, offset);
    if (section.name != "VCHN") break;
    ScaledUnit unit = scaled_unit(ardf_text(section, 16 + kArdfWord, kArdfWord));
    channels_.push_back({std::string(ardf_text(section, 16, kArdfWord)), std::move(unit.unit), unit.factor});
    offset = section.end();
  }
  return offset;
}

struct ArdfCurves::Walk {
  std::unordered_set<std::size_t> seen;  // offsets of the curves in the file
  std::optional<std::uint32_t> way;      // pass of the scan that is read
};

// Finds the curves; each line begins at an entry of the table.
void ArdfCurves::find_sets(const ArdfTable& lines) {
  Walk walk;
  for (const ArdfSection& entry : lines.entries) {
    try {
      find_line(ardf_number(entry, 20), ardf_pointer(entry, 32), walk);
    } catch (const CutShort&) {
      is_cut_ = true;
    }
  }
  leave_out_cut_set();
  if (sets_.empty() && is_cut_) throw CutShort("none of its curves is there");
  if (sets_.empty()) throw CurveError(kNotMeasured);
  std::stable_sort(sets_.begin(), sets_.end(),
                   [](const Set& a, const Set& b) { return a.line != b.line ? a.line < b.line : a.point < b.point; });
}

// Finds the curves of a line, a list that ends with another line or the way back.
void ArdfCurves::find_line(std::uint64_t line, std::uint64_t first, Walk& walk) {
  for (std::uint64_t next = first; next != 0;) {
    const ArdfSection set = ardf_section(bytes_, next);
    if (set.name != "VSET") return;
    const Set place{set.offset, ardf_number(set, 20), ardf_number(set, 24)};
    const std::uint32_t this_way = ardf_number(set, 28);
    if (place.line != line || walk.way.value_or(this_way) != this_way || !walk.seen.insert(set.offset).second) return;
    walk.way = this_way;
    if (place.line >= rows_ || place.point >= columns_) {
      throw CurveError(fmt::format("a curve of it is at point {} of line {}, beside its {} x {} places", place.point,
                                   place.line, columns_, rows_));
    }
    sets_.push_back(place);
    next = ardf_pointer(set, 40);
    if (next <= set.offset) return;
  }
}

bool ArdfCurves::is_cut(const Set& set) const {
  try {
    for (std::size_t i = 0; i < channels_.size(); ++i) array_of(set, i);
    return false;
  } catch (const CutShort&) {
    return true;
  } catch (const CurveError&) {
    return false;  // fault of this curve only
  }
}

// Removes the curve before the end of a file that ends early, because it is not complete.
void ArdfCurves::leave_out_cut_set() {
  const auto last =
      std::max_element(sets_.begin(), sets_.end(), [](const Set& a, const Set& b) { return a.offset < b.offset; });
  if (last == sets_.end() || !is_cut(*last)) return;
  is_cut_ = true;
  sets_.erase(last);
}

// Index of a channel; the number of channels if it is missing.
std::size_t ArdfCurves::channel(std::string_view name) const {
  const auto found =
      std::find_if(channels_.begin(), channels_.end(), [&](const Channel& each) { return each.name == name; });
  return static_cast<std::size_t>(found - channels_.begin());
}

ArdfCurves::Array ArdfCurves::array_of(const Set& set, std::size_t channel) const {
  const ArdfSection head = ardf_section(bytes_, set.offset, "VSET");
  std::uint64_t next = ardf_section(bytes_, head.end(), "VNAM").end();
  for (std::size_t i = 0; i < kMostArdfChannels; ++i) {
    const ArdfSection data = ardf_section(bytes_, next);
    if (data.name != "VDAT") break;
    next = data.end();
    if (ardf_number(data, 32) != channel) continue;
    const std::uint64_t count = ardf_number(data, 28);
    if (count > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
    Array array{part(data.bytes, kArdfArrayHead, count * sizeof(float)), {}};
    for (std::size_t k = 0; k < kArdfSegments; ++k) array.begins[k] = ardf_number(data, 36 + k * sizeof(std::uint32_t));
    return array;
  }
  throw CurveError(fmt::format("this curve of it has no channel {}", core::printable_line(channels_[channel].name)));
}

// Newtons per unit of the deflection. Uses `reading` for what the note lacks.
double ArdfCurves::newton_per_unit(const Channel& deflection, const CurveReading& reading,
                                   CurveMetadata& metadata) const {
  const bool volts = deflection.unit == "V";
  if (!volts && deflection.unit != "m")
    throw CurveError(fmt::format("its deflection is in \"{}\"", core::printable_line(deflection.unit)));
  if (!metadata.spring_constant) metadata.spring_constant = reading.spring_constant;
  if (!metadata.sensitivity_m_per_v) metadata.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  if (!metadata.spring_constant)
    throw CurveError("its lever is not calibrated: its note has no valid SpringConstant; give --spring-constant");
  if (volts && !metadata.sensitivity_m_per_v)
    throw CurveError("its lever is not calibrated: its note has no valid InvOLS; give --sensitivity");
  return deflection.factor * metadata.spring_constant->si * (volts ? *metadata.sensitivity_m_per_v : 1.0);
}

RecordedCurve ArdfCurves::curve(std::size_t index, const CurveReading& reading) const {
  const std::string there = fmt::format("it has {} of at most {} curves", sets_.size(), columns_ * rows_);
  if (is_cut_ && index == sets_.size()) throw CutShort(there);
  const Set& set = sets_.at(index);
  RecordedCurve curve{{}, {}, asylum_metadata(note_)};
  if (is_cut_) curve.metadata.remarks.push_back(cut_short(there));
  const std::size_t deflection = channel("Defl");
  std::size_t height = channel("ZSnsr");
  if (height == channels_.size()) height = channel("Raw");
  if (deflection == channels_.size() || height == channels_.size())
    throw CurveError("it has no channel Defl, or neither ZSnsr nor Raw");
  if (channels_[height].unit != "m") throw CurveError("its heights are no lengths");
  const double newton = newton_per_unit(channels_[deflection], reading, curve.metadata);
  const Array z = array_of(set, height), force = array_of(set, deflection);
  const std::size_t points = std::min(z.size(), force.size());
  const std::vector<std::string> halves{"Ext", "Ret"};
  const std::vector<std::string>& segments = segments_.size() < 2 ? halves : segments_;
  for (std::size_t k = 0, begin = 0; k < segments.size(); ++k) {
    const bool last = k + 1 == segments.size();
    std::size_t end = last ? points : segments_.size() < 2 ? points / 2 : z.begins[k + 1];
    // a segment that was not recorded begins at 0, or beyond the points
    if (end < begin || end > points) end = points;
    const auto branch = ardf_branch(segments[k]);
    if (!branch) leave_ardf_out(segments[k], end - begin, curve);
    if (branch == physics::Branch::Approach && !curve.points.empty() &&
        curve.points.back().branch == physics::Branch::Retract)
      throw CurveError("its approach comes after its retract");
    for (std::size_t i = begin; branch && i < end; ++i) {
      const double z_m = -channels_[height].factor * z.at(i), force_n = newton * force.at(i);
      if (!std::isfinite(z_m) || !std::isfinite(force_n)) continue;
      curve.points.push_back({physics::Length(z_m), physics::Force(force_n), *branch});
    }
    begin = end;
  }
  if (volumes_ > 1) {
    curve.metadata.remarks.push_back(
        fmt::format("it has {} force maps, such as the way there and back: the first is read", volumes_));
  }
  if (!(step_x_m_ > 0.0 && step_y_m_ > 0.0)) return curve;
  const MapGrid grid{columns_, rows_, step_x_m_ * static_cast<double>(columns_), step_y_m_ * static_cast<double>(rows_),
                     0.0,      0.0};
  curve.metadata.pixel = MapPixel{grid, set.point, set.line};
  const auto at = [](std::uint64_t place, std::uint64_t count, double step_m) {
    return step_m * (static_cast<double>(place) + 0.5 - 0.5 * static_cast<double>(count));
  };
  curve.metadata.position = CurvePosition{at(set.point, columns_, step_x_m_), at(set.line, rows_, step_y_m_)};
  return curve;
}

}  // namespace afm::curves
