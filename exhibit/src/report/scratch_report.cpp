// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/scratch_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/written_by.h"
#include "physics/quantity_text.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scratch_run.h"

namespace afm::exhibit {
namespace {

using physics::Force;
using physics::format_quantity;
using physics::kEnergyUnits;
using physics::kForceUnits;
using physics::kLengthUnits;
using physics::Length;

constexpr double kNm3 = 1e-27;  // cubic nanometre in m^3

// Figures of a soft sample at a load, for a user who plans a scratch.
struct ScratchFigures {
  Force load, least_load, cap_load, lateral;
  Length standing, standing_left, dragged, dragged_left, width, ridge;
  physics::Pressure touch, yield;
  double coefficient = 0.0;
};

ScratchFigures figures_of(const scene::ParticleSet& set) {
  const physics::SphereCone& tip = set.setup.tip;
  const physics::SoftSurface& surface = set.soft->surface;
  ScratchFigures f;
  f.load = scene::largest_load(set);
  f.least_load = physics::least_marking_load(tip, surface);
  f.cap_load = physics::cap_load(tip, surface);
  f.touch = physics::touching_pressure(tip, surface);
  f.yield = physics::yield_pressure(surface);
  if (!(f.load.si > 0.0)) return f;
  const Length imprint = physics::imprint_radius(surface, f.load), groove = physics::groove_radius(surface, f.load);
  f.standing = physics::imprint_depth(tip, surface, f.load);
  f.standing_left = std::max(Length(0.0), f.standing - physics::spring_back(surface, f.load, imprint));
  f.dragged = physics::groove_depth(tip, surface, f.load);
  const Length back = std::min(f.dragged, physics::spring_back(surface, f.load, groove));
  f.dragged_left = f.dragged - back;
  f.width = 2.0 * groove;
  const physics::Area section = physics::groove_section(tip, f.dragged);
  // the part that springs back is a parabola of the same width
  const physics::Area stays(std::max(0.0, (section - 2.0 / 3.0 * (back * f.width)).si));
  f.ridge = physics::ridge_height(stays, surface.pile_up_share, f.width);
  f.lateral = surface.hardness * section;
  f.coefficient = f.lateral / f.load;
  return f;
}

nlohmann::json figures_json(const ScratchFigures& f) {
  return {{"load_N", f.load.si},
          {"imprint_depth_under_load_m", f.standing.si},
          {"imprint_depth_m", f.standing_left.si},
          {"groove_depth_under_load_m", f.dragged.si},
          {"groove_depth_m", f.dragged_left.si},
          {"groove_width_m", f.width.si},
          {"ridge_height_m", f.ridge.si},
          {"lateral_N", f.lateral.si},
          {"ploughing_coefficient", f.coefficient},
          {"least_marking_load_N", f.least_load.si},
          {"cap_load_N", f.cap_load.si},
          {"touching_pressure_Pa", f.touch.si},
          {"yield_pressure_Pa", f.yield.si},
          {"any_touch_marks", f.touch > f.yield}};
}

nlohmann::json sample_json(const scene::ScratchSample& sample) {
  const physics::ScratchTick& t = sample.tick;
  return {{"time_s", sample.time_s},
          {"base_m", {t.base.position.x.si, t.base.position.y.si, t.base.z.si}},
          {"apex_m", {t.apex.position.x.si, t.apex.position.y.si, t.apex.z.si}},
          {"lateral_N", {t.lateral.x.si, t.lateral.y.si}},
          {"load_N", t.load.si},
          {"state", physics::kScratchStates.at(static_cast<std::size_t>(t.state)).word},
          {"given_J", t.given.si},
          {"work_J", t.work.si},
          {"lost_J", t.lost.si},
          {"stored_J", t.stored.si},
          {"certificate_J", (t.given - t.lost - t.stored).si},
          {"stops", t.stops}};
}

nlohmann::json volumes_json(const physics::MarkVolumes& volumes) {
  return {{"pressed_m3", volumes.pressed.si},
          {"sprung_back_m3", volumes.sprung_back.si},
          {"ridges_m3", volumes.ridges.si},
          {"under_way_m3", volumes.under_way.si},
          {"densified_m3", volumes.densified.si}};
}

nlohmann::json move_json(const scene::ScratchedMove& move) {
  nlohmann::json json = sample_json(move.end);
  json["marks"] = move.marks;
  json["mean_load_N"] = move.load.si;
  json["mean_lateral_N"] = move.lateral.si;
  json["mean_depth_under_load_m"] = move.depth.si;
  json["groove"] = {
      {"depth_m", move.section.depth.si}, {"width_m", move.section.width.si}, {"ridge_m", move.section.ridge.si}};
  json["volumes"] = volumes_json(move.volumes);
  return json;
}

std::string figures_text(const scene::ParticleSet& set) {
  const ScratchFigures f = figures_of(set);
  const auto length = [](Length value) { return format_quantity(value, kLengthUnits, 4); };
  const auto force = [](Force value) { return format_quantity(value, kForceUnits, 4); };
  const auto pressure = [](physics::Pressure value) { return format_quantity(value, physics::kPressureUnits, 4); };
  const auto estimated =
      std::count_if(set.sources.begin(), set.sources.end(), [](const scene::SourcedValue& s) { return s.estimated; });
  return fmt::format(
      "{}, hardness {}, at the largest load of {}, by the formulas\n"
      "  standing tip         {} deep, {} when it has left\n"
      "  first scratch        {} deep, {} when it has left; {} wide, ridges of {}\n"
      "  sideways force       {}, {:.3f} of the load\n"
      "  a touch              {} by adhesion, yields at {}: {}\n"
      "  without adhesion     an imprint below {} springs back\n"
      "  cap of the tip       used up by a scratch at {}\n"
      "  sources              {} of {} values are estimated; --json lists each\n",
      set.soft->name, pressure(set.soft->surface.hardness), force(f.load), length(f.standing), length(f.standing_left),
      length(f.dragged), length(f.dragged_left), length(f.width), length(f.ridge), force(f.lateral), f.coefficient,
      pressure(f.touch), pressure(f.yield), f.touch > f.yield ? "any touch marks" : "a touch leaves no mark",
      force(f.least_load), force(f.cap_load), estimated, set.sources.size());
}

std::string move_text(std::size_t number, const scene::ScratchedMove& move) {
  const auto length = [](Length value) {
    return value.si > 0.0 ? format_quantity(value, kLengthUnits, 4) : std::string("-");
  };
  return fmt::format("{:<10} {:<7} {:<11} {:<11} {:<13} {:<11} {:<11} {}\n", number, move.marks ? "yes" : "no",
                     format_quantity(move.load, kForceUnits, 4), format_quantity(move.lateral, kForceUnits, 4),
                     length(move.depth), length(move.section.depth), length(move.section.width),
                     length(move.section.ridge));
}

}  // namespace

nlohmann::json sources_json(std::span<const scene::SourcedValue> sources) {
  nlohmann::json list = nlohmann::json::array();
  for (const scene::SourcedValue& s : sources) {
    list.push_back({{"key", s.key}, {"value", s.value}, {"source", s.source}, {"estimated", s.estimated}});
  }
  return list;
}

std::string scratch_json(const scene::ParticleSet& set, const scene::ScratchRun& run, physics::Frequency rate) {
  nlohmann::json states = nlohmann::json::array(), moves = nlohmann::json::array();
  for (const scene::ScratchSample& sample : run.samples) states.push_back(sample_json(sample));
  for (const scene::ScratchedMove& move : run.moves) moves.push_back(move_json(move));
  nlohmann::json whole{{"title", set.title},
                       {"medium", set.medium},
                       {"note", set.note},
                       {"sample", set.soft->name},
                       {"rate_Hz", rate.si},
                       {"seconds", run.seconds},
                       {"ticks", run.ticks},
                       {"lagging_ticks", run.lagging},
                       {"exhausted_ticks", run.moves.back().end.tick.exhausted},
                       {"least_certificate_J", run.least_margin_j},
                       {"sources", sources_json(set.sources)},
                       {"figures", figures_json(figures_of(set))},
                       {"volumes", volumes_json(run.moves.back().volumes)},
                       {"states", states},
                       {"moves", moves}};
  core::name_software(whole);
  return whole.dump() + "\n";
}

std::string scratch_text(const scene::ParticleSet& set, const scene::ScratchRun& run, physics::Frequency rate) {
  const auto& last = run.moves.back();
  std::string text = fmt::format("{}, in {}: {:g} s at {:g} Hz\n", set.title, set.medium, run.seconds, rate.si);
  text += figures_text(set);
  text += "\nmove       marks   load        sideways    under load    groove      width       ridges\n";
  for (std::size_t i = 0; i < run.moves.size(); ++i) text += move_text(i + 1, run.moves[i]);
  const physics::MarkVolumes& v = last.volumes;
  text += fmt::format(
      "\nvolume: {:.4g} nm3 pressed down: {:.4g} sprang back, {:.4g} went into ridges, {:.4g} was densified\n",
      v.pressed.si / kNm3, v.sprung_back.si / kNm3, (v.ridges + v.under_way).si / kNm3, v.densified.si / kNm3);
  const physics::ScratchTick& tick = last.end.tick;
  text += fmt::format("energy: at most {} of work by the hand, {} lost, {} stored\n",
                      format_quantity(tick.given, kEnergyUnits, 4), format_quantity(tick.lost, kEnergyUnits, 4),
                      format_quantity(tick.stored, kEnergyUnits, 4));
  if (std::any_of(run.moves.begin(), run.moves.end(), [](const auto& move) { return move.end.tick.stops; })) {
    text += "the tip stopped at the lowest height of the model: the load is more than the sample bears there\n";
  }
  if (run.lagging > 0) text += fmt::format("{} ticks lagged behind the hand: it was too fast\n", run.lagging);
  if (tick.exhausted > 0) text += fmt::format("{} ticks ended before the tip was at rest\n", tick.exhausted);
  return text;
}

}  // namespace afm::exhibit
