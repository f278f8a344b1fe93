// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exhibit/state/cycle_curve.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// One curve per material: the running cycle, or the last complete one until the tip touches again. A material's curve
// is discarded when other parameters of the material have taken effect. Memory is bounded even if the tip rests for
// long. One thread.
class CycleHistory {
 public:
  explicit CycleHistory(std::size_t materials) : curves_(materials) {}

  void add(const scene::TipSample& sample);
  void add(const scene::TipEvent& event);

  std::span<const CycleCurve> curves() const { return curves_; }
  bool ascending() const { return ascending_; }  // direction of the hand's last motion
  bool pressed() const { return pressed_; }      // below Z = 0 since the tip touched
  int cycles() const { return cycles_; }         // number since the material was put under the tip

  // All of its state, for exhibit/cluster/wall_history.h.
  template <class History, class Visit>
  static void visit_state(History& history, Visit&& visit) {
    for (auto& curve : history.curves_) CycleCurve::visit_state(curve, visit);
    CycleCurve::visit_state(history.next_, visit);
    visit(history.material_);
    visit(history.edit_revision_);
    visit(history.attached_);
    visit(history.released_);
    visit(history.pressed_);
    visit(history.ascending_);
    visit(history.cycles_);
    visit(history.turn_height_m_);
    visit(history.drawn_height_m_);
  }
  bool sound() const;

 private:
  void begin(const scene::TipSample& sample);

  std::vector<CycleCurve> curves_;
  CycleCurve next_;  // the next cycle's approach, since the tip let go
  std::int32_t material_ = -1;
  std::uint32_t edit_revision_ = 0;
  bool attached_ = false;
  bool released_ = false;  // the material's curve is complete
  bool pressed_ = false;
  bool ascending_ = false;
  int cycles_ = 0;
  double turn_height_m_ = 0;   // the hand's extreme height in its direction
  double drawn_height_m_ = 0;  // the hand's height at the newest sample kept
};

}  // namespace afm::exhibit
