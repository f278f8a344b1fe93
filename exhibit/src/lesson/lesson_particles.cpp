// SPDX-License-Identifier: Apache-2.0
#include "lesson_particles.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <string_view>
#include <utility>

#include "physics/manipulation/marked_surface.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/quantity_text.h"
#include "push_trial.h"
#include "scene/config/toml_table.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/soft_blocks.h"
#include "written_lines.h"

namespace afm::exhibit {

namespace {

using scene::TomlTable;
using study::StepGround;

constexpr std::size_t kMostPathLetters = 1000;
constexpr std::size_t kMostLines = 20, kMostCorners = 20;
constexpr double kNarrowestGroove = 0.5, kWidestGroove = 2.0;  // width in radii of the tip
constexpr double kNarrowestInk = 0.25, kWidestInk = 1.0;       // width in dots of a second
constexpr double kShortestPart = 4.0;                          // length in widths of the line
constexpr const char* kLinesLike = "lines such as [[\"-50 nm, 0 nm\", \"50 nm, 0 nm\"]]";

// Longer side of the field on which the particles of a set lie, with a radius around it: the reach of the hand.
physics::Length field_side(const scene::ParticleSet& set) {
  auto least = set.particles.front().position, most = least;
  for (const physics::PlacedParticle& particle : set.particles) {
    least = {std::min(least.x, particle.position.x), std::min(least.y, particle.position.y)};
    most = {std::max(most.x, particle.position.x), std::max(most.y, particle.position.y)};
  }
  return std::max(most.x - least.x, most.y - least.y) + 2.0 * scene::median_radius(set);
}

void refuse_push_key(const TomlTable& table, std::string_view key, PushUntil until) {
  if (table.has(key)) table.refuse(key, fmt::format("is of no use with until = \"{}\"", row_of(until).word));
}

// Refuses a blind task that the set does not allow.
void refuse_impossible(const TomlTable& table, const PushPlan& plan, const scene::ParticleSet& set) {
  const auto task = blind_task_of(plan);
  const std::string why = task ? scene::why_not(*task, set) : std::string();
  if (!why.empty()) table.refuse("until", why);
}

// Reads a corner of a line: "-50 nm, 0 nm".
glm::dvec2 read_corner(const TomlTable& table, const toml::node& node, double reach_m) {
  const auto text = node.value<std::string_view>();
  const std::size_t comma = text ? text->find(',') : std::string_view::npos;
  if (!text || comma == std::string_view::npos) table.refuse("lines", fmt::format("must be {}", kLinesLike));
  const auto coordinate_m = [&](std::string_view part) {
    const auto read = physics::parse_quantity(part, physics::kLengthUnits);
    if (!read.value) table.refuse("lines", read.error);
    return read.value->si;
  };
  const glm::dvec2 corner_m(coordinate_m(text->substr(0, comma)), coordinate_m(text->substr(comma + 1)));
  if (!(std::max(std::abs(corner_m.x), std::abs(corner_m.y)) <= reach_m)) {
    table.refuse("lines", fmt::format("{} is beyond the sample, on which the tip may be up to {} from the middle along "
                                      "each side",
                                      *text, length_words(reach_m)));
  }
  return corner_m;
}

std::vector<glm::dvec2> read_line(const TomlTable& table, const toml::node& node, double reach_m) {
  const toml::array* const corners = node.as_array();
  if (corners == nullptr || corners->size() < 2 || corners->size() > kMostCorners) {
    table.refuse("lines", fmt::format("must be {}, each line with 2 to {} corners", kLinesLike, kMostCorners));
  }
  std::vector<glm::dvec2> corners_m;
  corners_m.reserve(corners->size());
  for (const toml::node& corner : *corners) corners_m.push_back(read_corner(table, corner, reach_m));
  return corners_m;
}

// Refuses parts that are too short, and lines on which no place can be measured.
void refuse_short(const TomlTable& table, const LinesToWrite& lines, const MarkGrid& grid) {
  const double shortest_m = kShortestPart * lines.width_m;
  for (std::size_t number = 0; number < lines.lines_m.size(); ++number) {
    const auto& corners_m = lines.lines_m[number];
    for (std::size_t i = 1; i < corners_m.size(); ++i) {
      if (glm::distance(corners_m[i - 1], corners_m[i]) >= (1.0 - 1e-9) * shortest_m) continue;
      table.refuse("lines", fmt::format("line {} has a part shorter than {}, four times its width", number + 1,
                                        length_words(shortest_m)));
    }
  }
  for (std::size_t number = 0; number < lines.lines_m.size(); ++number) {
    if (can_be_measured(lines, number, grid)) continue;
    table.refuse("lines", fmt::format("line {} is nowhere {} or more from all other parts, so that its width could be "
                                      "measured",
                                      number + 1, length_words(kOutsideWidths * lines.width_m)));
  }
}

// Width of the lines.
double read_width_m(const TomlTable& table, const scene::ParticleSet& set) {
  const double width_m = table.quantity("width", physics::kLengthUnits).si;
  const double unit_m = set.ink ? scene::ink_dot_m(set.ink->ink) : set.setup.tip.radius.si;
  const double least_m = (set.ink ? kNarrowestInk : kNarrowestGroove) * unit_m;
  const double most_m = (set.ink ? kWidestInk : kWidestGroove) * unit_m;
  if (!(width_m >= least_m && width_m <= most_m)) {
    table.refuse("width", fmt::format("must lie between {} and {}, {}", length_words(least_m), length_words(most_m),
                                      set.ink ? "a quarter of the dot that ink makes in a second, and all of it"
                                              : "half and twice the radius of the tip"));
  }
  return width_m;
}

}  // namespace

// Reads the set of particles that all steps of the lesson share.
void read_particles(const TomlTable& top, const std::string& assets_dir, Lesson& lesson) {
  lesson.particles = top.text("particles", kMostPathLetters);
  lesson.scale = scene::ScaleMode::Particles;
  if (top.has("scale")) top.refuse("scale", "is that of the particles in a lesson that has some; leave it out");
  const auto path = scene::particle_file(lesson.particles, assets_dir);
  if (!path) top.refuse("particles", path.error().message);
  auto set = scene::load_particle_set(*path);
  if (!set) top.refuse("particles", set.error().message);
  if (set->ink && set->ink->surface_tension.si == 0.0) {
    top.refuse("particles", lesson.particles + " has ink, but no tip, lever and surface_tension for a hand");
  }
  if (std::any_of(set->setup.species.begin(), set->setup.species.end(), physics::turns_flat)) {
    top.refuse("particles", lesson.particles + " has rods or islands; a lesson takes spheres alone");
  }
  lesson.set = std::make_shared<const scene::ParticleSet>(std::move(*set));
}

PushPlan read_push(const TomlTable& table, const scene::ParticleSet& set) {
  PushPlan plan;
  plan.until = table.one_of("until", kPushUntils, &PushUntilRow::word).until;
  if (row_of(plan.until).from_targets && set.targets.empty()) {
    table.refuse("until", "needs a set of particles with targets");
  }
  if (plan.until == PushUntil::Pattern) {
    refuse_push_key(table, "particle", plan.until);
  } else {
    const auto count = static_cast<std::int64_t>(set.particles.size());
    plan.particle = static_cast<std::size_t>(table.whole("particle", 1, count) - 1);
    if (set.particles[plan.particle].pinned) table.refuse("particle", "is pinned in its place, so nobody can push it");
  }
  if (plan.until == PushUntil::Target || plan.until == PushUntil::Line) {
    plan.target = static_cast<std::size_t>(table.whole("target", 1, static_cast<std::int64_t>(set.targets.size())) - 1);
  } else {
    refuse_push_key(table, "target", plan.until);
  }
  refuse_impossible(table, plan, set);
  if (plan.until != PushUntil::Moved) {
    refuse_push_key(table, "distance", plan.until);
    return plan;
  }
  const physics::Length distance = table.quantity("distance", physics::kLengthUnits), most = field_side(set);
  if (!(distance.si > 0.0) || distance > most) {
    table.refuse("distance", fmt::format("must be more than 0 and at most {}, the side of the field of the particles",
                                         physics::format_quantity(most, physics::kLengthUnits, 4)));
  }
  plan.distance_m = distance.si;
  return plan;
}

LinesToWrite read_lines(const TomlTable& table, const scene::ParticleSet& set) {
  LinesToWrite lines;
  const double reach_m = set.ink ? scene::ink_reach_m(set.ink->ink) : scene::soft_reach_m(set.setup.tip.radius.si);
  lines.width_m = read_width_m(table, set);
  const toml::array* const all = table.node("lines").as_array();
  if (all == nullptr || all->empty() || all->size() > kMostLines) {
    table.refuse("lines", fmt::format("must be 1 to {} {}", kMostLines, kLinesLike));
  }
  lines.lines_m.reserve(all->size());
  for (const toml::node& line : *all) lines.lines_m.push_back(read_line(table, line, reach_m));
  refuse_short(table, lines, mark_grid(set));
  return lines;
}

// Refuses steps on materials if there are particles or a soft sample: their scale does not suit a material's force.
void refuse_kind_on_ground(const TomlTable& table, const study::StepKindRow& row, const Lesson& lesson) {
  const bool marks = lesson.set && scene::leaves_marks(*lesson.set);
  const auto refuse = [&](std::string_view what) { table.refuse("type", fmt::format("{} {}", row.word, what)); };
  switch (row.ground) {
    case StepGround::Any:
      return;
    case StepGround::Materials:
      if (lesson.set) refuse("is for lessons without particles");
      return;
    case StepGround::Particles:
      if (!lesson.set) refuse("needs the lesson's particles");
      if (marks) {
        refuse(fmt::format("needs particles, and {} has {}: use write", lesson.particles,
                           lesson.set->ink ? "ink" : "a soft sample"));
      }
      return;
    case StepGround::SoftSample:
      if (!marks) refuse("needs a soft sample or ink: particles = \"scratch-pmma\" in the lesson");
  }
}

}  // namespace afm::exhibit
