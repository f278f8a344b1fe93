// SPDX-License-Identifier: Apache-2.0
#include "app/live/map_control.h"

#include "app/view/view_choice.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "curves/curve_map.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/map_relief.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/state/moment.h"

namespace afm::app {

const curves::SampleModel* MapControl::map() const {
  if (!wall_.material || wall_.centerpiece != exhibit::Centerpiece::Instrument) return nullptr;
  const curves::SampleModel& sample = parts_.choice.felt()[*wall_.material];
  return sample.felt_map ? &sample : nullptr;
}

// The controls before this one have decided what the wall shows.
void MapControl::add_to_moment(exhibit::Moment& now, ViewFrame& /*frame*/) { wall_ = now.wall; }

void MapControl::add_to_picture(render::FrameState& picture, const ViewFrame& /*frame*/) {
  if (const curves::SampleModel* sample = map()) lay_colours(*sample, picture);
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
