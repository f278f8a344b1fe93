// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "curves/recorded_curve.h"

namespace afm::test {

// A JPK map 3 um wide and 2 um high about (10 um, -5 um), of 3 by 2 curves, recorded back and forth.
inline constexpr std::size_t kMapColumns = 3, kMapRows = 2;
inline constexpr double kMapWidthM = 3e-6, kMapHeightM = 2e-6, kMapXM = 10e-6, kMapYM = -5e-6;

// Pixel of the curve with this index: 0 1 2 in the lower row, 5 4 3 in the upper one.
inline std::size_t map_row(std::size_t index) { return index / kMapColumns; }
inline std::size_t map_column(std::size_t index) {
  return map_row(index) % 2 == 0 ? index % kMapColumns : kMapColumns - 1 - index % kMapColumns;
}

// Entries of the archive, for stored_zip().
inline std::map<std::string, std::string> jpk_map(
    const std::function<curves::RecordedCurve(std::size_t index)>& curve_of) {
  constexpr double kZStepM = 1e-14, kForceStepN = 1e-18;
  const auto bytes_of = [](double value, std::string& to) {
    const auto number = static_cast<std::uint64_t>(std::llround(value));
    for (int shift = 56; shift >= 0; shift -= 8)
      to.push_back(static_cast<char>(number >> static_cast<unsigned>(shift)));
  };
  const double spring_n_per_m = curve_of(0).metadata.spring_constant->si;
  std::map<std::string, std::string> entries;
  entries["header.properties"] = fmt::format(
      "force-scan-map.description.instrument=NanoWizard\nforce-scan-map.position-pattern.back-and-forth=true\n"
      "{0}ilength={1}\n{0}jlength={2}\n{0}ulength={3}\n{0}vlength={4}\n{0}xcenter={5}\n{0}ycenter={6}\n{0}theta=0.0\n",
      "force-scan-map.position-pattern.grid.", kMapColumns, kMapRows, kMapWidthM, kMapHeightM, kMapXM, kMapYM);
  entries["shared-data/header.properties"] = fmt::format(
      "lcd-info.0.encoder.type=signedlong\nlcd-info.0.encoder.scaling.offset=0\n"
      "lcd-info.0.encoder.scaling.multiplier={0}\nlcd-info.0.conversion-set.conversions.base=nominal\n"
      "lcd-info.1.encoder.type=signedlong\nlcd-info.1.encoder.scaling.offset=0\n"
      "lcd-info.1.encoder.scaling.multiplier={1}\nlcd-info.1.conversion-set.conversions.base=volts\n"
      "{2}distance.defined=true\n{2}distance.base-calibration-slot=volts\n{2}distance.scaling.offset=0\n"
      "{2}distance.scaling.multiplier=1\n{2}force.defined=true\n{2}force.base-calibration-slot=distance\n"
      "{2}force.scaling.offset=0\n{2}force.scaling.multiplier={3}\n",
      kZStepM, kForceStepN / spring_n_per_m, "lcd-info.1.conversion-set.conversion.", spring_n_per_m);
  for (std::size_t index = 0; index < kMapColumns * kMapRows; ++index) {
    const double x = kMapXM + kMapWidthM * ((static_cast<double>(map_column(index)) + 0.5) / kMapColumns - 0.5);
    const double y = kMapYM + kMapHeightM * ((static_cast<double>(map_row(index)) + 0.5) / kMapRows - 0.5);
    const std::string folder = fmt::format("index/{}/", index);
    entries[folder + "header.properties"] =
        fmt::format("force-scan-series.header.position.x={}\nforce-scan-series.header.position.y={}\n", x, y);
    const curves::RecordedCurve curve = curve_of(index);
    for (const auto& point : curve.points) {
      const bool approach = point.branch == physics::Branch::Approach;
      const std::string segment = folder + (approach ? "segments/0/" : "segments/1/");
      bytes_of(point.z.si / kZStepM, entries[segment + "channels/measuredHeight.dat"]);
      bytes_of(point.force.si / kForceStepN, entries[segment + "channels/vDeflection.dat"]);
      entries[segment + "segment-header.properties"] = fmt::format(
          "force-segment-header.settings.style={}\nchannel.measuredHeight.lcd-info.*=0\n"
          "channel.vDeflection.lcd-info.*=1\n",
          approach ? "extend" : "retract");
    }
  }
  return entries;
}

// Same curves on a grid with `finer` times as many pixels per side, most of which have none.
inline std::map<std::string, std::string> on_finer_grid(std::map<std::string, std::string> entries, std::size_t finer) {
  entries["header.properties"] +=
      fmt::format("{0}ilength={1}\n{0}jlength={2}\n", "force-scan-map.position-pattern.grid.", finer * kMapColumns,
                  finer * kMapRows);
  return entries;
}

}  // namespace afm::test
