// SPDX-License-Identifier: Apache-2.0
#include "images/nanoscope_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "bytes/file_bytes.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "formats/nanoscope_header.h"

namespace afm::curves {

namespace {

constexpr std::uint32_t kFourBytesFrom = 0x09200000;
constexpr std::string_view kImageBlock = "Ciao image list";
constexpr double kSquarePixelTolerance = 0.02;

struct ValueScale {
  double factor = 1.0;  // per integer divided by 256^(Bytes/pixel)
  std::string unit;
};

ValueScale value_scale(const NanoscopeBlock& image, const std::vector<NanoscopeBlock>& blocks) {
  const auto hard = hard_scale(image.find("@2:z scale"));
  if (!hard) throw CurveError("it has no \"@2:Z scale\"");
  if (!hard->value) throw CurveError("its \"@2:Z scale\" has no number");
  const ScaledUnit hard_unit = scaled_unit(hard->unit);
  const auto soft = hard->soft_name.empty() ? std::nullopt : soft_scale(blocks, hard->soft_name, hard->unit);
  if (!soft) return {*hard->value * hard_unit.factor, hard_unit.unit};
  return {*hard->value * hard_unit.factor * soft->factor, soft->unit.empty() ? hard_unit.unit : soft->unit};
}

struct ScanSize {
  double width_m = 0, height_m = 0;
};

// "1000 1000 nm", or one number for both.
std::optional<ScanSize> scan_size(const NanoscopeBlock& block) {
  const std::string_view* text = block.find("scan size");
  if (text == nullptr) return std::nullopt;
  std::string_view rest = *text;
  const auto width = take_number(rest);
  if (!width) return std::nullopt;
  const auto height = take_number(rest);
  const ScaledUnit unit = scaled_unit(rest);
  if (unit.unit != "m") throw CurveError(fmt::format("its scan size is in \"{}\", not in a length", trimmed(rest)));
  return ScanSize{*width * unit.factor, height.value_or(*width) * unit.factor};
}

// "S [Height] \"Height Sensor\"" becomes Height Sensor; a retrace is marked.
std::string nanoscope_name(const NanoscopeBlock& image) {
  std::string name = "Image";
  if (const std::string_view* data = image.find("@2:image data")) {
    const std::size_t open = data->find('"'), close = data->rfind('"');
    if (open != std::string_view::npos && close > open) name = data->substr(open + 1, close - open - 1);
  }
  const std::string_view* direction = image.find("line direction");
  return direction != nullptr && *direction == "Retrace" ? name + " (retrace)" : name;
}

template <class Integer>
double nanoscope_integer(std::string_view data, std::size_t index) {
  return static_cast<double>(number_at<Integer>(data, index * sizeof(Integer)));
}

double nanoscope_integer(std::string_view data, std::size_t index, std::size_t size) {
  if (size == sizeof(std::int8_t)) return nanoscope_integer<std::int8_t>(data, index);
  if (size == sizeof(std::int16_t)) return nanoscope_integer<std::int16_t>(data, index);
  return nanoscope_integer<std::int32_t>(data, index);
}

struct Points {
  std::size_t columns = 0, rows = 0;
};

// The lines that have data, in the order of the file.
struct Captured {
  std::size_t first = 0, count = 0;
};

// All lines if the header does not say otherwise. A scan that was stopped has fewer.
Captured captured_lines(const NanoscopeBlock& image, const Points& points) {
  const auto whole_number = [&](const char* key) {
    return image.find(key) != nullptr ? std::max(0.0, std::floor(nanoscope_number(image, key))) : 0.0;
  };
  const auto rows = static_cast<double>(points.rows);
  const double count = whole_number("valid data len y"), first = whole_number("valid data start y");
  if (count < 1.0 || count >= rows || first + count > rows) return {0, points.rows};
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(count)};
}

// The bytes of the captured lines, which a file may have alone.
std::string_view data_of(std::string_view bytes, const NanoscopeBlock& image, const Points& points,
                         std::size_t number_size, const Captured& captured) {
  const double offset = nanoscope_number(image, "data offset"), length = nanoscope_number(image, "data length");
  const std::size_t line = points.columns * number_size, whole = points.rows * line;
  const bool alone = length == static_cast<double>(captured.count * line);
  if (!alone && length != static_cast<double>(whole)) {
    throw CurveError(
        fmt::format("its data have {:g} bytes; {} x {} points take {}", length, points.columns, points.rows, whole));
  }
  if (!(offset >= 0.0 && offset <= static_cast<double>(bytes.size()))) throw CutShort("it is cut short");
  const std::string_view data = part(bytes, static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
  return part(data, alone ? 0 : captured.first * line, captured.count * line);
}

// "2:1", width to height; 1 without it.
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

bool has_square_pixels(const ScanSize& area, const Points& points) {
  const double ratio =
      area.width_m / area.height_m * static_cast<double>(points.rows) / static_cast<double>(points.columns);
  return std::abs(ratio - 1.0) < kSquarePixelTolerance;
}

// The lines of the scan of which an image has `points`; these if the scan list does not tell, or for other points.
double lines_of_scan(const NanoscopeBlock& list, const Points& points) {
  const auto rows = static_cast<double>(points.rows), columns = static_cast<double>(points.columns);
  if (list.find("lines") == nullptr) return rows;
  const double samples = list.find("samps/line") != nullptr ? nanoscope_number(list, "samps/line") : columns;
  return samples == columns ? std::max(rows, nanoscope_number(list, "lines")) : rows;
}

// The area of an image. The header of a scan that was stopped may keep the size of the whole: its lines, or an aspect
// ratio, tell which part of the height the image has.
ScanSize area_of(const NanoscopeBlock& image, const std::vector<NanoscopeBlock>& blocks, const Points& points,
                 ImagePages& found) {
  auto area = scan_size(image);
  for (std::size_t i = 0; i < blocks.size() && !area; ++i) area = scan_size(blocks[i]);
  if (!area) throw CurveError("it has no \"Scan Size\"");
  const bool square = area->width_m == area->height_m;
  const auto list = std::find_if(blocks.begin(), blocks.end(),
                                 [](const NanoscopeBlock& block) { return lower_key(block.name) == "ciao scan list"; });
  if (list != blocks.end()) {
    const double lines = lines_of_scan(*list, points), share = static_cast<double>(points.rows) / lines;
    const ScanSize part_of_it{area->width_m, area->height_m * share};
    if (share < 1.0 && (square || (!has_square_pixels(*area, points) && has_square_pixels(part_of_it, points)))) {
      found.remark(fmt::format("{} of {:g} lines were captured: the image is as much lower than its header says",
                               points.rows, lines));
      return part_of_it;
    }
    for (const double aspect : {aspect_ratio(image), aspect_ratio(*list)}) {
      const ScanSize flat{area->width_m, area->width_m / aspect};
      if (!square || aspect == 1.0 || !has_square_pixels(flat, points)) continue;
      found.remark(
          fmt::format("its header says that it is as high as wide, and that its aspect ratio is {:g}: the "
                      "ratio is taken, with which its pixels are square",
                      aspect));
      return flat;
    }
  }
  if (square && !has_square_pixels(*area, points)) {
    found.remark(fmt::format("its header says that {} x {} points are as high as wide: its pixels are not square",
                             points.columns, points.rows));
  }
  return *area;
}

ImagePage nanoscope_page(std::string_view bytes, const NanoscopeBlock& image, const std::vector<NanoscopeBlock>& blocks,
                         ImagePages& found) {
  const double bytes_per_pixel = image.find("bytes/pixel") != nullptr ? nanoscope_number(image, "bytes/pixel") : 2.0;
  if (bytes_per_pixel != 1.0 && bytes_per_pixel != 2.0 && bytes_per_pixel != 4.0) {
    throw CurveError(fmt::format("its images have {:g} bytes a pixel; 1, 2 and 4 are read", bytes_per_pixel));
  }
  const std::size_t size = nanoscope_version(blocks) >= kFourBytesFrom ? 4 : static_cast<std::size_t>(bytes_per_pixel);
  const Points points{image_side(nanoscope_number(image, "samps/line")),
                      image_side(nanoscope_number(image, "number of lines"))};
  const Captured captured = captured_lines(image, points);
  const std::string_view data = data_of(bytes, image, points, size, captured);
  const ValueScale scale = value_scale(image, blocks);
  const ScanSize area = area_of(image, blocks, points, found);
  if (captured.count < points.rows) {
    found.remark(
        fmt::format("{} of {} lines were captured; the others count as not measured", captured.count, points.rows));
  }
  const double factor = scale.factor / std::pow(256.0, bytes_per_pixel);
  return {.name = nanoscope_name(image),
          .unit = scale.unit,
          .columns = points.columns,
          .rows = points.rows,
          .width_m = image_length_m(area.width_m),
          .height_m = image_length_m(area.height_m),
          .values = [=, first = captured.first * points.columns, count = captured.count * points.columns] {
            return grid_values(points.columns, points.rows, true, [=](std::size_t i) {
              const bool measured = i >= first && i - first < count;
              return measured ? factor * nanoscope_integer(data, i - first, size)
                              : std::numeric_limits<double>::quiet_NaN();
            });
          }};
}

}  // namespace

ImagePages read_nanoscope(std::string_view bytes) {
  const std::vector<NanoscopeBlock> blocks = nanoscope_blocks(bytes);
  ImagePages found;
  for (const NanoscopeBlock& block : blocks) {
    if (block.name == kImageBlock) {
      add_page(nanoscope_name(block), found, [&] { return nanoscope_page(bytes, block, blocks, found); });
      continue;
    }
    for (const auto& [key, value] : block.values) {
      if (found.metadata.size() < kMostImageMetadata) found.metadata.emplace_back(key, value);
    }
  }
  return found;
}

}  // namespace afm::curves
