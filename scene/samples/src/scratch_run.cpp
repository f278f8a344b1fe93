// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/scratch_run.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "grid_image.h"
#include "scene/samples/hand_script.h"

namespace afm::scene {
namespace {

using physics::Force;
using physics::Length;
using physics::LeverBase;
using physics::ScratchTick;

double scratch_margin_j(const ScratchTick& tick) { return (tick.given - tick.lost - tick.stored).si; }

// Sums over the second half of a move.
struct Sums {
  double load_n = 0.0, lateral_n = 0.0, depth_m = 0.0, count = 0.0;

  void add(const ScratchTick& tick) {
    load_n += tick.load.si;
    lateral_n += magnitude(tick.lateral).si;
    depth_m -= std::min(0.0, tick.apex.z.si);
    count += 1.0;
  }
};

physics::ScanImage image_of(const physics::MarkedSurface& surface, const ParticleSet& set) {
  return grid_image(surface, set.title, set.soft->name,
                    [&](std::size_t column, std::size_t row) { return surface.square(column, row).si; });
}

}  // namespace

ScratchField scratch_field(const ParticleSet& set) {
  ScratchField field{set.start.position, set.start.position};
  for (const HandMove& move : set.moves) {
    const physics::Sideways<Length>& at = move.to.position;
    field.least = {std::min(field.least.x, at.x), std::min(field.least.y, at.y)};
    field.most = {std::max(field.most.x, at.x), std::max(field.most.y, at.y)};
  }
  return field;
}

Force largest_load(const ParticleSet& set) {
  Length lowest = std::min(Length(0.0), set.start.z);
  for (const HandMove& move : set.moves) lowest = std::min(lowest, move.to.z);
  return -(set.setup.springs.normal * lowest);
}

ScratchRun play_scratch(const ParticleSet& set, physics::Frequency rate, std::size_t samples) {
  AFM_CHECK(set.soft && samples >= 2);
  const auto whole = static_cast<std::size_t>(all_ticks(set, rate));
  const ScratchField field = scratch_field(set);
  physics::ScratchingTip tip(set.setup.tip, set.setup.springs, set.soft->surface, field.least, field.most, set.start);
  ScratchRun run;
  ScratchSample now{0.0, tip.last()};
  run.samples.push_back(now);
  run.least_margin_j = scratch_margin_j(now.tick);
  LeverBase from = set.start;
  for (const HandMove& move : set.moves) {
    const std::size_t ticks = ticks_of(from, move, rate);
    ScratchedMove scratched;
    Sums sums;
    for (std::size_t i = 1; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(ticks);
      now.tick = tip.move_to(on_the_way(from, move, share));
      now.time_s = static_cast<double>(++run.ticks) / rate.si;
      if (now.tick.lagging) ++run.lagging;
      run.least_margin_j = std::min(run.least_margin_j, scratch_margin_j(now.tick));
      if (now.tick.state == physics::ScratchState::Marks) scratched.marks = true;
      if (2 * i > ticks) sums.add(now.tick);
      // the sample of this tick: the k-th of N is the tick k/(N - 1) of the way
      if (run.ticks * (samples - 1) >= run.samples.size() * whole) run.samples.push_back(now);
    }
    scratched.end = now;
    scratched.volumes = tip.surface().volumes();
    scratched.load = Force(sums.load_n / sums.count);
    scratched.lateral = Force(sums.lateral_n / sums.count);
    scratched.depth = Length(sums.depth_m / sums.count);
    if (scratched.marks) scratched.section = tip.surface().section(from.position, move.to.position);
    run.moves.push_back(scratched);
    from = move.to;
  }
  run.seconds = now.time_s;
  run.image = image_of(tip.surface(), set);
  return run;
}

}  // namespace afm::scene
