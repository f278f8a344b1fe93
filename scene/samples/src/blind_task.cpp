// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/blind_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "blind_task_file.h"
#include "scene/config/toml_table.h"

namespace afm::scene {

using physics::Length;

LineWay way_along(const physics::Sideways<Length>& start, const physics::Sideways<Length>& target,
                  const physics::Sideways<Length>& place) {
  const physics::Sideways<Length> line = target - start, way = place - start;
  const Length length = magnitude(line);
  const double x = line.x / length, y = line.y / length;
  return {.along = x * way.x + y * way.y, .aside = Length(std::abs((x * way.y - y * way.x).si)), .length = length};
}

void HeldForce::add(std::int64_t time_ns, double force_n) {
  if (parts_.empty()) {
    parts_.push_back({time_ns, 0.0});
  } else {
    // by the mean of the forces at both ends of the tick
    const Part& last = parts_.back();
    parts_.push_back(
        {time_ns, last.sum_n_ns + 0.5 * (force_n_ + force_n) * static_cast<double>(time_ns - last.time_ns)});
  }
  force_n_ = force_n;
  while (parts_.size() > 2 && time_ns - parts_[1].time_ns >= kHeldNs) parts_.pop_front();
  const Part& first = parts_.front();
  if (time_ns - first.time_ns < kHeldNs) return;
  const double mean_n = (parts_.back().sum_n_ns - first.sum_n_ns) / static_cast<double>(time_ns - first.time_ns);
  most_n_ = std::max(most_n_.value_or(mean_n), mean_n);
}

std::optional<double> HeldForce::leave() {
  parts_.clear();
  force_n_ = 0.0;
  return std::exchange(most_n_, std::nullopt);
}

BlindTask read_blind_task(const TomlTable& top, const ParticleSet& set) {
  const TomlTable table = top.table("task", "[task]");
  table.allow_only({"kind", "particle", "target"});
  BlindTask task;
  task.kind = table.one_of("kind", kBlindKinds, &BlindKindRow::word).kind;
  task.particle =
      static_cast<std::size_t>(table.whole("particle", 1, static_cast<std::int64_t>(set.particles.size())) - 1);
  if (task.kind == BlindKind::Threshold) {
    if (table.has("target")) table.refuse("target", "is of no use with kind = \"threshold\"");
  } else {
    if (set.targets.empty()) table.refuse("kind", "needs a [[target]], the end of the line");
    task.target = static_cast<std::size_t>(table.whole("target", 1, static_cast<std::int64_t>(set.targets.size())) - 1);
  }
  if (const std::string why = why_not(task, set); !why.empty()) table.refuse("kind", why);
  return task;
}

std::string why_not(const BlindTask& task, const ParticleSet& set) {
  const physics::PlacedParticle& pushed = set.particles[task.particle];
  const physics::ParticleSpecies& species = set.setup.species[pushed.species];
  if (pushed.pinned) return fmt::format("particle {} is pinned, so nobody can push it", task.particle + 1);
  if (physics::turns_flat(species)) {
    return fmt::format("particle {} is a rod or an island; this task is for spheres", task.particle + 1);
  }
  if (task.kind == BlindKind::Threshold) {
    const bool none = std::none_of(set.particles.begin(), set.particles.end(), [](const auto& p) { return p.pinned; });
    return none ? "needs a particle with pinned = true, which is pressed for the answer" : "";
  }
  const Length line = magnitude(set.targets[task.target].position - pushed.position);
  if (line >= species.contact.tip_radius) return "";
  return fmt::format("target {} is less than a radius from the start of particle {}", task.target + 1,
                     task.particle + 1);
}

}  // namespace afm::scene
