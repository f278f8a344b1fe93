// SPDX-License-Identifier: Apache-2.0
#include "images/gsf_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "bytes/file_bytes.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kGsfAlignment = 4;
constexpr std::size_t kMostGsfHeaderBytes = std::size_t{1} << 20U;

struct GsfHeader {
  double columns = 0, rows = 0;
  std::optional<double> width, height;  // size in xy_unit
  double x_offset = 0, y_offset = 0;    // offsets in xy_unit
  ScaledUnit xy_unit, z_unit;
  std::string title = "Height";
};

// Returns false for an unknown name.
bool set_field(std::string_view name, std::string_view value, const Lines& lines, GsfHeader& header) {
  constexpr std::pair<std::string_view, double GsfHeader::*> kNumbers[]{{"XRes", &GsfHeader::columns},
                                                                        {"YRes", &GsfHeader::rows},
                                                                        {"XOffset", &GsfHeader::x_offset},
                                                                        {"YOffset", &GsfHeader::y_offset}};
  for (const auto& [known, field] : kNumbers) {
    if (name != known) continue;
    header.*field = number_in(value, name, lines);
    return true;
  }
  if (name == "XReal" || name == "YReal") {
    (name == "XReal" ? header.width : header.height) = number_in(value, name, lines);
  } else if (name == "XYUnits") {
    header.xy_unit = scaled_unit(value);
  } else if (name == "ZUnits") {
    header.z_unit = scaled_unit(value);
  } else if (name == "Title") {
    header.title = value;
  } else {
    return false;
  }
  return true;
}

}  // namespace

ImagePages read_gsf(std::string_view bytes) {
  const std::size_t end = bytes.substr(0, kMostGsfHeaderBytes).find('\0');
  if (end == std::string_view::npos) throw CutShort("the text at its beginning has no end");
  GsfHeader header;
  ImagePages found;
  std::string_view line;
  Lines lines(bytes.substr(0, end));
  lines.next(line);  // the line with the magic word
  while (lines.next(line)) {
    const std::size_t equals = line.find('=');
    if (trimmed(line).empty()) continue;
    if (equals == std::string_view::npos) {
      throw CurveError(fmt::format("line {}: \"{}\" is no \"name = value\"", lines.number(), line.substr(0, 40)));
    }
    const std::string_view name = trimmed(line.substr(0, equals)), value = trimmed(line.substr(equals + 1));
    if (!set_field(name, value, lines, header)) found.metadata.emplace_back(name, value);
  }
  if (header.columns == 0 || header.rows == 0) throw CurveError("it has no XRes or no YRes");
  const std::size_t columns = image_side(header.columns), rows = image_side(header.rows);
  const std::size_t data = (end / kGsfAlignment + 1) * kGsfAlignment;
  const std::string_view padding = part(bytes, end, data - end);
  if (padding.find_first_not_of('\0') != std::string_view::npos) {
    throw CurveError("its data do not begin at a multiple of 4 bytes");
  }
  const std::string_view numbers = part(bytes, data, columns * rows * sizeof(float));
  if (data + numbers.size() != bytes.size()) throw CurveError("it is longer than its XRes and YRes say");
  found.remark_if_without(header.xy_unit);
  constexpr double kUnknownSide = 1.0;  // default of the format
  if (!header.width || !header.height) {
    found.remark(fmt::format("it does not name {}, which is taken as {:g} m: set its size in the program that wrote it",
                             header.width    ? "its height (YReal)"
                             : header.height ? "its width (XReal)"
                                             : "its size (XReal, YReal)",
                             kUnknownSide * header.xy_unit.factor));
  }
  const double z = header.z_unit.factor;
  found.pages.push_back({.name = header.title,
                         .unit = header.z_unit.unit,
                         .columns = columns,
                         .rows = rows,
                         .width_m = image_length_m(header.width.value_or(kUnknownSide), header.xy_unit),
                         .height_m = image_length_m(header.height.value_or(kUnknownSide), header.xy_unit),
                         .x_offset_m = header.x_offset * header.xy_unit.factor,
                         .y_offset_m = header.y_offset * header.xy_unit.factor,
                         .values = [=] {
                           return grid_values(columns, rows, false, [=](std::size_t i) {
                             return z * static_cast<double>(number_at<float>(numbers, i * sizeof(float)));
                           });
                         }});
  return found;
}

}  // namespace afm::curves
