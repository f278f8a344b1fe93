// SPDX-License-Identifier: Apache-2.0
#include "app/live/map_control.h"

#include "app/view/view_choice.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "core/log.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/map_relief.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/state/moment.h"

namespace afm::app {

namespace {

// Null if no map is felt whole, or if it has no curve to look at.
const curves::ForceVolume* volume_of(const exhibit::Stage& stage) {
  if (!stage.pixel || !stage.pixel->felt_map || !stage.pixel->felt_map->volume) return nullptr;
  return stage.pixel->felt_map->volume->known() > 0 ? stage.pixel->felt_map->volume.get() : nullptr;
}

}  // namespace

void MapControl::toggle_slice() {
  if (volume_of(parts_.stage) == nullptr) {
    return core::log_line(
        "force map: only one that is felt whole has a slice; start with --force-map FILE --fit SHAPE --felt map");
  }
  slice_ = !slice_;
  core::log_line(slice_ ? "force map: a slice shows the forces along the tip's line" : "force map: no slice");
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
}

void MapControl::add_to_picture(render::FrameState& picture, const ViewFrame& /*frame*/) {
  const curves::SampleModel* sample = map();
  if (sample == nullptr) return;
  lay_colours(*sample, picture);
  if (!slice_ || volume_of(parts_.stage) == nullptr) return;
  if (!volume_) volume_.emplace(parts_.stage.wall_scene);
  using Way = curves::ForceVolume::Way;
  volume_->add_slice(*sample, wall_, retracting_ ? Way::Retract : Way::Approach, picture);
}

void MapControl::restart(Restart what) {
  if (what != Restart::Servo) slice_ = false;
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
    laid_ = {quantity, release_z_m, exhibit::map_relief(shown, map, subject)};
  }
  exhibit::lay_map(laid_->relief, shown, parts_.stage.wall_scene, wall_, picture);
}

}  // namespace afm::app
