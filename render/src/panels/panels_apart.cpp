// SPDX-License-Identifier: Apache-2.0
// Selection of the panels left out of the eyes' pictures, for a headset that shows their textures itself.
#include <algorithm>
#include <array>
#include <utility>

#include "panels/panels.h"

namespace afm::render {

void Panels::list(std::vector<PanelState>& states) const {
  states.clear();
  const auto add = [&](const Panel& panel) {
    const bool drawn = panel.shown && !panel.apart;
    states.push_back(drawn ? PanelState{true, panel.placement, panel.painting, panel.part} : PanelState{});
  };
  for (const Panel* panel : {&force_, &image_, &loop_, &data_, &banner_, &control_, &calibration_}) add(*panel);
  std::for_each(eye_marks_.begin(), eye_marks_.end(), add);
  std::for_each(labels_.begin(), labels_.end(), add);
}

void Panels::set_apart(std::size_t most, const PanelSight& sight) {
  // with fewer places than panels, the first ones get them
  order_.assign({&banner_, &force_, &image_, &loop_, &data_, &control_});
  for (Panel& label : labels_) order_.push_back(&label);
  std::erase_if(order_, [](const Panel* panel) { return !panel->shown; });
  const std::size_t places = std::min(most, order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i]->has_place = i < places;

  // from the last drawn to the first: a panel shown apart covers everything in the eyes' pictures
  std::rotate(order_.begin(), order_.begin() + (banner_.shown ? 1 : 0), order_.end());
  drawn_.clear();
  for (auto each = order_.rbegin(); each != order_.rend(); ++each) {
    Panel& panel = **each;
    const auto covers = [&](const Panel* later) { return sight.may_overlap(panel.placement, later->placement); };
    const bool apart = panel.has_place && sight.faces(panel.placement) &&
                       std::none_of(drawn_.begin(), drawn_.end(), covers) &&
                       (&panel == &banner_ || !sight.may_be_hidden(panel.placement));
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
  const std::array firsts{&force_, &image_, &loop_, &data_, &control_};
  for (std::size_t i = 0; i < firsts.size(); ++i) add(*firsts[i], i);
  for (std::size_t i = 0; i < labels_.size(); ++i) add(labels_[i], firsts.size() + 1 + i);
  add(banner_, firsts.size());
  return panels;
}

}  // namespace afm::render
