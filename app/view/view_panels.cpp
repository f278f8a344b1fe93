// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/enumerators.h"
#include "core/log.h"
#include "exhibit/friction/friction_panel.h"
#include "exhibit/panel_hit.h"
#include "exhibit/scan/scan_panels.h"
#include "render/control_layout.h"

namespace afm::app {

namespace {

constexpr const char* kLoopShown = "friction-loop";  // in sessions

void log_parameters(const curves::LiveParameters& parameters) {
  std::string line = "parameters:";
  for (std::size_t i = 0; i < curves::LiveParameters::kRows; ++i) {
    const auto row = static_cast<curves::LiveParameters::Row>(i);
    line += fmt::format("{} {}", i == 0 ? "" : ",", parameters.value(row));
  }
  core::log_line(line);
}

void log_scan(const exhibit::LiveScan& scan) {
  std::string line = "scan:";
  for (const exhibit::ScanRow row : core::kEnumerators<exhibit::ScanRow>) {
    const std::string value = exhibit::value_text(scan.choice(), row);
    line += fmt::format("{} {}", row == exhibit::ScanRow::Setpoint ? "" : ",", value.empty() ? "one apex" : value);
  }
  core::log_line(line);
}

}  // namespace

ViewPanels::ViewPanels(const exhibit::WallScene& wall_scene, const std::vector<curves::SampleModel>& materials,
                       KeyList key_list)
    : wall_scene_(wall_scene), swatches_(wall_scene.swatch_targets()), edits_(materials), key_list_(key_list) {}

std::string ViewPanels::shown() const {
  if (keys_shown_) return "keys";
  if (hidden_) return "none";
  return right_ == RightPanel::Parameters ? "parameters" : right_ == RightPanel::FrictionLoop ? kLoopShown : "samples";
}

void ViewPanels::show(std::string_view panels) {
  keys_shown_ = panels == "keys";
  hidden_ = panels == "none";
  right_ = panels == "parameters" ? RightPanel::Parameters
           : panels == kLoopShown ? RightPanel::FrictionLoop
                                  : RightPanel::Data;
}

cluster::ShownPanels ViewPanels::told(const Pointed& pointed, HandSource hand) const {
  using Shown = cluster::ShownPanels;
  Shown shown{.right = static_cast<std::uint32_t>(right_),
              .marked = static_cast<std::uint32_t>(std::min<std::size_t>(marked_, Shown::kMostRows - 1)),
              .hand = static_cast<std::uint32_t>(hand)};
  const auto flag = [&](bool set, std::uint32_t bit) { shown.flags |= set ? bit : 0U; };
  flag(keys_shown_, Shown::kKeys);
  flag(hidden_, Shown::kHidden);
  flag(keys_known_, Shown::kKeysKnown);
  flag(marking_, Shown::kMarking);
  flag(unattended_, Shown::kUnattended);
  flag(pointed.tab, Shown::kTab);
  if (pointed.control) {
    shown.flags |= Shown::kControl;
    shown.control_kind = static_cast<std::uint32_t>(pointed.control->kind);
    shown.control_index = static_cast<std::uint32_t>(pointed.control->index);
  }
  return shown;
}

ViewPanels::Told ViewPanels::follow(const cluster::ShownPanels& panels) {
  using Shown = cluster::ShownPanels;
  const auto flag = [&](std::uint32_t bit) { return (panels.flags & bit) != 0; };
  keys_shown_ = flag(Shown::kKeys);
  hidden_ = flag(Shown::kHidden);
  keys_known_ = flag(Shown::kKeysKnown);
  marking_ = flag(Shown::kMarking);
  unattended_ = flag(Shown::kUnattended);
  right_ = static_cast<RightPanel>(panels.right);
  marked_ = panels.marked;
  Told told{.pointed = {.control = {}, .tab = flag(Shown::kTab), .swatch = {}},
            .hand = static_cast<HandSource>(panels.hand)};
  if (flag(Shown::kControl)) {
    told.pointed.control = {static_cast<render::ControlTarget::Kind>(panels.control_kind), panels.control_index};
  }
  return told;
}

Pointed ViewPanels::pointed_at(const input::Ray& ray, const glm::dvec3& wall_point_m,
                               std::optional<std::size_t> material) {
  Pointed pointed{.control = {}, .tab = false, .swatch = {}, .point_m = wall_point_m};
  const render::PanelPlacement panel = wall_scene_.parameter_placement();
  const double millimetre_m = wall_scene_.panel_millimetre_m();
  if (const auto hit = material && right_ == RightPanel::Parameters && !hidden_
                           ? exhibit::hit_of(ray, panel, millimetre_m)
                           : std::nullopt) {
    pointed.control = render::control_at(control_panel(*material, "", exhibit::ChangeState::AsLoaded),
                                         exhibit::size_mm(panel, millimetre_m), hit->place_mm);
    return pointed;
  }
  if (use_ == WallUse::Free && right_ != RightPanel::Parameters && material &&
      exhibit::hit_of(ray, wall_scene_.parameter_tab_placement(), millimetre_m)) {
    pointed.tab = true;
    return pointed;
  }
  pointed.swatch = input::pick(ray, input::kPickConeRad, swatches_);
  if (pointed.swatch) pointed.point_m = swatches_[*pointed.swatch].center_m;
  return pointed;
}

void ViewPanels::press(const Pointed& pointed, std::size_t material, servo::ServoClient* servo) {
  if (pointed.tab) right_ = RightPanel::Parameters;
  if (pointed.control) change(*pointed.control, material, servo);
}

render::ControlPanel ViewPanels::control_panel(std::size_t material, const std::string& title,
                                               exhibit::ChangeState state) {
  render::ControlPanel panel = scan_ != nullptr
                                   ? exhibit::scan_panel(*scan_, title, phrases())
                                   : exhibit::parameter_panel(edits_.of(material), title, state, phrases());
  if (marking_) panel.marked = std::min(marked_, panel.rows.size() - 1);
  return panel;
}

void ViewPanels::mark_next(std::size_t material) {
  const std::size_t rows = control_panel(material, "", exhibit::ChangeState::AsLoaded).rows.size();
  marked_ = marking_ ? (std::min(marked_, rows - 1) + 1) % rows : 0;
  marking_ = true;
  right_ = RightPanel::Parameters;
}

void ViewPanels::step_marked(int steps, std::size_t material, servo::ServoClient* servo) {
  if (!marking_) mark_next(material);
  const std::size_t rows = control_panel(material, "", exhibit::ChangeState::AsLoaded).rows.size();
  marked_ = std::min(marked_, rows - 1);
  right_ = RightPanel::Parameters;
  using Control = render::ControlTarget::Kind;
  change({steps > 0 ? Control::More : Control::Less, marked_}, material, servo);
}

void ViewPanels::change(const render::ControlTarget& target, std::size_t material, servo::ServoClient* servo) {
  const bool button = target.kind == render::ControlTarget::Kind::Button;
  if (button && static_cast<exhibit::PanelButton>(target.index) == exhibit::PanelButton::Close) {
    right_ = RightPanel::Data;
    return;
  }
  if (scan_ != nullptr) {
    if (button) scan_->reset();
    if (!button) {
      const int steps = target.kind == render::ControlTarget::Kind::More ? 1 : -1;
      scan_->step(static_cast<exhibit::ScanRow>(target.index), steps);
    }
    return log_scan(*scan_);
  }
  if (servo == nullptr) return;
  edits_.apply(target, material, *servo);
  const curves::LiveParameters& parameters = edits_.of(material);
  if (parameters.refusal().empty()) return log_parameters(parameters);
  core::log_line("parameters: not changed: " + parameters.refusal());
}

void ViewPanels::add_parameters(render::FrameState& frame, const Pointed& pointed, std::size_t material,
                                const std::string& material_title, const scene::TipState& tip) {
  const curves::LiveParameters& parameters = edits_.of(material);
  const bool shown = right_ == RightPanel::Parameters;
  if (shown) {
    frame.control_panel = control_panel(material, material_title, edits_.state(material, tip));
    frame.control_panel.pointed = pointed.control;
    frame.control_placement = wall_scene_.parameter_placement();
    frame.data_placement = render::kNoPlacement;
  } else {
    frame.labels.push_back({.text = phrases()[exhibit::Phrase::ChangeParameters],
                            .highlighted = pointed.tab,
                            .placement = wall_scene_.parameter_tab_placement()});
  }
  if (right_ == RightPanel::FrictionLoop && friction_ != nullptr) {
    frame.loop_panel = exhibit::friction_panel(*friction_, parameters.model().parameters.friction.law, phrases());
    frame.loop_placement = wall_scene_.parameter_placement();
    frame.data_placement = render::kNoPlacement;
  }
  if (shown || parameters.changed()) exhibit::add_prediction(parameters, phrases(), frame.force_panel);
}

void ViewPanels::add_note(render::FrameState& frame, exhibit::Centerpiece centerpiece,
                          const std::string& caption) const {
  using exhibit::Note;
  if (!caption.empty()) {
    frame.labels.push_back({.text = caption, .highlighted = false, .placement = wall_scene_.note_placement()});
    return;
  }
  std::string text;
  if (centerpiece == exhibit::Centerpiece::Journey) text = note_text(phrases(), Note::LeaveJourney);
  if (centerpiece == exhibit::Centerpiece::Analogy) text = note_text(phrases(), Note::LeaveAnalogy);
  if (!keys_known_) text += (text.empty() ? "" : "     ") + note_text(phrases(), Note::Keys);
  if (text.empty()) return;
  frame.labels.push_back({.text = std::move(text), .highlighted = false, .placement = wall_scene_.note_placement()});
}

void ViewPanels::add_to(render::FrameState& frame, const Pointed& pointed, std::optional<std::size_t> material,
                        const std::string& material_title, const scene::TipState& tip, HandSource hand) {
  if (material && use_ == WallUse::Free) add_parameters(frame, pointed, *material, material_title, tip);
  if (hidden_) {
    frame.force_placement = frame.image_placement = frame.loop_placement = frame.data_placement =
        frame.control_placement = render::kNoPlacement;
  }
  if (keys_shown_) {
    frame.data_panel = key_list_(hand, unattended_, phrases(), use_);
    frame.data_placement = wall_scene_.parameter_placement();
    frame.loop_placement = frame.control_placement = render::kNoPlacement;
  }
}

void add_panels(const exhibit::Stage& stage, ViewPanels& panels, const exhibit::Moment& moment,
                const Panelled& panelled, const std::string& caption, render::FrameState& frame) {
  const bool travels = moment.wall.centerpiece == exhibit::Centerpiece::Journey;
  const auto material = travels || panelled.tip.material < 0
                            ? std::nullopt
                            : std::optional(static_cast<std::size_t>(panelled.tip.material));
  panels.add_to(frame, panelled.pointed, material,
                material ? stage.phrases().word(stage.materials.materials[*material].title) : "", panelled.tip,
                panelled.hand);
  panels.add_note(frame, moment.wall.centerpiece, caption);
}

}  // namespace afm::app
