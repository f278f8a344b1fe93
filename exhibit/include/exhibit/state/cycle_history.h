// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exhibit/state/cycle_curve.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// One curve per material: the running cycle, or the last complete one until the tip touches again. Discards a
// material's curve when new parameters have taken effect. Memory is bounded even if the tip rests for
// long. One thread.
class CycleHistory {
 public:
  explicit CycleHistory(std::size_t materials) : curves_(materials) {}

  void add(const scene::TipSample& sample);
  void add(const scene::TipEvent& event);

  std::span<const CycleCurve> curves() const { return curves_; }
  bool ascending() const { return ascending_; }  // direction of the hand's last motion
  bool pressed() const { return pressed_; }      // true: below Z = 0 at some time since the tip touched
  int cycles() const { return cycles_; }         // number of cycles since the material was put under the tip

  // All of the object's state, for storage by exhibit/cluster/wall_history.h.
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
  CycleCurve next_;  // approach of the next cycle, since the tip came off
  std::int32_t material_ = -1;
  std::uint32_t edit_revision_ = 0;
  bool attached_ = false;
  bool released_ = false;  // true: material's curve complete
  bool pressed_ = false;
  bool ascending_ = false;
  int cycles_ = 0;
  double turn_height_m_ = 0;   // extreme height of the hand in its current direction
  double drawn_height_m_ = 0;  // height of the hand at the newest stored sample
};

}  // namespace afm::exhibit
