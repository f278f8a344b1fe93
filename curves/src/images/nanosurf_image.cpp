// SPDX-License-Identifier: Apache-2.0
#include "images/nanosurf_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "bytes/nanosurf_header.h"

namespace afm::curves {

namespace {

constexpr std::string_view kForward = "Scan forward", kBackward = "Scan backward", kSpectroscopy = "Spec";

// Name of a channel, "Z-Axis" or "Z-Axis (retrace)"; another frame by its name.
std::string name_of_channel(const NanosurfSection& channel, std::string_view group) {
  std::string name(channel.text("Dim2Name").value_or("unnamed"));
  const std::string_view frame = channel.text("Frame").value_or(group);
  if (frame == kForward) return name;
  return fmt::format("{} ({})", name, frame == kBackward ? "retrace" : frame);
}

// Removes lines of one repeated number after the last line that a stopped scan has reached, in whichever direction.
void remove_lines_not_reached(std::vector<double>& values, std::size_t columns) {
  for (auto line = values.begin(); line != values.end(); line += static_cast<std::ptrdiff_t>(columns)) {
    const auto end = line + static_cast<std::ptrdiff_t>(columns);
    if (std::all_of(line, end, [&](double value) { return value == *line; })) {
      std::fill(line, end, std::numeric_limits<double>::quiet_NaN());
    }
  }
}

ImagePage channel_of(std::string_view numbers, const NanosurfSection& channel, const std::string& name,
                     ImagePages& found) {
  const NanosurfIntegers integers = nanosurf_integers(channel);
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
              return unit.factor * (lowest + range * nanosurf_share(numbers, i, integers));
            });
            if (stopped) remove_lines_not_reached(values, columns);
            return values;
          }};
}

}  // namespace

ImagePages read_nanosurf_image(std::string_view bytes) {
  const NanosurfFile file = nanosurf_file(bytes, kMostImageMetadata);
  ImagePages found;
  found.metadata = file.infos;
  for (const NanosurfChannel& channel : file.channels) {
    const std::string name = name_of_channel(*channel.section, channel.group);
    add_page(name, found, [&] {
      if (channel.group.starts_with(kSpectroscopy)) throw CurveError("it is spectroscopy, which is no image");
      return channel_of(channel.numbers, *channel.section, name, found);
    });
  }
  return found;
}

}  // namespace afm::curves
