// SPDX-License-Identifier: Apache-2.0
#include "images/nanoscope_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "curves/curve_error.h"
#include "formats/file_bytes.h"
#include "formats/text_table.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostHeaderBytes = std::size_t{4} << 20U;
constexpr std::uint32_t kFourBytesFrom = 0x09200000;
constexpr std::string_view kImageBlock = "Ciao image list";

std::string lower_key(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

struct Block {
  std::string_view name;                           // "Ciao image list"
  std::map<std::string, std::string_view> values;  // keys in lower case, "@2:z scale"

  const std::string_view* find(const std::string& key) const {
    const auto found = values.find(key);
    return found != values.end() ? &found->second : nullptr;
  }
};

// "\key: value"; the colon in "@2:Z scale" belongs to the key.
void add_line(std::string_view line, Block& block) {
  const bool counted =
      line.size() > 2 && line[0] == '@' && std::isdigit(static_cast<unsigned char>(line[1])) != 0 && line[2] == ':';
  const std::size_t colon = line.find(':', counted ? 3 : 0);
  if (colon == std::string_view::npos) return;
  block.values.emplace(lower_key(trimmed(line.substr(0, colon))), trimmed(line.substr(colon + 1)));
}

std::vector<Block> blocks_of(std::string_view header) {
  std::vector<Block> blocks;
  std::string_view line;
  for (Lines lines(header); lines.next(line);) {
    if (line == "\\*File list end") break;
    if (line.starts_with("\\*")) {
      blocks.push_back({trimmed(line.substr(2)), {}});
    } else if (line.starts_with('\\') && !blocks.empty()) {
      add_line(line.substr(1), blocks.back());
    }
  }
  return blocks;
}

// Takes the number at the front of the text.
std::optional<double> take_number(std::string_view& text) {
  text = trimmed(text);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

double nanoscope_number(const Block& block, const std::string& key) {
  const std::string_view* text = block.find(key);
  if (text == nullptr) throw CurveError(fmt::format("an image in it has no \"{}\"", key));
  std::string_view rest = *text;
  const auto number = take_number(rest);
  if (!number) throw CurveError(fmt::format("\"{}\" of an image in it is no number", key));
  return *number;
}

// Takes the text between the two characters, with all before it; empty if they do not come next.
std::string_view take_between(char open, char close, std::string_view& text) {
  text = trimmed(text);
  const std::size_t end = text.find(close);
  if (!text.starts_with(open) || end == std::string_view::npos) return {};
  const std::string_view inside = text.substr(1, end - 1);
  text.remove_prefix(end + 1);
  return inside;
}

struct SoftScale {
  double factor = 1.0;
  std::string unit;
};

// "V 12.5 nm/V" of "@Sens. Zsens", from any block.
std::optional<SoftScale> soft_scale(const std::vector<Block>& blocks, std::string_view name) {
  const std::string key = "@" + lower_key(name);
  for (const Block& block : blocks) {
    const std::string_view* text = block.find(key);
    if (text == nullptr || !text->starts_with('V')) continue;
    std::string_view rest = text->substr(1);
    const auto number = take_number(rest);
    if (!number) continue;
    rest = trimmed(rest);
    if (rest.ends_with("/V")) rest.remove_suffix(2);
    const ScaledUnit unit = scaled_unit(rest);
    return SoftScale{*number * unit.factor, unit.unit};
  }
  return std::nullopt;
}

struct ValueScale {
  double factor = 1.0;  // per integer divided by 256^(Bytes/pixel)
  std::string unit;
};

ValueScale value_scale(const Block& image, const std::vector<Block>& blocks) {
  const std::string_view* text = image.find("@2:z scale");
  if (text == nullptr || !text->starts_with('V')) throw CurveError("an image in it has no \"@2:Z scale\"");
  std::string_view rest = text->substr(1);
  const std::string_view soft_name = take_between('[', ']', rest);
  take_between('(', ')', rest);
  const auto hard = take_number(rest);
  if (!hard) throw CurveError("\"@2:Z scale\" of an image in it has no number");
  const ScaledUnit hard_unit = scaled_unit(rest);
  const auto soft = soft_name.empty() ? std::nullopt : soft_scale(blocks, soft_name);
  if (!soft) return {*hard * hard_unit.factor, hard_unit.unit};
  return {*hard * soft->factor, soft->unit.empty() ? hard_unit.unit : soft->unit};
}

struct ScanSize {
  double width_m = 0, height_m = 0;
};

// "1000 1000 nm", or one number for both.
std::optional<ScanSize> scan_size(const Block& block) {
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
std::string nanoscope_name(const Block& image) {
  std::string name = "Image";
  if (const std::string_view* data = image.find("@2:image data")) {
    const std::size_t open = data->find('"'), close = data->rfind('"');
    if (open != std::string_view::npos && close > open) name = data->substr(open + 1, close - open - 1);
  }
  const std::string_view* direction = image.find("line direction");
  return direction != nullptr && *direction == "Retrace" ? name + " (retrace)" : name;
}

std::uint32_t nanoscope_version(const std::vector<Block>& blocks) {
  for (const Block& block : blocks) {
    const std::string_view* text = block.find("version");
    if (text == nullptr) continue;
    std::string_view digits = *text;
    if (digits.starts_with("0x") || digits.starts_with("0X")) digits.remove_prefix(2);
    std::uint32_t version = 0;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), version, 16).ec == std::errc()) return version;
  }
  return 0;
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

ImagePage nanoscope_page(std::string_view bytes, const Block& image, const std::vector<Block>& blocks) {
  const double bytes_per_pixel = image.find("bytes/pixel") != nullptr ? nanoscope_number(image, "bytes/pixel") : 2.0;
  if (bytes_per_pixel != 1.0 && bytes_per_pixel != 2.0 && bytes_per_pixel != 4.0) {
    throw CurveError(fmt::format("its images have {:g} bytes a pixel; 1, 2 and 4 are read", bytes_per_pixel));
  }
  const std::size_t size = nanoscope_version(blocks) >= kFourBytesFrom ? 4 : static_cast<std::size_t>(bytes_per_pixel);
  const std::size_t columns = image_side(nanoscope_number(image, "samps/line")),
                    rows = image_side(nanoscope_number(image, "number of lines"));
  const double offset = nanoscope_number(image, "data offset");
  if (!(offset >= 0.0 && offset <= static_cast<double>(bytes.size()))) throw CurveError("it is cut short");
  const double length = nanoscope_number(image, "data length");
  if (length != static_cast<double>(columns * rows * size)) {
    throw CurveError(fmt::format("the data of an image have {:g} bytes; {} x {} points take {}", length, columns, rows,
                                 columns * rows * size));
  }
  const std::string_view data = part(bytes, static_cast<std::size_t>(offset), columns * rows * size);

  auto area = scan_size(image);
  for (std::size_t i = 0; i < blocks.size() && !area; ++i) area = scan_size(blocks[i]);
  if (!area) throw CurveError("it has no \"Scan Size\"");
  const ValueScale scale = value_scale(image, blocks);
  const double factor = scale.factor / std::pow(256.0, bytes_per_pixel);
  return {.name = nanoscope_name(image),
          .unit = scale.unit,
          .columns = columns,
          .rows = rows,
          .width_m = image_length_m(area->width_m),
          .height_m = image_length_m(area->height_m),
          .values = [=] {
            return grid_values(columns, rows, true,
                               [=](std::size_t i) { return factor * nanoscope_integer(data, i, size); });
          }};
}

}  // namespace

ImagePages read_nanoscope(std::string_view bytes) {
  const std::string_view heading = bytes.substr(0, kMostHeaderBytes);
  const std::size_t end = std::min(heading.find('\x1a'), heading.size());
  const std::vector<Block> blocks = blocks_of(heading.substr(0, end));
  ImagePages found;
  for (const Block& block : blocks) {
    if (block.name == kImageBlock) {
      found.pages.push_back(nanoscope_page(bytes, block, blocks));
      continue;
    }
    for (const auto& [key, value] : block.values) {
      if (found.metadata.size() < kMostImageMetadata) found.metadata.emplace_back(key, value);
    }
  }
  return found;
}

}  // namespace afm::curves
