// SPDX-License-Identifier: Apache-2.0
#include "images/nanosurf_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "bytes/file_bytes.h"
#include "bytes/text_table.h"

namespace afm::curves {

namespace {

constexpr std::string_view kDataMark = "\n#!", kInfo = "DataSet-Info", kForward = "Scan forward",
                           kBackward = "Scan backward", kSpectroscopy = "Spec";
constexpr double kMostGroups = 64, kMostChannelNumber = 256;

// Values by their keys, as views of the file.
struct Section {
  std::map<std::string_view, std::string_view> values;

  std::optional<std::string_view> text(std::string_view key) const {
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  }
  std::optional<double> number(std::string_view key) const {
    const auto found = text(key);
    if (!found) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(found->data(), found->data() + found->size(), value);
    return error == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  // Throws without it.
  double needed(std::string_view key) const {
    const auto value = number(key);
    if (!value) throw CurveError(fmt::format("it has no number \"{}\"", key));
    return *value;
  }
};

struct Header {
  std::map<std::string_view, Section> sections;
  std::vector<std::pair<std::string, std::string>> infos;  // in the order of the file
};

Header header_of(std::string_view text) {
  Header header;
  std::string_view line, name;
  for (Lines lines(text); lines.next(line);) {
    if (line.starts_with('[') && line.ends_with(']')) {
      name = line.substr(1, line.size() - 2);
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || equals == 0) continue;
    const std::string_view key = line.substr(0, equals), value = trimmed(line.substr(equals + 1));
    header.sections[name].values.emplace(key, value);
    const bool is_heading = key.starts_with("--");
    if (name == kInfo && !is_heading && header.infos.size() < kMostImageMetadata) header.infos.emplace_back(key, value);
  }
  return header;
}

// Integers of a channel, as the file stores them.
struct Integers {
  std::size_t size = 0;
  bool is_signed = true;
  std::endian order = std::endian::little;
};

Integers integers_of(const Section& channel) {
  const double bits = channel.needed("SaveBits");
  if (bits != 8 && bits != 16 && bits != 32) {
    throw CurveError(fmt::format("its numbers have {:g} bits; 8, 16 and 32 are read", bits));
  }
  if (const auto mode = channel.text("SaveMode").value_or("Binary"); mode != "Binary") {
    throw CurveError(fmt::format("its numbers are saved as \"{}\"; Binary is read", mode.substr(0, 40)));
  }
  return {.size = static_cast<std::size_t>(bits) / 8,
          .is_signed = channel.text("SaveSign").value_or("Signed") != "Unsigned",
          .order = channel.text("SaveOrder").value_or("Intel") == "Motorola" ? std::endian::big : std::endian::little};
}

// 0 to 1 over the whole range of the integers.
double share_at(std::string_view numbers, std::size_t index, const Integers& integers) {
  const std::size_t at = index * integers.size;
  const double range = std::exp2(8.0 * static_cast<double>(integers.size));
  const double unsigned_number = integers.size == 1   ? number_at<std::uint8_t>(numbers, at)
                                 : integers.size == 2 ? number_at<std::uint16_t>(numbers, at, integers.order)
                                                      : number_at<std::uint32_t>(numbers, at, integers.order);
  if (!integers.is_signed) return unsigned_number / range;
  return std::fmod(unsigned_number / range + 0.5, 1.0);  // two's complement, from the lowest number on
}

// Points of a channel, which may be one line.
std::size_t points_of(const Section& channel) {
  constexpr double kMostPoints = 1e9;
  const double points = channel.needed("Points") * channel.needed("Lines");
  if (!(points >= 0 && points <= kMostPoints)) throw CurveError("it is damaged: a channel has no number of points");
  return static_cast<std::size_t>(points);
}

// "Z-Axis", "Z-Axis (retrace)"; another frame by its name.
std::string name_of_channel(const Section& channel, std::string_view group) {
  std::string name(channel.text("Dim2Name").value_or("unnamed"));
  const std::string_view frame = channel.text("Frame").value_or(group);
  if (frame == kForward) return name;
  return fmt::format("{} ({})", name, frame == kBackward ? "retrace" : frame);
}

// Lines that hold one number alone, behind the last one that a stopped scan has reached, in whichever direction.
void remove_lines_not_reached(std::vector<double>& values, std::size_t columns) {
  for (auto line = values.begin(); line != values.end(); line += static_cast<std::ptrdiff_t>(columns)) {
    const auto end = line + static_cast<std::ptrdiff_t>(columns);
    if (std::all_of(line, end, [&](double value) { return value == *line; })) {
      std::fill(line, end, std::numeric_limits<double>::quiet_NaN());
    }
  }
}

ImagePage channel_of(std::string_view numbers, const Section& channel, const std::string& name, ImagePages& found) {
  const Integers integers = integers_of(channel);
  const std::size_t columns = image_side(channel.needed("Points")), rows = image_side(channel.needed("Lines"));
  const ScaledUnit unit = scaled_unit(channel.text("Dim2Unit").value_or("")),
                   x_unit = scaled_unit(channel.text("Dim0Unit").value_or("")),
                   y_unit = scaled_unit(channel.text("Dim1Unit").value_or(""));
  const double lowest = channel.needed("Dim2Min"), range = channel.needed("Dim2Range");
  const double last_line = channel.number("CurLine").value_or(static_cast<double>(rows) - 1);
  const bool stopped = last_line + 1 < static_cast<double>(rows);
  if (stopped) {
    found.remark(
        fmt::format("the scan stopped after {:g} of {} lines; the others count as not measured", last_line + 1, rows));
  }
  return {.name = name,
          .unit = unit.unit,
          .columns = columns,
          .rows = rows,
          .width_m = image_length_m(channel.needed("Dim0Range"), x_unit),
          .height_m = image_length_m(channel.needed("Dim1Range"), y_unit),
          .x_offset_m = x_unit.factor * channel.number("Dim0Min").value_or(0.0),
          .y_offset_m = y_unit.factor * channel.number("Dim1Min").value_or(0.0),
          .values = [=] {
            std::vector<double> values = grid_values(columns, rows, true, [&](std::size_t i) {
              return unit.factor * (lowest + range * share_at(numbers, i, integers));
            });
            if (stopped) remove_lines_not_reached(values, columns);
            return values;
          }};
}

}  // namespace

ImagePages read_nanosurf_image(std::string_view bytes) {
  const std::size_t mark = bytes.find(kDataMark);
  if (mark == std::string_view::npos) throw CutShort("it is cut short: it has no data");
  const Header header = header_of(bytes.substr(0, mark));
  std::string_view rest = bytes.substr(mark + kDataMark.size());
  const auto all = header.sections.find("DataSet");
  if (all == header.sections.end()) throw CurveError("it has no section [DataSet]");
  const Section& set = all->second;
  ImagePages found;
  found.metadata = header.infos;
  const double groups = std::min(set.needed("GroupCount"), kMostGroups);
  for (int group = 0; group < groups; ++group) {
    const std::string_view group_name = set.text(fmt::format("Gr{}-Name", group)).value_or("");
    const double channels = std::min(set.number(fmt::format("Gr{}-Count", group)).value_or(0.0), kMostChannelNumber);
    for (int number = 0; number < channels; ++number) {
      const auto section = set.text(fmt::format("Gr{}-Ch{}", group, number));
      if (!section) continue;  // a count includes the channels that were not saved
      const auto channel = header.sections.find(*section);
      if (channel == header.sections.end()) throw CurveError(fmt::format("it has no section [{}]", *section));
      const std::string name = name_of_channel(channel->second, group_name);
      const std::size_t size = points_of(channel->second) * integers_of(channel->second).size;
      const std::string_view numbers = part(rest, 0, size);
      rest.remove_prefix(size);
      add_page(name, found, [&] {
        if (group_name.starts_with(kSpectroscopy)) throw CurveError("it is spectroscopy, which is not read");
        return channel_of(numbers, channel->second, name, found);
      });
    }
  }
  return found;
}

}  // namespace afm::curves
