// SPDX-License-Identifier: Apache-2.0
#include "images/nanoscope_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bytes/file_bytes.h"
#include "bytes/nanoscope_header.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "formats/nanoscope_scan.h"

namespace afm::curves {

namespace {

constexpr std::string_view kImageBlock = "Ciao image list";

// Name of a channel: Height Sensor of "S [Height] \"Height Sensor\""; a retrace is marked.
std::string nanoscope_name(const NanoscopeBlock& image) {
  std::string name = "Image";
  if (const std::string_view* data = image.find("@2:image data")) {
    const std::size_t open = data->find('"'), close = data->rfind('"');
    if (open != std::string_view::npos && close > open) name = data->substr(open + 1, close - open - 1);
  }
  const std::string_view* direction = image.find("line direction");
  return direction != nullptr && *direction == "Retrace" ? name + " (retrace)" : name;
}

// Lines with data, in the order of the file.
struct Captured {
  std::size_t first = 0, count = 0;
};

// All lines if the header does not say otherwise. A scan that was stopped has fewer.
Captured captured_lines(const NanoscopeBlock& image, const NanoscopePoints& points) {
  const auto whole_number = [&](const char* key) {
    return image.find(key) != nullptr ? std::max(0.0, std::floor(nanoscope_number(image, key))) : 0.0;
  };
  const auto rows = static_cast<double>(points.rows);
  const double count = whole_number("valid data len y"), first = whole_number("valid data start y");
  if (count < 1.0 || count >= rows || first + count > rows) return {0, points.rows};
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(count)};
}

// Bytes of the captured lines; a file may contain only these.
std::string_view data_of(std::string_view bytes, const NanoscopeBlock& image, const NanoscopePoints& points,
                         std::size_t number_size, const Captured& captured) {
  const double length = nanoscope_number(image, "data length");
  const std::size_t line = points.columns * number_size, whole = points.rows * line;
  const bool alone = length == static_cast<double>(captured.count * line);
  if (!alone && length != static_cast<double>(whole)) {
    throw CurveError(
        fmt::format("its data have {:g} bytes; {} x {} points take {}", length, points.columns, points.rows, whole));
  }
  const std::string_view data = part(bytes, nanoscope_data_offset(image, bytes), static_cast<std::size_t>(length));
  return part(data, alone ? 0 : captured.first * line, captured.count * line);
}

// Bytes behind the data of an image that no block of the header has.
std::size_t bytes_behind(std::string_view bytes, const NanoscopeBlock& image,
                         const std::vector<NanoscopeBlock>& blocks) {
  const auto end = static_cast<double>(nanoscope_data_offset(image, bytes)) + nanoscope_number(image, "data length");
  auto next = static_cast<double>(bytes.size());
  for (const NanoscopeBlock& block : blocks) {
    if (block.find("data offset") == nullptr) continue;
    const double offset = nanoscope_number(block, "data offset");
    if (offset >= end) next = std::min(next, offset);
  }
  return next > end ? static_cast<std::size_t>(next - end) : 0;
}

ImagePage nanoscope_page(std::string_view bytes, const NanoscopeBlock& image, const std::vector<NanoscopeBlock>& blocks,
                         ImagePages& found) {
  const NanoscopeIntegers integers = nanoscope_integers(image, blocks);
  const NanoscopePoints points{image_side(nanoscope_number(image, "samps/line")),
                               image_side(nanoscope_number(image, "number of lines"))};
  const Captured captured = captured_lines(image, points);
  const std::string_view data = data_of(bytes, image, points, integers.size, captured);
  const NanoscopeScale scale = nanoscope_scale(image, blocks);
  if (!scale.missing.empty()) {
    found.remark(
        fmt::format("its channel {} names the sensitivity \"{}\", which its header lacks: its values are in {}",
                    nanoscope_name(image), scale.missing.substr(0, 40), scale.unit.empty() ? "no unit" : scale.unit));
  }
  const NanoscopeArea area =
      nanoscope_area(image, blocks, points, [&](const std::string& sentence) { found.remark(sentence); });
  if (captured.count < points.rows) {
    found.remark(
        fmt::format("{} of {} lines were captured; the others count as not measured", captured.count, points.rows));
  }
  if (const std::size_t behind = bytes_behind(bytes, image, blocks); behind >= data.size() && !data.empty()) {
    found.remark(fmt::format(
        "behind the {} x {} points of {} lie {} bytes that the header does not mention: does it have all points?",
        points.columns, points.rows, nanoscope_name(image), behind));
  }
  const double factor = scale.factor / integers.divisor;
  return {.name = nanoscope_name(image),
          .unit = scale.unit,
          .columns = points.columns,
          .rows = points.rows,
          .width_m = image_length_m(area.width_m),
          .height_m = image_length_m(area.height_m),
          .values = [=, first = captured.first * points.columns, count = captured.count * points.columns] {
            return grid_values(points.columns, points.rows, true, [=](std::size_t i) {
              const bool measured = i >= first && i - first < count;
              return measured ? factor * nanoscope_integer(data, i - first, integers.size)
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
  if (found.pages.empty() && !nanoscope_header_ends(bytes)) throw CutShort(kNoHeaderEnd);
  return found;
}

}  // namespace afm::curves
