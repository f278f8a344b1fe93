// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_pointer.h"

#include <utility>

#include "app/display/view_picture.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_panels.h"
#include "app/view/view_wand.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/scenery/wall_layout.h"

namespace afm::app {

namespace {

constexpr double kDrawnHandM = 0.085;  // hand travel that is drawn as long as the stroke of a sample's cycle

constexpr double kBelowWandM = 0.12;  // in layout metres

}  // namespace

glm::dvec3 mouse_grip_m(const exhibit::WallScene& scene) {
  const exhibit::WallPlaces& places = scene.places();
  glm::dvec3 grip_m = places.wand_grip_m();
  if (scene.swatch_targets().size() < exhibit::kFrontSwatches) {
    grip_m -= kBelowWandM * glm::dvec3(places.room_from_layout()[1]);
  }
  return grip_m;
}

ViewPointer::ViewPointer(const exhibit::Stage& stage, ViewPicture& picture, ViewPanels& panels, ServoSupervisor& servo,
                         ViewWand& wand)
    : stage_(stage),
      picture_(picture),
      panels_(panels),
      servo_(servo),
      view_wand_(wand),
      mouse_(stage.screen, mouse_grip_m(stage.wall_scene)),
      swatches_(stage.wall_scene.swatch_targets()) {}

void ViewPointer::follow(const glm::dvec2& cursor_px, bool dragging, std::int64_t now_ns) {
  dragging_ = dragging;
  if (std::exchange(cursor_px_, cursor_px) != cursor_px && !dragging) cursor_moved_ns_ = now_ns;
}

exhibit::Pointer ViewPointer::kind() const {
  const bool wand = view_wand_.points() && view_wand_.used_ns() >= cursor_moved_ns_;
  return wand ? exhibit::Pointer::Wand : exhibit::Pointer::Mouse;
}

input::Ray ViewPointer::ray(std::size_t window, const glm::dvec2& cursor_px) const {
  return mouse_.ray(picture_.picture(window), cursor_px);
}

Pointed ViewPointer::at(std::size_t window, const glm::dvec2& cursor_px) {
  const input::Ray ray = this->ray(window, cursor_px);
  return panels_.pointed_at(ray, mouse_.wall_point(ray), servo_.material());
}

// Like at(), but uses the target that the wand's ray has snapped to, if there is one.
Pointed ViewPointer::at_wand() {
  const input::Ray ray = input::ray_of(view_wand_.state());
  Pointed pointed = panels_.pointed_at(ray, mouse_.wall_point(ray), servo_.material());
  if (pointed.control || pointed.tab) return pointed;
  pointed.swatch = view_wand_.hovered();
  if (pointed.swatch) pointed.point_m = swatches_[*pointed.swatch].center_m;
  return pointed;
}

Pointed ViewPointer::now(std::size_t window, const glm::dvec2& cursor_px) {
  return kind() == exhibit::Pointer::Wand ? at_wand() : at(window, cursor_px);
}

std::optional<input::WandState> ViewPointer::drawn(const Pointed& pointed, std::int64_t now_ns) const {
  if (kind() == exhibit::Pointer::Wand) return view_wand_.state();
  if (dragging_) return std::nullopt;  // nothing to point at; the stick would cross lever and sample
  return mouse_.towards(pointed.point_m, now_ns);
}

double ViewPointer::hand_m_per_px(std::size_t window) const {
  const WallPicture shown = picture_.picture(window);
  const double stroke_m = exhibit::kStrokeHeight * stage_.wall_scene.unit_m();
  return kDrawnHandM / stroke_m * shown.screen.height_m() / shown.place.size_px.y;
}

}  // namespace afm::app
