// SPDX-License-Identifier: Apache-2.0
#include "write_trial.h"

#include "scene/samples/particle_set.h"

namespace afm::exhibit {

using physics::EventKind;

WriteTrial::WriteTrial(const scene::ParticleSet& set, const LinesToWrite& lines)
    : grid_(mark_grid(set)), lines_(lines), task_(set, {}) {}

void WriteTrial::add(const scene::TipEvent& event) {
  const bool back = event.kind == EventKind::PushTakenBack || event.kind == EventKind::ParticlesPutBack;
  if (!back) return;
  ++changes_;
  fault_.reset();
  task_.add(EventKind::PushTakenBack);  // trial continued, with its clock
}

// Tiles are published after the stroke that has changed them, so a stroke is a change while the tip is on the sample.
void WriteTrial::add(const scene::TipSample& sample) {
  const bool on = sample.push.state != physics::PushState::Free;
  if ((on || was_on_) && sample.push.digest != digest_) ++changes_;
  digest_ = sample.push.digest;
  was_on_ = on;
  const auto& [x_m, y_m] = sample.surface.xy_m;
  task_.add(scene::TaskTick{.time_ns = sample.time_ns,
                            .base_m = {x_m, y_m, sample.tip.z_m},
                            .lateral_n = sample.push.lateral_n,
                            .lift_n = sample.push.lift_n,
                            .places = changes_,
                            .carries = on,
                            .truth = true});
}

bool WriteTrial::look(std::span<const scene::MarkTile> tiles) {
  if (!task_.unjudged() || tiles.size() != scene::kMarkTiles || scene::digest_of(tiles) != digest_) return false;
  written_ = written_lines(tiles, grid_, lines_);
  const auto fault = fault_of(written_, lines_);
  if (fault) {
    task_.judge({});  // wait for another stroke
    const bool bare = fault == WritingFault::LinesLeft && written_.share == 0.0;
    fault_ = bare ? std::nullopt : fault;
    return false;
  }
  task_.end(physics::Length(written_.off_m));
  return true;
}

}  // namespace afm::exhibit
