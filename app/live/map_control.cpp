// SPDX-License-Identifier: Apache-2.0
#include "app/live/map_control.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "core/enumerators.h"
#include "core/log.h"
#include "core/printable.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/force_volume.h"
#include "exhibit/scan/map_picture.h"
#include "exhibit/state/moment.h"
#include "physics/quantity_text.h"
#include "scene/shared/map_vibration.h"
#include "servo/servo_client.h"
#include "servo/wall_frame.h"

namespace afm::app {

namespace {

// Largest 1, 2 or 5 times a power of ten that is not above `value`.
double round_below(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= value) return factor * decade;
  }
  return decade;
}

void log_surface(const curves::ForceVolume& volume, double force_n) {
  core::log_line(fmt::format("force map: the surface of {}, which {} of {} curves reach",
                             physics::format_quantity(physics::Force(force_n), physics::kForceUnits, 3),
                             volume.reached(force_n), volume.known()));
}

}  // namespace

MapControl::MapControl(ViewParts& parts, std::optional<double> equal_force_n)
    : parts_(parts), equal_force_n_(equal_force_n), overlay_(parts.stage, parts.panels) {
  const curves::ForceVolume* volume = MapOverlay::volume_of(parts.stage);
  if (volume == nullptr) return;
  if (equal_force_n_) {
    seen_ = first_ = Seen::Surface;
    log_surface(*volume, *equal_force_n_);
  } else {
    equal_force_n_ = round_below(0.5 * volume->strongest_push_n());
  }
}

void MapControl::next_volume() {
  const curves::ForceVolume* volume = MapOverlay::volume_of(parts_.stage);
  if (volume == nullptr) {
    return core::log_line(
        "force map: only one that is felt whole has a slice; start with --force-map FILE --fit SHAPE --felt map");
  }
  constexpr auto kAll = core::kEnumerators<Seen>;
  seen_ = kAll[(core::index_of(seen_) + 1) % kAll.size()];
  if (seen_ == Seen::Nothing) return core::log_line("force map: no slice and no surface");
  if (seen_ != Seen::Surface) core::log_line("force map: a slice shows the forces along the tip's line");
  if (seen_ != Seen::Slice) log_surface(*volume, *equal_force_n_);
}

const curves::SampleModel* MapControl::map() const {
  if (!wall_.material || wall_.centerpiece != exhibit::Centerpiece::Instrument) return nullptr;
  const curves::SampleModel& sample = parts_.choice.felt()[*wall_.material];
  return sample.felt_map ? &sample : nullptr;
}

MapView MapControl::view() const {
  MapView view{.slice = seen_ == Seen::Slice || seen_ == Seen::Both};
  if (seen_ == Seen::Surface || seen_ == Seen::Both) view.equal_force_n = equal_force_n_;
  return view;
}

// Adds the map to the wall, whose content the earlier controls have decided.
void MapControl::add_to_moment(exhibit::Moment& now, ViewFrame& /*frame*/) {
  wall_ = now.wall;
  retracting_ = now.retracting;
  check_vibration();
}

void MapControl::check_vibration() {
  const curves::SampleModel* sample = checked_ ? nullptr : map();
  if (sample == nullptr || sample->parameters.map_vibration == scene::MapVibration::None || !parts_.servo.running())
    return;
  const scene::SharedDevice& device = parts_.servo.link().device();
  if (device.max_force_n == 0.0) return;  // unknown device
  checked_ = true;
  if (device.max_vibration_n > 0.0) return;
  core::log_line(fmt::format("force map: the profile of the {} has no vibration; the map is felt without it",
                             core::printable_line(device.name.data())));
}

void MapControl::add_to_session(servo::WallFrame& shown) const {
  const curves::SampleModel* sample = map();
  if (sample == nullptr) return add_pixel_to_session(shown);
  parts_.panels.picture_of(*sample->pixel);
  const scene::LawHere& here = parts_.servo.link().tip().here;
  const MapView seen = view();
  shown.map = servo::RecordedMapView{.quantity = std::string(exhibit::name_of(parts_.panels.map_quantity())),
                                     .slice = seen.slice,
                                     .equal_force_n = seen.equal_force_n,
                                     .reduced_modulus_pa = here.reduced_modulus_pa,
                                     .adhesion_j_per_m2 = here.adhesion_j_per_m2};
}

// Quantity in the panel's picture, in which the felt pixel is marked.
void MapControl::add_pixel_to_session(servo::WallFrame& shown) const {
  if (!wall_.material) return;
  const curves::SampleModel& sample = parts_.choice.felt()[*wall_.material];
  if (!sample.pixel) return;
  parts_.panels.picture_of(*sample.pixel);
  shown.map = servo::RecordedMapView{.quantity = std::string(exhibit::name_of(parts_.panels.map_quantity()))};
}

void MapControl::add_to_picture(render::FrameState& picture, const ViewFrame& /*frame*/) {
  const curves::SampleModel* sample = map();
  if (sample != nullptr) overlay_.add_to(picture, *sample, wall_, retracting_, view());
}

void MapControl::restart(Restart what) {
  checked_ = false;
  if (what != Restart::Servo) seen_ = first_;
}

}  // namespace afm::app
