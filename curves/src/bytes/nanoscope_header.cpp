// SPDX-License-Identifier: Apache-2.0
#include "bytes/nanoscope_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "bytes/scaled_unit.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "curves/recorded_curve.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostHeaderBytes = std::size_t{4} << 20U;

constexpr std::string_view kHeaderEnd = "\\*File list end";

// Adds a line "\key: value"; the colon in "@2:Z scale" belongs to the key.
void add_line(std::string_view line, NanoscopeBlock& block) {
  const bool counted =
      line.size() > 2 && line[0] == '@' && std::isdigit(static_cast<unsigned char>(line[1])) != 0 && line[2] == ':';
  const std::size_t colon = line.find(':', counted ? 3 : 0);
  if (colon == std::string_view::npos) return;
  block.values.emplace(lower_key(trimmed(line.substr(0, colon))), trimmed(line.substr(colon + 1)));
}

// Takes the text between a bracket and its counterpart, with everything before it; empty if they do not come next.
// Brackets may be nested: "(0.0003 log(Arb)/LSB)".
std::string_view take_between(char open, char close, std::string_view& text) {
  text = trimmed(text);
  if (!text.starts_with(open)) return {};
  std::size_t end = 1;
  for (int depth = 1; end < text.size(); ++end) {
    depth += text[end] == close ? -1 : text[end] == open ? 1 : 0;
    if (depth == 0) break;
  }
  if (end == text.size()) return {};
  const std::string_view inside = text.substr(1, end - 1);
  text.remove_prefix(end + 1);
  return inside;
}

}  // namespace

std::string lower_key(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::vector<NanoscopeBlock> nanoscope_blocks(std::string_view bytes) {
  const std::string_view heading = bytes.substr(0, kMostHeaderBytes);
  const std::string_view header = heading.substr(0, heading.find('\x1a'));
  std::vector<NanoscopeBlock> blocks;
  std::string_view line;
  for (Lines lines(header); lines.next(line);) {
    if (line == kHeaderEnd) break;
    if (line.starts_with("\\*")) {
      blocks.push_back({trimmed(line.substr(2)), {}});
    } else if (line.starts_with('\\') && !blocks.empty()) {
      add_line(line.substr(1), blocks.back());
    }
  }
  return blocks;
}

bool nanoscope_header_ends(std::string_view bytes) {
  return bytes.substr(0, kMostHeaderBytes).find(kHeaderEnd) != std::string_view::npos;
}

std::string_view nanoscope_channel(const NanoscopeBlock& channel) {
  for (const char* key : {"@4:image data", "@2:image data"}) {
    const std::string_view* data = channel.find(key);
    if (data == nullptr) continue;
    const std::size_t open = data->find('"'), close = data->rfind('"');
    if (open != std::string_view::npos && close > open) return data->substr(open + 1, close - open - 1);
  }
  return {};
}

std::uint32_t nanoscope_version(const std::vector<NanoscopeBlock>& blocks) {
  for (const NanoscopeBlock& block : blocks) {
    const std::string_view* text = block.find("version");
    if (text == nullptr) continue;
    std::string_view digits = *text;
    if (digits.starts_with("0x") || digits.starts_with("0X")) digits.remove_prefix(2);
    std::uint32_t version = 0;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), version, 16).ec == std::errc()) return version;
  }
  return 0;
}

std::optional<double> take_number(std::string_view& text) {
  text = trimmed(text);
  std::string_view rest = text;
  const auto number = take_decimal(rest);
  if (!number) return std::nullopt;
  if (rest.starts_with(',') && has_decimal_comma(text.substr(0, text.size() - rest.size() + 2)))
    throw CurveError(decimal_comma_in("a number of its header", text));
  text = rest;
  return number;
}

double nanoscope_number(const NanoscopeBlock& block, const std::string& key) {
  const std::string_view* text = block.find(key);
  if (text == nullptr) throw CurveError(fmt::format("it has no \"{}\"", key));
  std::string_view rest = *text;
  const auto number = take_number(rest);
  if (!number) throw CurveError(fmt::format("its \"{}\" is no number", key));
  return *number;
}

double nanoscope_spring_constant(const NanoscopeBlock& channel) {
  constexpr const char* kKey = "spring constant";
  const double k_n_per_m = nanoscope_number(channel, kKey);
  std::string_view unit = *channel.find(kKey);
  take_number(unit);
  unit = trimmed(unit);
  if (unit.empty()) return k_n_per_m;
  const auto parsed = physics::parse_quantity(fmt::format("{}{}", k_n_per_m, unit), physics::kStiffnessUnits);
  if (parsed.value) return parsed.value->si;
  throw CurveError(fmt::format("its spring constant is in \"{}\", not in N/m", unit.substr(0, 40)));
}

std::size_t nanoscope_data_offset(const NanoscopeBlock& channel, std::string_view bytes) {
  const double offset = nanoscope_number(channel, "data offset");
  if (offset > static_cast<double>(bytes.size())) throw CutShort();
  const std::size_t end = bytes.substr(0, kMostHeaderBytes).find(kHeaderEnd);
  if (!(offset >= 0.0) || (end != std::string_view::npos && offset < static_cast<double>(end))) {
    throw CurveError(fmt::format("its data begin at byte {:g}, within its header: was the header altered?", offset));
  }
  return static_cast<std::size_t>(offset);
}

std::optional<HardScale> hard_scale(const std::string_view* text) {
  if (text == nullptr || !text->starts_with('V')) return std::nullopt;
  std::string_view rest = text->substr(1);
  HardScale scale;
  scale.soft_name = take_between('[', ']', rest);
  std::string_view per_lsb = take_between('(', ')', rest);
  scale.per_lsb = take_number(per_lsb);
  scale.per_lsb_unit = trimmed(per_lsb.substr(0, per_lsb.rfind('/')));
  scale.value = take_number(rest);
  scale.unit = trimmed(rest);
  return scale;
}

NanoscopeTime nanoscope_time(std::string_view text) {
  constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                     "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  std::vector<std::string_view> words;
  split(text, ' ', words);
  words.erase(std::remove(words.begin(), words.end(), std::string_view()), words.end());
  if (words.size() != 6 || words[0].size() != 8) return {};
  const auto* month = std::find(kMonths.begin(), kMonths.end(), words[3]);
  const auto hour = number_of(words[0].substr(0, 2)), day = number_of(words[4]), year = number_of(words[5]);
  if (month == kMonths.end() || !hour || !day || !year) return {};
  if (!(*hour >= 1 && *hour <= 12 && *day >= 1 && *day <= 31 && *year >= 1900 && *year <= 9999)) return {};
  const int hours = static_cast<int>(*hour) % 12 + (words[1] == "PM" ? 12 : 0);
  return {
      fmt::format("{:04}-{:02}-{:02}", static_cast<int>(*year), month - kMonths.begin() + 1, static_cast<int>(*day)),
      fmt::format("{:02}{}", hours, words[0].substr(2))};
}

std::optional<SoftScale> soft_scale(const std::vector<NanoscopeBlock>& blocks, std::string_view name,
                                    std::string_view per) {
  const std::string key = "@" + lower_key(name);
  for (const NanoscopeBlock& block : blocks) {
    const std::string_view* text = block.find(key);
    if (text == nullptr || !text->starts_with('V')) continue;
    std::string_view rest = text->substr(1);
    const auto number = take_number(rest);
    if (!number) continue;
    rest = trimmed(rest);
    const std::size_t stroke = rest.rfind('/');
    const ScaledUnit below = scaled_unit(stroke == std::string_view::npos ? "" : rest.substr(stroke + 1));
    if (below.factor != 1.0 && (below.unit == "V" || below.unit == scaled_unit(per).unit)) {
      const ScaledUnit above = scaled_unit(rest.substr(0, stroke));
      return SoftScale{*number * above.factor / below.factor, above.unit};
    }
    for (const std::string_view divisor : {std::string_view("V"), per}) {
      if (rest.size() <= divisor.size() || !rest.ends_with(divisor)) continue;
      if (rest[rest.size() - divisor.size() - 1] == '/') rest.remove_suffix(divisor.size() + 1);
    }
    const ScaledUnit unit = scaled_unit(rest);
    return SoftScale{*number * unit.factor, unit.unit};
  }
  return std::nullopt;
}

double nanoscope_value_per_integer(const NanoscopeBlock& channel, std::size_t integer_size) {
  const auto scale = hard_scale(channel.find("@4:z scale"));
  if (!scale || (!scale->per_lsb && !scale->value)) {
    throw CurveError(fmt::format("its channel {} has no \"@4:Z scale\"", nanoscope_channel(channel)));
  }
  constexpr double kRounding = 0.01;
  const double unit = scaled_unit(scale->unit).factor;
  const double of_range = unit * scale->value.value_or(0.0) / std::pow(256.0, static_cast<double>(integer_size));
  if (!scale->per_lsb) return of_range;
  const double per_lsb =
      (scale->per_lsb_unit.empty() ? unit : scaled_unit(scale->per_lsb_unit).factor) * *scale->per_lsb;
  return std::abs(of_range / per_lsb - 1.0) < kRounding ? of_range : per_lsb;
}

std::optional<double> nanoscope_metres_per_volt(const std::vector<NanoscopeBlock>& blocks, std::string_view name) {
  const auto soft = soft_scale(blocks, name, "V");
  return soft && soft->unit == "m" && soft->factor != 0.0 ? std::optional(soft->factor) : std::nullopt;
}

double nanoscope_ramp_m(const NanoscopeBlock& channel, const std::vector<NanoscopeBlock>& blocks) {
  const auto list = std::find_if(blocks.begin(), blocks.end(), [](const NanoscopeBlock& block) {
    return lower_key(block.name) == kNanoscopeForceList;
  });
  for (const NanoscopeBlock* block : {&channel, list != blocks.end() ? &*list : &channel}) {
    for (const char* key : {"@4:ramp size", "@4:ramp size zsweep", "@ramp size", "@z scan size"}) {
      const auto scale = hard_scale(block->find(key));
      if (!scale || !scale->value) continue;
      const auto per_volt =
          nanoscope_metres_per_volt(blocks, scale->soft_name.empty() ? "Sens. Zsens" : scale->soft_name);
      if (!per_volt) throw CurveError(fmt::format("it does not say how long its ramp of {:g} V is", *scale->value));
      return std::abs(*scale->value * scaled_unit(scale->unit).factor * *per_volt);
    }
  }
  throw CurveError("it has neither a channel of the height nor a \"Ramp size\"");
}

}  // namespace afm::curves
