// SPDX-License-Identifier: Apache-2.0
// Selection of the panels left out of the eyes' pictures, for a headset that shows their textures itself.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "panels/panels.h"

namespace afm::render {

void Panels::list(std::vector<PanelState>& states) const {
  states.clear();
  const auto add = [&](const Panel& panel) {
    const bool drawn = panel.shown && !panel.apart;
    states.push_back(drawn ? PanelState{true, panel.placement, panel.painting, panel.part} : PanelState{});
  };
  std::for_each(slots_.begin(), slots_.end(), add);
  std::for_each(eye_marks_.begin(), eye_marks_.end(), add);
  std::for_each(labels_.begin(), labels_.end(), add);
}

void Panels::set_apart(std::size_t most, const PanelSight& sight) {
  // if there are fewer places than panels, the first panels get them
  order_.clear();
  const auto add_all = [&](PanelLayer layer) {
    for (Panel& panel : slots_) {
      if (panel.shown && panel.layer == layer) order_.push_back(&panel);
    }
  };
  add_all(PanelLayer::OverAll);
  const auto over_all = static_cast<std::ptrdiff_t>(order_.size());
  add_all(PanelLayer::InScene);
  for (Panel& label : labels_) {
    if (label.shown) order_.push_back(&label);
  }
  const std::size_t places = std::min(most, order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i]->has_place = i < places;

  // from the last drawn to the first, since a panel shown apart covers everything drawn
  std::rotate(order_.begin(), order_.begin() + over_all, order_.end());
  drawn_.clear();
  for (auto each = order_.rbegin(); each != order_.rend(); ++each) {
    Panel& panel = **each;
    const auto covers = [&](const Panel* later) { return sight.may_overlap(panel.placement, later->placement); };
    const bool apart = panel.has_place && sight.faces(panel.placement) &&
                       std::none_of(drawn_.begin(), drawn_.end(), covers) &&
                       (panel.layer == PanelLayer::OverAll || !sight.may_be_hidden(panel.placement));
    if (std::exchange(panel.apart, apart) != apart) ++revision_;
    if (!apart) drawn_.push_back(&panel);
  }
}

std::vector<ApartPanel> Panels::apart() const {
  std::vector<ApartPanel> panels;
  const auto add = [&](const Panel& panel, std::size_t place) {
    if (!panel.shown || !panel.apart) return;
    panels.push_back({place, panel.placement, *panel.texture.image.image, panel.texture.image.extent, panel.painting});
  };
  const auto add_all = [&](PanelLayer layer) {
    for (std::size_t i = 0; i < kSlots; ++i) {
      if (slots_[i].layer == layer) add(slots_[i], i);
    }
  };
  add_all(PanelLayer::InScene);
  for (std::size_t i = 0; i < labels_.size(); ++i) add(labels_[i], kSlots + i);
  add_all(PanelLayer::OverAll);
  return panels;
}

}  // namespace afm::render
