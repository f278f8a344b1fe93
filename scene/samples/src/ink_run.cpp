// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/ink_run.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/check.h"
#include "grid_image.h"
#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "scene/samples/hand_script.h"
#include "scene/samples/scratch_run.h"
#include "soft_sample.h"
#include "sourced_values.h"

namespace afm::scene {
namespace {

using physics::Length;
using physics::LeverBase;
using physics::Time;

constexpr double kSquaresAcross = 480.0;  // number of squares along the larger side, with both margins
constexpr double kFinestM = 1e-9;
constexpr double kStrongestTension = 1.0;  // N/m, twice the surface tension of mercury

// Largest dot left by a wait, or the widest line if that is larger.
Length widest(const ParticleSet& set) {
  Length most(kFinestM);
  LeverBase from = set.start;
  for (const HandMove& move : set.moves) {
    if (move.to.z.si <= 0.0 && move.wait.si > 0.0) most = std::max(most, ink_dot_radius(set.ink->ink, move.wait));
    if (move.to.z.si <= 0.0 && from.z.si <= 0.0) most = std::max(most, ink_line_width(set.ink->ink, move.speed));
    from = move.to;
  }
  return most;
}

physics::ScanImage ink_image_of(const physics::InkedSurface& surface, const ParticleSet& set) {
  return grid_image(surface, set.title, set.ink->name, [&](std::size_t column, std::size_t row) {
    return surface.is_covered(column, row) ? set.ink->thickness.si : 0.0;
  });
}

}  // namespace

void read_ink(const TomlTable& top, ParticleSet& set) {
  for (const std::string_view key : {"species", "particle", "target", "pad", "sample"}) {
    if (top.has(key)) top.refuse(key, "a tip with ink writes on a bare sample: leave this or [ink] out");
  }
  const TomlTable table = top.table("ink", "[ink]");
  table.allow_only({"name", "molecules_per_s", "footprint_nm2", "thickness", "surface_tension"});
  constexpr double kM2PerNm2 = 1e-18;
  InkSample sample{.name = table.text("name"), .ink = {}, .thickness = {}};
  if (top.has("tip") || top.has("lever") || table.has("surface_tension")) {
    constexpr std::array<std::string_view, 1> kSprings{"normal_spring"};
    read_marking_tip(top.table("tip", "[tip]"), set);
    read_marking_lever(top.table("lever", "[lever]"), kSprings, set);
  }
  SourcedValues values(table);
  sample.ink.molecules_per_s = values.number("molecules_per_s");
  sample.ink.footprint = physics::Area(values.number("footprint_nm2") * kM2PerNm2);
  sample.thickness = values.quantity("thickness", physics::kLengthUnits);
  if (!(sample.thickness.si > 0.0 && sample.thickness.si <= kThickestLayerM)) {
    table.refuse("thickness", "it must be positive, and at most 1 um");
  }
  if (set.setup.tip.radius.si > 0.0) {
    sample.surface_tension = values.quantity("surface_tension", physics::kSurfaceEnergyUnits);
    if (!(sample.surface_tension.si > 0.0 && sample.surface_tension.si <= kStrongestTension)) {
      table.refuse("surface_tension", "it must be positive, and at most 1 N/m");
    }
  }
  try {
    physics::validate(sample.ink);
  } catch (const physics::UnphysicalValue& error) {
    table.refuse(error.field() == "footprint" ? "footprint_nm2" : "molecules_per_s", error.what());
  }
  add_sources(set, "", values);
  set.ink = std::make_shared<const InkSample>(std::move(sample));
}

Length ink_margin(const ParticleSet& set) { return 1.25 * widest(set) + Length(4.0 * kFinestM); }

Length ink_spacing(const ParticleSet& set) {
  const ScratchField field = scratch_field(set);
  const physics::Sideways<Length> size = field.most - field.least;
  const Length side = std::max(size.x, size.y) + 2.0 * ink_margin(set);
  return std::max(Length(kFinestM), side / kSquaresAcross);
}

InkRun play_ink(const ParticleSet& set, physics::Frequency rate) {
  AFM_CHECK(set.ink);
  const ScratchField field = scratch_field(set);
  const Time tick(1.0 / rate.si);
  physics::InkedSurface surface(set.ink->ink, field.least, field.most, ink_margin(set), ink_spacing(set));
  InkRun run;
  LeverBase from = set.start;
  for (const HandMove& move : set.moves) {
    const std::size_t ticks = ticks_of(from, move, rate), waits = waiting_ticks(move, rate);
    InkedMove inked;
    const physics::Area before = surface.covered();
    physics::Sideways<Length> last = from.position;
    for (std::size_t i = 1; i <= ticks + waits; ++i, ++run.ticks) {
      const LeverBase at = on_the_way(from, move, std::min(1.0, static_cast<double>(i) / static_cast<double>(ticks)));
      if (at.z.si <= 0.0) {
        surface.touch(at.position, tick);
        inked.touches = true;
        inked.touched = inked.touched + tick;
        inked.way = inked.way + magnitude(at.position - last);
      }
      last = at.position;
    }
    inked.covered = surface.covered() - before;
    const bool line = from.z.si <= 0.0 && move.to.z.si <= 0.0 && inked.way.si > 0.0;
    if (line && !(move.sweep_width.si > 0.0)) {
      inked.width = surface.width(from.position, move.to.position);
      inked.by_speed = ink_line_width(set.ink->ink, move.speed);
    }
    if (move.to.z.si <= 0.0 && waits > 0) inked.radius = ink_dot_radius(set.ink->ink, move.wait);
    run.moves.push_back(inked);
    from = move.to;
  }
  run.seconds = static_cast<double>(run.ticks) / rate.si;
  run.covered = surface.covered();
  run.lost = surface.lost();
  run.spacing = surface.spacing();
  run.image = ink_image_of(surface, set);
  return run;
}

}  // namespace afm::scene
