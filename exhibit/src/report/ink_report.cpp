// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/ink_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "exhibit/report/scratch_report.h"
#include "physics/quantity_text.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {
namespace {

constexpr double kNm2 = 1e-18;  // square nanometre in m^2
constexpr physics::Time kDotTime(1.0);
constexpr physics::Velocity kLineSpeed(100e-9);

std::string length_or_dash(physics::Length value) {
  return value.si > 0.0 ? physics::format_quantity(value, physics::kLengthUnits, 4) : "-";
}

nlohmann::json number_or_null(physics::Length value) {
  return value.si > 0.0 ? nlohmann::json(value.si) : nlohmann::json();
}

}  // namespace

std::string ink_text(const scene::ParticleSet& set, const scene::InkRun& run, physics::Frequency rate) {
  const scene::InkSample& ink = *set.ink;
  const auto estimated =
      std::count_if(set.sources.begin(), set.sources.end(), [](const scene::SourcedValue& s) { return s.estimated; });
  std::string text = fmt::format("{}, in {}: {:g} s at {:g} Hz\n", set.title, set.medium, run.seconds, rate.si);
  text += fmt::format(
      "{}: {:g} molecules/s of {:g} nm2 each, in a layer of {}\n"
      "  a dot of 1 s         {} in radius\n"
      "  a line at 100 nm/s   {} wide\n"
      "  squares              {}\n"
      "  sources              {} of {} values are estimated; --json lists each\n",
      ink.name, ink.ink.molecules_per_s, ink.ink.footprint.si / kNm2,
      physics::format_quantity(ink.thickness, physics::kLengthUnits, 4),
      physics::format_quantity(physics::ink_dot_radius(ink.ink, kDotTime), physics::kLengthUnits, 4),
      physics::format_quantity(physics::ink_line_width(ink.ink, kLineSpeed), physics::kLengthUnits, 4),
      physics::format_quantity(run.spacing, physics::kLengthUnits, 3), estimated, set.sources.size());
  text += "\nmove       on the sample  covered nm2   line        by J a/v    dot of the wait\n";
  for (std::size_t i = 0; i < run.moves.size(); ++i) {
    const scene::InkedMove& move = run.moves[i];
    text += fmt::format("{:<10} {:<14} {:<13} {:<11} {:<11} {}\n", i + 1,
                        move.touches ? physics::format_quantity(move.touched, physics::kTimeUnits, 4) : "-",
                        fmt::format("{:.5g}", move.covered.si / kNm2), length_or_dash(move.width),
                        length_or_dash(move.by_speed), length_or_dash(move.radius));
  }
  text += fmt::format("\n{:.5g} nm2 covered, with {:.4g} molecules\n", run.covered.si / kNm2,
                      run.covered.si / ink.ink.footprint.si);
  if (run.lost.si > 0.0) text += fmt::format("{:.4g} nm2 flowed beyond the grid\n", run.lost.si / kNm2);
  return text;
}

std::string ink_json(const scene::ParticleSet& set, const scene::InkRun& run, physics::Frequency rate) {
  const scene::InkSample& ink = *set.ink;
  nlohmann::json moves = nlohmann::json::array();
  for (const scene::InkedMove& move : run.moves) {
    moves.push_back({{"touches", move.touches},
                     {"touched_s", move.touched.si},
                     {"covered_m2", move.covered.si},
                     {"way_m", move.way.si},
                     {"width_m", number_or_null(move.width)},
                     {"width_by_speed_m", number_or_null(move.by_speed)},
                     {"dot_radius_of_wait_m", number_or_null(move.radius)}});
  }
  const nlohmann::json whole{{"title", set.title},
                             {"medium", set.medium},
                             {"note", set.note},
                             {"ink", ink.name},
                             {"molecules_per_s", ink.ink.molecules_per_s},
                             {"footprint_m2", ink.ink.footprint.si},
                             {"thickness_m", ink.thickness.si},
                             {"rate_Hz", rate.si},
                             {"seconds", run.seconds},
                             {"ticks", run.ticks},
                             {"square_m", run.spacing.si},
                             {"covered_m2", run.covered.si},
                             {"beyond_the_grid_m2", run.lost.si},
                             {"sources", sources_json(set.sources)},
                             {"moves", moves}};
  return whole.dump() + "\n";
}

}  // namespace afm::exhibit
