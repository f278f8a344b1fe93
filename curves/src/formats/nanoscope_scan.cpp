// SPDX-License-Identifier: Apache-2.0
#include "formats/nanoscope_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bytes/file_bytes.h"
#include "bytes/scaled_unit.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

using Blocks = std::vector<NanoscopeBlock>;

constexpr std::uint32_t kFourBytesFrom = 0x09200000;
constexpr double kSquarePixelTolerance = 0.02;

// Block of that name; null if there is none.
const NanoscopeBlock* block_named(const Blocks& blocks, std::string_view name) {
  const auto found = std::find_if(blocks.begin(), blocks.end(),
                                  [&](const NanoscopeBlock& block) { return lower_key(block.name) == name; });
  return found != blocks.end() ? &*found : nullptr;
}

// Size in "1000 1000 nm", or one number for both sides.
std::optional<NanoscopeArea> scan_size(const NanoscopeBlock& block) {
  const std::string_view* text = block.find("scan size");
  if (text == nullptr) return std::nullopt;
  std::string_view rest = *text;
  const auto width = take_number(rest);
  if (!width) return std::nullopt;
  const auto height = take_number(rest);
  const ScaledUnit unit = scaled_unit(rest);
  if (unit.unit != "m") throw CurveError(fmt::format("its scan size is in \"{}\", not in a length", trimmed(rest)));
  return NanoscopeArea{*width * unit.factor, height.value_or(*width) * unit.factor};
}

// Ratio of width to height, as "2:1"; 1 if it is missing.
double aspect_ratio(const NanoscopeBlock& block) {
  const std::string_view* text = block.find("aspect ratio");
  if (text == nullptr) return 1.0;
  std::string_view rest = *text;
  const auto width = take_number(rest);
  if (!rest.starts_with(':')) return 1.0;
  rest.remove_prefix(1);
  const auto height = take_number(rest);
  return width && height && *width > 0.0 && *height > 0.0 ? *width / *height : 1.0;
}

bool has_square_pixels(const NanoscopeArea& area, const NanoscopePoints& points) {
  const double ratio =
      area.width_m / area.height_m * static_cast<double>(points.rows) / static_cast<double>(points.columns);
  return std::abs(ratio - 1.0) < kSquarePixelTolerance;
}

// Number of lines in the scan of which an image has `points`; those of the image if the scan list has no matching ones.
double lines_of_scan(const NanoscopeBlock& list, const NanoscopePoints& points) {
  const auto rows = static_cast<double>(points.rows), columns = static_cast<double>(points.columns);
  if (list.find("lines") == nullptr) return rows;
  const double samples = list.find("samps/line") != nullptr ? nanoscope_number(list, "samps/line") : columns;
  return samples == columns ? std::max(rows, nanoscope_number(list, "lines")) : rows;
}

// Number of curves or points along a side.
std::size_t side_in(const NanoscopeBlock& block, const char* key) {
  const double count = nanoscope_number(block, key);
  if (!(count >= 1.0 && count <= static_cast<double>(kMostMapSide)) || count != std::floor(count)) {
    throw CurveError(fmt::format("its \"{}\" is {:g}; 1 to {} are read", key, count, kMostMapSide));
  }
  return static_cast<std::size_t>(count);
}

// Offset in metres, as "-250 nm"; 0 if it is missing.
double offset_m(const NanoscopeBlock& list, const char* key) {
  const std::string_view* text = list.find(key);
  if (text == nullptr) return 0.0;
  std::string_view rest = *text;
  const auto number = take_number(rest);
  const ScaledUnit unit = scaled_unit(rest);
  return number && unit.unit == "m" ? *number * unit.factor : 0.0;
}

bool is_height(const NanoscopeBlock& image) {
  const std::string name = lower_key(nanoscope_channel(image));
  return name.starts_with("height") || name.starts_with("z");
}

// Values of the image in metres, line by line from the bottom.
std::vector<double> heights_of(std::string_view bytes, const NanoscopeBlock& image, const Blocks& blocks,
                               const NanoscopePoints& points) {
  const NanoscopeScale scale = nanoscope_scale(image, blocks);
  if (scale.unit != "m") throw CurveError(fmt::format("it is in \"{}\"", scale.unit.substr(0, 40)));
  const NanoscopeIntegers integers = nanoscope_integers(image, blocks);
  const std::size_t count = points.columns * points.rows, size = count * integers.size;
  const double length = nanoscope_number(image, "data length");
  if (length != static_cast<double>(size)) {
    throw CurveError(
        fmt::format("its data have {:g} bytes; {} x {} points take {}", length, points.columns, points.rows, size));
  }
  const std::string_view data = part(bytes, nanoscope_data_offset(image, bytes), size);
  std::vector<double> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(scale.factor / integers.divisor * nanoscope_integer(data, i, integers.size));
  }
  return values;
}

// Reads the grid of the curves from the header of the image.
void read_grid(std::string_view bytes, const NanoscopeBlock& image, const Blocks& blocks, NanoscopeVolume& volume) {
  const NanoscopePoints points{side_in(image, "samps/line"), side_in(image, "number of lines")};
  volume.points = points;
  if (volume.columns == 0) volume.columns = points.columns;
  volume.rows = std::clamp<std::size_t>(points.rows * volume.columns / points.columns, 1, kMostMapSide);
  const NanoscopeArea area =
      nanoscope_area(image, blocks, points, [&](const std::string& sentence) { volume.remarks.push_back(sentence); });
  if (!(area.width_m > 0.0 && area.height_m > 0.0 && area.width_m <= 1.0 && area.height_m <= 1.0)) {
    throw CurveError(fmt::format("its scan size is {:g} m x {:g} m", area.width_m, area.height_m));
  }
  volume.grid = MapGrid{volume.columns, volume.rows, area.width_m, area.height_m, 0.0, 0.0};
  if (const NanoscopeBlock* list = block_named(blocks, "ciao scan list")) {
    volume.grid->center_x_m = offset_m(*list, "x offset");
    volume.grid->center_y_m = offset_m(*list, "y offset");
    volume.turn_deg = list->find("rotate ang.") != nullptr ? nanoscope_number(*list, "rotate ang.") : 0.0;
  }
  volume.image_m = heights_of(bytes, image, blocks, points);
}

}  // namespace

NanoscopeArea nanoscope_area(const NanoscopeBlock& image, const Blocks& blocks, const NanoscopePoints& points,
                             const TakeRemark& remark) {
  auto area = scan_size(image);
  for (std::size_t i = 0; i < blocks.size() && !area; ++i) area = scan_size(blocks[i]);
  if (!area) throw CurveError("it has no \"Scan Size\"");
  const bool square = area->width_m == area->height_m;
  if (const NanoscopeBlock* list = block_named(blocks, "ciao scan list")) {
    const double lines = lines_of_scan(*list, points), share = static_cast<double>(points.rows) / lines;
    const NanoscopeArea part_of_it{area->width_m, area->height_m * share};
    if (share < 1.0 && (square || (!has_square_pixels(*area, points) && has_square_pixels(part_of_it, points)))) {
      remark(fmt::format("{} of {:g} lines were captured: the image is as much lower than its header says", points.rows,
                         lines));
      return part_of_it;
    }
    for (const double aspect : {aspect_ratio(image), aspect_ratio(*list)}) {
      const NanoscopeArea flat{area->width_m, area->width_m / aspect};
      if (!square || aspect == 1.0 || !has_square_pixels(flat, points)) continue;
      remark(
          fmt::format("its header says that it is as high as wide, and that its aspect ratio is {:g}: the "
                      "ratio is taken, with which its pixels are square",
                      aspect));
      return flat;
    }
  }
  if (square && !has_square_pixels(*area, points)) {
    remark(fmt::format("its header says that {} x {} points are as high as wide: its pixels are not square",
                       points.columns, points.rows));
  }
  return *area;
}

NanoscopeScale nanoscope_scale(const NanoscopeBlock& image, const Blocks& blocks) {
  const auto hard = hard_scale(image.find("@2:z scale"));
  if (!hard) throw CurveError("it has no \"@2:Z scale\"");
  if (!hard->value) throw CurveError("its \"@2:Z scale\" has no number");
  const ScaledUnit hard_unit = scaled_unit(hard->unit);
  const auto soft = hard->soft_name.empty() ? std::nullopt : soft_scale(blocks, hard->soft_name, hard->unit);
  if (!soft) return {*hard->value * hard_unit.factor, hard_unit.unit, std::string(hard->soft_name)};
  if (soft->factor == 0.0) {
    throw CurveError(fmt::format("its \"{}\" is 0, so that its values are unknown", hard->soft_name.substr(0, 40)));
  }
  return {*hard->value * hard_unit.factor * soft->factor, soft->unit.empty() ? hard_unit.unit : soft->unit, ""};
}

NanoscopeIntegers nanoscope_integers(const NanoscopeBlock& channel, const Blocks& blocks) {
  const double bytes = channel.find("bytes/pixel") != nullptr ? nanoscope_number(channel, "bytes/pixel") : 2.0;
  if (bytes != 1.0 && bytes != 2.0 && bytes != 4.0) {
    throw CurveError(fmt::format("its images have {:g} bytes a pixel; 1, 2 and 4 are read", bytes));
  }
  return {nanoscope_version(blocks) >= kFourBytesFrom ? 4 : static_cast<std::size_t>(bytes), std::pow(256.0, bytes)};
}

double nanoscope_integer(std::string_view data, std::size_t index, std::size_t size) {
  if (size == sizeof(std::int8_t)) return number_at<std::int8_t>(data, index);
  if (size == sizeof(std::int16_t)) return number_at<std::int16_t>(data, index * size);
  return number_at<std::int32_t>(data, index * size);
}

double NanoscopeVolume::surface_m(std::size_t curve) const {
  if (image_m.empty()) return 0.0;
  const std::size_t column = curve % columns, row = curve / columns;
  return image_m[row * points.rows / rows * points.columns + column * points.columns / columns];
}

std::optional<NanoscopeVolume> nanoscope_volume(std::string_view bytes, const Blocks& blocks) {
  const NanoscopeBlock* image = nullptr;  // height image, or else the first one
  for (const NanoscopeBlock& block : blocks) {
    if (lower_key(block.name) != "ciao image list") continue;
    if (image == nullptr || (!is_height(*image) && is_height(block))) image = &block;
  }
  if (image == nullptr) return std::nullopt;
  NanoscopeVolume volume;
  const NanoscopeBlock* list = block_named(blocks, "ciao force list");
  if (list != nullptr && list->find("force/line") != nullptr) volume.columns = side_in(*list, "force/line");
  try {
    read_grid(bytes, *image, blocks, volume);
  } catch (const CurveError& fault) {
    volume.image_is_cut = dynamic_cast<const CutShort*>(&fault) != nullptr;
    volume.remarks.push_back(
        fmt::format("its image {} cannot be read, so that {} unknown: {}", nanoscope_channel(*image).substr(0, 40),
                    volume.grid ? "the heights of its curves are" : "the grid of its curves is", fault.what()));
  }
  return volume;
}

}  // namespace afm::curves
