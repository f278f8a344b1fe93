// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "cluster/frame_message.h"
#include "core/enumerators.h"
#include "core/log.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/friction/friction_panel.h"
#include "exhibit/panels/panel_hit.h"
#include "exhibit/panels/parameter_panel.h"
#include "exhibit/panels/scratch_panel.h"
#include "exhibit/panels/swing_panel.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/map_picture.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/state/moment.h"
#include "exhibit/state/particles_now.h"
#include "exhibit/words/guidance.h"
#include "render/control_layout.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/field_copy.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

struct RightRow {
  RightPanel panel;
  std::string_view word;  // name in sessions
};
constexpr std::array<RightRow, 4> kRightPanels{{{RightPanel::Data, "samples"},
                                                {RightPanel::Parameters, "parameters"},
                                                {RightPanel::FrictionLoop, "friction-loop"},
                                                {RightPanel::Sources, "sources"}}};
static_assert(core::has_row_for_each(kRightPanels, &RightRow::panel));
static_assert(kRightPanels.size() <= cluster::ShownPanels::kMostRight);

// Copies the ray's position and the hand's source, in either direction.
template <class Copy, class Told, class Shown>
void copy_pointed(const Copy& copy, Told& told, Shown& shown) {
  using S = cluster::ShownPanels;
  auto& pointed = told.pointed;
  copy(told.hand, shown.hand);
  copy.flag(pointed.tab, shown.flags, S::kTab);
  if (copy.has(pointed.control, shown.flags, S::kControl)) {
    copy(pointed.control->kind, shown.control_kind);
    copy(pointed.control->index, shown.control_index);
  }
}

void log_parameters(const curves::LiveParameters& parameters) {
  if (const auto& pixel = parameters.model().pixel) {
    const bool doubtful = pixel->measured.features.contact_doubtful;
    return core::log_line(fmt::format("force map: pixel {}{}", curves::text_of(pixel->place),
                                      doubtful ? ", whose contact point is doubtful" : ""));
  }
  std::string line = "parameters:";
  for (const curves::LiveParameters::Row row : parameters.rows()) {
    line += fmt::format("{} {}", row == parameters.rows().front() ? "" : ",", parameters.value(row));
  }
  core::log_line(line);
}

void log_change(const curves::LiveParameters& parameters) {
  if (parameters.refusal().empty()) return log_parameters(parameters);
  core::log_line("parameters: not changed: " + parameters.refusal());
}

void log_scan(const exhibit::LiveScan& scan) {
  std::string line = "scan:";
  for (const exhibit::ScanRow row : scan.rows()) {
    const std::string value = exhibit::value_text(scan.choice(), row);
    line += fmt::format("{} {}", row == exhibit::ScanRow::Setpoint ? "" : ",", value.empty() ? "one apex" : value);
  }
  core::log_line(line);
}

// Adds the felt quantities of a whole map below the tip, and the place in its picture.
void add_map(const curves::SampleModel& model, const scene::TipState& tip, const exhibit::Phrases& phrases,
             render::ControlPanel& panel) {
  if (!model.felt_map) return;
  panel.notes = exhibit::felt_map_notes(model, tip, phrases);
  const auto pixel = curves::pixel_below(model, tip.surface.xy_m);
  if (pixel && panel.picture) panel.picture->marked = exhibit::target_index(*pixel, *model.pixel->map);
}

}  // namespace

ViewPanels::ViewPanels(const exhibit::WallScene& wall_scene, const std::vector<curves::SampleModel>& materials,
                       KeyList key_list)
    : wall_scene_(wall_scene),
      swatches_(wall_scene.swatch_targets()),
      edits_(materials),
      key_list_(key_list),
      dial_(std::make_shared<exhibit::SwingDial>()) {
  const auto is_of_map = [](const curves::SampleModel& material) { return material.pixel != nullptr; };
  if (std::any_of(materials.begin(), materials.end(), is_of_map)) right_ = RightPanel::Parameters;
}

const exhibit::Phrases& ViewPanels::phrases() const { return wall_scene_.phrases(); }

std::string ViewPanels::shown() const {
  if (keys_shown_) return "keys";
  if (hidden_) return "none";
  return std::string(kRightPanels[core::index_of(right_)].word);
}

void ViewPanels::show(std::string_view panels) {
  keys_shown_ = panels == "keys";
  hidden_ = panels == "none";
  const auto row = std::find_if(kRightPanels.begin(), kRightPanels.end(),
                                [&](const RightRow& candidate) { return candidate.word == panels; });
  right_ = row == kRightPanels.end() ? RightPanel::Data : row->panel;
}

template <class Copy, class Panels, class Shown>
void ViewPanels::copy_state(const Copy& copy, Panels& panels, Shown& shown) {
  using S = cluster::ShownPanels;
  copy.flag(panels.keys_shown_, shown.flags, S::kKeys);
  copy.flag(panels.hidden_, shown.flags, S::kHidden);
  copy.flag(panels.keys_known_, shown.flags, S::kKeysKnown);
  copy.flag(panels.marking_, shown.flags, S::kMarking);
  copy.flag(panels.unattended_, shown.flags, S::kUnattended);
  copy(panels.right_, shown.right);
  copy(panels.marked_, shown.marked);
}

cluster::ShownPanels ViewPanels::told(const Pointed& pointed, HandSource hand) const {
  cluster::ShownPanels shown;
  copy_state(scene::CopyOut(), *this, shown);
  if (edits_.builds()) shown.flags |= cluster::ShownPanels::kBuilding;
  shown.marked = std::min(shown.marked, cluster::ShownPanels::kMostRows - 1);
  const Told told{.pointed = pointed, .hand = hand};
  copy_pointed(scene::CopyOut(), told, shown);
  return shown;
}

ViewPanels::Told ViewPanels::follow(const cluster::ShownPanels& panels) {
  copy_state(scene::CopyBack(), *this, panels);
  edits_.set_builds_elsewhere((panels.flags & cluster::ShownPanels::kBuilding) != 0);
  if (!core::is_enumerator(right_)) right_ = RightPanel::Data;
  Told told;
  copy_pointed(scene::CopyBack(), told, panels);
  return told;
}

Pointed ViewPanels::pointed_at(const input::Ray& ray, const glm::dvec3& wall_point_m,
                               std::optional<std::size_t> material) {
  Pointed pointed{.control = {}, .tab = false, .swatch = {}, .point_m = wall_point_m};
  const render::PanelPlacement panel = right_place();
  const double millimetre_m = wall_scene_.panel_millimetre_m();
  if (keys_shown_) return pointed;
  if (const auto hit = material && right_ == RightPanel::Parameters && !hidden_
                           ? exhibit::hit_of(ray, panel, millimetre_m)
                           : std::nullopt) {
    pointed.control = render::control_at(control_panel(*material, "", exhibit::ChangeState::AsLoaded),
                                         exhibit::size_mm(panel, millimetre_m), hit->place_mm);
    return pointed;
  }
  if (use_ != WallUse::Lesson && right_ != RightPanel::Parameters && !hidden_ && material &&
      exhibit::hit_of(ray, wall_scene_.places().parameter_tab(), millimetre_m)) {
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
  const curves::SampleModel& chosen = edits_.of(material).model();
  render::ControlPanel panel =
      scan_ != nullptr
          ? exhibit::scan_panel(*scan_, title, phrases())
          : exhibit::parameter_panel(edits_.of(material), chosen.pixel ? chosen.setup.material.title : title, state,
                                     phrases(), drawn_by_);
  if (scan_ == nullptr && chosen.pixel) panel.picture = picture_of(*chosen.pixel);
  if (marking_ && !panel.rows.empty()) panel.marked = std::min(marked_, panel.rows.size() - 1);
  return panel;
}

const render::MapPicture& ViewPanels::picture_of(const curves::MapCurve& pixel) {
  if (std::exchange(pictured_, pixel.map) != pixel.map) {
    quantity_ = exhibit::first_quantity(*pixel.map);
    picture_ = exhibit::map_picture(*pixel.map, pixel.place, phrases(), quantity_);
  }
  picture_.marked = exhibit::target_index(pixel.place, *pixel.map);
  return picture_;
}

void ViewPanels::show_map_quantity(const curves::MapCurve& pixel, exhibit::MapQuantity quantity) {
  picture_of(pixel);
  quantity_ = quantity;
  picture_ = exhibit::map_picture(*pixel.map, pixel.place, phrases(), quantity_);
}

void ViewPanels::next_map_picture() {
  if (!pictured_ || pictured_->fits().empty()) {
    return core::log_line("force map: only a fitted one has more pictures; start with --force-map FILE --fit SHAPE");
  }
  quantity_ = exhibit::next_quantity(*pictured_, quantity_);
  picture_ = exhibit::map_picture(*pictured_, pictured_->middle(), phrases(), quantity_);
  core::log_line(fmt::format("force map: the picture shows the {}, {} to {}", exhibit::name_of(quantity_),
                             picture_.lowest, picture_.highest));
}

void ViewPanels::toggle_sources() {
  core::log_line(toggle(RightPanel::Sources) ? "panels: the sources of the numbers are shown"
                                             : "panels: the sources of the numbers are hidden");
}

void ViewPanels::mark_next(std::size_t material) {
  const std::size_t rows = control_panel(material, "", exhibit::ChangeState::AsLoaded).rows.size();
  right_ = RightPanel::Parameters;
  if (rows == 0) return;
  marked_ = marking_ ? (std::min(marked_, rows - 1) + 1) % rows : 0;
  marking_ = true;
}

void ViewPanels::step_marked(int steps, std::size_t material, servo::ServoClient* servo) {
  if (!marking_) mark_next(material);
  const std::size_t rows = control_panel(material, "", exhibit::ChangeState::AsLoaded).rows.size();
  if (rows == 0) return;
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
  if (edits_.apply(target, material, *servo)) log_change(edits_.of(material));
}

void ViewPanels::take_built(servo::ServoClient& servo) {
  for (const std::size_t material : edits_.take_built(servo)) log_change(edits_.of(material));
}

// Adds the tab that opens the parameters, and the curve computed from them.
void ViewPanels::add_parameters(render::FrameState& frame, const Pointed& pointed, std::size_t material) {
  const curves::LiveParameters& parameters = edits_.of(material);
  const bool open = right_ == RightPanel::Parameters;
  if (!open && !covered()) {
    const bool of_map = parameters.model().pixel != nullptr;
    frame.labels.push_back(
        {.text = phrases()[of_map ? exhibit::Phrase::ChangePixel : exhibit::Phrase::ChangeParameters],
         .highlighted = pointed.tab,
         .placement = wall_scene_.places().parameter_tab()});
  }
  if (parameters.model().felt_map) return;  // no single curve, since it changes from place to place
  render::ForcePanel& plot = frame.panels.force.content;
  if (open || parameters.changed()) return exhibit::add_prediction(parameters, phrases(), plot);
  exhibit::add_forecast(parameters, phrases(), plot);
}

render::PanelPlacement ViewPanels::right_place() const {
  const exhibit::WallPlaces& places = wall_scene_.places();
  return places.far() ? places.far()->right : places.parameters();
}

// Shows the panel instead of the sample's or the particles' data if there is no room beyond them.
template <class Content>
void ViewPanels::show_right(render::FramePanels& panels, render::PanelSlot<Content>& slot, Content content) const {
  if (!wall_scene_.places().far()) panels.data.placement = panels.particles.placement = render::kNoPlacement;
  slot = {.content = std::move(content), .placement = right_place()};
}

void ViewPanels::add_right(render::FramePanels& panels, const Pointed& pointed, std::size_t material,
                           const std::string& material_title, const scene::TipState& tip) {
  switch (right_) {
    case RightPanel::Data:
    case RightPanel::Sources:
      return;
    case RightPanel::Parameters:
      show_right(panels, panels.control, control_panel(material, material_title, edits_.shown_state(material, tip)));
      panels.control.content.pointed = pointed.control;
      if (scan_ == nullptr) add_map(edits_.of(material).model(), tip, phrases(), panels.control.content);
      return;
    case RightPanel::FrictionLoop:
      if (const curves::SampleModel& model = edits_.of(material).model(); model.taps()) {
        return show_right(panels, panels.loop, dial_->panel(model, tip, phrases()));
      }
      if (friction_ == nullptr) return;
      const physics::FrictionParameters& friction = edits_.of(material).model().parameters.friction;
      show_right(panels, panels.loop, exhibit::friction_panel(*friction_, friction, phrases()));
      return;
  }
}

void ViewPanels::add_note(render::FrameState& frame, exhibit::Centerpiece centerpiece,
                          const std::string& caption) const {
  using exhibit::Note;
  if (covered()) return;
  if (!caption.empty()) {
    frame.labels.push_back({.text = caption, .highlighted = false, .placement = wall_scene_.places().note()});
    return;
  }
  std::string text;
  if (centerpiece == exhibit::Centerpiece::Journey) text = note_text(phrases(), Note::LeaveJourney);
  if (centerpiece == exhibit::Centerpiece::Analogy) text = note_text(phrases(), Note::LeaveAnalogy);
  if (!keys_known_) text += (text.empty() ? "" : "     ") + note_text(phrases(), Note::Keys);
  if (text.empty()) return;
  frame.labels.push_back({.text = std::move(text), .highlighted = false, .placement = wall_scene_.places().note()});
}

void ViewPanels::add_to(render::FrameState& frame, const Pointed& pointed, std::optional<std::size_t> material,
                        const std::string& material_title, const scene::TipState& tip, HandSource hand,
                        std::string_view letters) {
  const bool changeable = material && use_ != WallUse::Lesson &&
                          (!edits_.of(*material).rows().empty() || edits_.of(*material).model().felt_map);
  if (changeable) add_parameters(frame, pointed, *material);
  render::FramePanels& panels = frame.panels;
  if (right_ == RightPanel::Sources && use_ != WallUse::Lesson) {
    panels.data.content.details = panels.particles.content.details = true;
  }
  const auto& far = wall_scene_.places().far();
  if (far && right_ == RightPanel::Data && use_ == WallUse::Free && material) {
    panels.particles = {.content = panels.data.content, .placement = far->right};
    panels.particles.content.details = true;
  }
  if (covered()) {
    const render::PanelPlacement banner = panels.banner.placement;
    hide(panels);
    panels.banner.placement = banner;
  }
  if (keys_shown_) {
    panels.keys = {.content = {key_list_(hand, unattended_, phrases(), use_, letters)},
                   .placement = wall_scene_.places().keys()};
  } else if (changeable && !hidden_) {
    add_right(panels, pointed, *material, material_title, tip);
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
                panelled.hand, moment.letters);
  if (moment.wall.particles != nullptr && scene::leaves_marks(*moment.wall.particles->set) &&
      exhibit::pushes_particles(panelled.tip)) {
    exhibit::leave_law_out(*moment.wall.particles, stage.phrases(), frame.panels.force.content);
  }
  panels.add_note(frame, moment.wall.centerpiece, caption);
}

}  // namespace afm::app
