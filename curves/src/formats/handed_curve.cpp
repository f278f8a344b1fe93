// SPDX-License-Identifier: Apache-2.0
#include "formats/handed_curve.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "bytes/file_bytes.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

using physics::Branch;

// First byte, which no .tab has. Then follow the counts of points and of their times, the metadata in the order below,
// of each point height, force and perhaps time, and the branches of all points, a byte each.
constexpr char kHanded = '\x01';
constexpr char kRetracts = '\x01';

template <class Metadata, class OnNumber>
void each_number(Metadata& metadata, const OnNumber& on) {
  on("spring constant", metadata.spring_constant);
  on("sensitivity", metadata.sensitivity_m_per_v);
  on("speed approach", metadata.approach_speed);
  on("speed retract", metadata.retract_speed);
  on("setpoint", metadata.setpoint);
}

template <class Metadata, class OnText>
void each_text(Metadata& metadata, const OnText& on) {
  on(metadata.instrument);
  on(metadata.software);
  on(metadata.software_version);
  on(metadata.date);
  on(metadata.time);
  on(metadata.curve_id);
}

double si_of(double value) { return value; }
template <class Q>
double si_of(const Q& value) {
  return value.si;
}

class HandedOutput {
 public:
  explicit HandedOutput(std::size_t most) : bytes_(1, kHanded) { bytes_.reserve(most); }

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  void put_count(std::size_t count) { put(static_cast<std::uint64_t>(count)); }
  void put_text(std::string_view text) {
    put_count(text.size());
    bytes_ += text;
  }
  void put_byte(char byte) { bytes_.push_back(byte); }
  std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class HandedBytes {
 public:
  explicit HandedBytes(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T next() {
    T value{};
    const std::string_view bytes = take(sizeof(T));
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }
  std::size_t count(std::size_t most) {
    const auto count = next<std::uint64_t>();
    if (count > most) throw CurveError("it was handed over damaged");
    return count;
  }
  std::string_view text() { return take(count(rest_.size())); }
  std::string_view take(std::size_t size) {
    const std::string_view taken = part(rest_, 0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

void put_handed_metadata(const CurveMetadata& metadata, HandedOutput& to) {
  each_number(metadata, [&](const char*, const auto& number) {
    to.put_count(number ? 1 : 0);
    if (number) to.put(si_of(*number));
  });
  each_text(metadata, [&](const std::string& text) { to.put_text(text); });
  to.put_count(metadata.position ? 1 : 0);
  if (metadata.position) to.put(*metadata.position);
  to.put_count(metadata.pixel ? 1 : 0);
  if (metadata.pixel) to.put(*metadata.pixel);
  to.put_count(metadata.parameters.size());
  for (const auto& [key, value] : metadata.parameters) to.put_text(fmt::format("{}: {}", key, value));
  to.put_count(metadata.remarks.size());
  for (const std::string& remark : metadata.remarks) to.put_text(remark);
}

bool is_pixel(const MapPixel& pixel) {
  const MapGrid& grid = pixel.grid;
  const auto is_length = [](double value) { return std::isfinite(value) && value > 0.0; };
  return grid.columns <= kMostMapSide && grid.rows <= kMostMapSide && pixel.column < grid.columns &&
         pixel.row < grid.rows && is_length(grid.width_m) && is_length(grid.height_m) &&
         std::isfinite(grid.center_x_m) && std::isfinite(grid.center_y_m);
}

CurveMetadata read_handed_metadata(HandedBytes& from) {
  constexpr std::size_t kMostLines = 1000;
  CurveMetadata metadata;
  each_number(metadata, [&]<class Q>(const char* name, std::optional<Q>& number) {
    if (from.count(1) == 0) return;
    const auto si = from.next<double>();
    if (!std::isfinite(si)) throw CurveError(fmt::format("its metadata \"{}\" is not finite", name));
    number = Q(si);
  });
  each_text(metadata, [&](std::string& text) { text = from.text(); });
  if (from.count(1) == 1) {
    metadata.position = from.next<CurvePosition>();
    if (!std::isfinite(metadata.position->x_m) || !std::isfinite(metadata.position->y_m)) {
      throw CurveError("its metadata \"position\" is not finite");
    }
  }
  if (from.count(1) == 1) {
    metadata.pixel = from.next<MapPixel>();
    if (!is_pixel(*metadata.pixel)) throw CurveError("its metadata \"grid\" is no grid with a pixel");
  }
  for (std::size_t left = from.count(kMostLines); left > 0; --left) add_parameter(from.text(), metadata);
  for (std::size_t left = from.count(kMostRemarks); left > 0; --left) metadata.remarks.emplace_back(from.text());
  return metadata;
}

}  // namespace

std::string handed_bytes(const RecordedCurve& curve) {
  constexpr std::size_t kMostMetadata = 1024;  // limit of the number of entries
  const bool timed = !curve.time_s.empty();
  HandedOutput to(kMostMetadata + curve.points.size() * ((timed ? 3 : 2) * sizeof(double) + 1));
  to.put_count(curve.points.size());
  to.put_count(timed ? 1 : 0);
  put_handed_metadata(curve.metadata, to);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    // adding zero turns -0 into 0
    to.put(curve.points[i].z.si + 0.0);
    to.put(curve.points[i].force.si + 0.0);
    if (timed) to.put(curve.time_s[i]);
  }
  for (const physics::CurvePoint& point : curve.points)
    to.put_byte(point.branch == Branch::Approach ? '\0' : kRetracts);
  return std::move(to).bytes();
}

RecordedCurve read_handed(std::string_view bytes) {
  if (!bytes.starts_with(kHanded)) throw CurveError("it was handed over damaged");
  HandedBytes from(bytes.substr(1));
  const std::size_t count = from.count(kMostCurvePoints);
  const bool timed = from.count(1) == 1;
  RecordedCurve curve;
  curve.metadata = read_handed_metadata(from);
  const std::size_t numbers = timed ? 3 : 2;
  if (from.left() != count * (numbers * sizeof(double) + 1)) throw CurveError("it was handed over incompletely");
  HandedBytes rows(from.take(count * numbers * sizeof(double)));
  curve.points.reserve(count);
  curve.time_s.reserve(timed ? count : 0);
  for (const char branch : from.take(count)) {
    const auto z_m = rows.next<double>(), force_n = rows.next<double>();
    curve.points.push_back(
        {physics::Length(z_m), physics::Force(force_n), branch == kRetracts ? Branch::Retract : Branch::Approach});
    if (timed) curve.time_s.push_back(rows.next<double>());
  }
  return curve;
}

}  // namespace afm::curves
