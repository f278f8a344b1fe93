// SPDX-License-Identifier: Apache-2.0
#include "app/live/map_control.h"

#include <fmt/format.h>

#include <cmath>

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
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/map_picture.h"
#include "exhibit/scan/map_relief.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/scan/volume_view.h"
#include "exhibit/state/moment.h"
#include "physics/quantity_text.h"
#include "scene/shared/map_vibration.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

// Null if no map is felt whole, or if it has no curve to look at.
const curves::ForceVolume* volume_of(const exhibit::Stage& stage) {
  if (!stage.pixel || !stage.pixel->felt_map || !stage.pixel->felt_map->volume) return nullptr;
  return stage.pixel->felt_map->volume->known() > 0 ? stage.pixel->felt_map->volume.get() : nullptr;
}

// 1, 2 or 5 times a power of ten, not above.
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

struct MapControl::Laid {
  exhibit::MapQuantity quantity{};
  double release_z_m = 0;  // as in exhibit::WallState: the sample's size
  exhibit::HeightRelief relief;
};

MapControl::MapControl(ViewParts& parts, std::optional<double> equal_force_n)
    : parts_(parts), equal_force_n_(equal_force_n) {
  const curves::ForceVolume* volume = volume_of(parts.stage);
  if (volume == nullptr) return;
  if (equal_force_n_) {
    seen_ = first_ = Seen::Surface;
    log_surface(*volume, *equal_force_n_);
  } else {
    equal_force_n_ = round_below(0.5 * volume->strongest_push_n());
  }
}

MapControl::~MapControl() = default;

void MapControl::next_volume() {
  const curves::ForceVolume* volume = volume_of(parts_.stage);
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

// The controls before this one have decided what the wall shows.
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
  if (device.max_force_n == 0.0) return;  // not known yet
  checked_ = true;
  if (device.max_vibration_n > 0.0) return;
  core::log_line(fmt::format("force map: the profile of the {} has no vibration; the map is felt without it",
                             core::printable_line(device.name.data())));
}

void MapControl::add_to_picture(render::FrameState& picture, const ViewFrame& /*frame*/) {
  const curves::SampleModel* sample = map();
  if (sample == nullptr) return;
  lay_colours(*sample, picture);
  if (seen_ == Seen::Nothing || volume_of(parts_.stage) == nullptr) return;
  if (!volume_) volume_ = std::make_unique<exhibit::VolumeView>(parts_.stage.wall_scene);
  using Way = curves::ForceVolume::Way;
  if (seen_ != Seen::Slice) volume_->add_surface(*sample, wall_, *equal_force_n_, picture);
  if (seen_ == Seen::Surface) return;
  volume_->add_slice(*sample, wall_, retracting_ ? Way::Retract : Way::Approach, picture);
}

void MapControl::restart(Restart what) {
  checked_ = false;
  if (what != Restart::Servo) seen_ = first_;
}

// Heights are those of the sample's own colours; an image, and the colours of key E, show them, too.
void MapControl::lay_colours(const curves::SampleModel& map, render::FrameState& picture) {
  if (wall_.scan || wall_.false_colours) return;
  const render::MapPicture& shown = parts_.panels.picture_of(*map.pixel);
  const exhibit::MapQuantity quantity = parts_.panels.map_quantity();
  if (quantity == exhibit::MapQuantity::Height) return;
  const double release_z_m = map.scaling.release_z_m();
  if (!laid_ || laid_->quantity != quantity || laid_->release_z_m != release_z_m) {
    const exhibit::ScanSubject subject = exhibit::scan_subject(parts_.stage.wall_scene, *wall_.material, map);
    laid_ = std::make_unique<const Laid>(Laid{quantity, release_z_m, exhibit::map_relief(shown, map, subject)});
  }
  exhibit::lay_map(laid_->relief, shown, parts_.stage.wall_scene, wall_, picture);
}

}  // namespace afm::app
