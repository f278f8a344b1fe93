// SPDX-License-Identifier: Apache-2.0
#include "app/view/map_overlay.h"

#include "app/view/view_panels.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/force_volume.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/map_picture.h"
#include "exhibit/scan/map_relief.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/scan/volume_view.h"
#include "exhibit/state/wall_state.h"

namespace afm::app {

struct MapOverlay::Laid {
  exhibit::MapQuantity quantity{};
  double release_z_m = 0;  // size of the sample, as in exhibit::WallState
  exhibit::HeightRelief relief;
};

MapOverlay::MapOverlay(const exhibit::Stage& stage, ViewPanels& panels) : stage_(stage), panels_(panels) {}

MapOverlay::~MapOverlay() = default;

const curves::ForceVolume* MapOverlay::volume_of(const exhibit::Stage& stage) {
  if (!stage.pixel || !stage.pixel->felt_map || !stage.pixel->felt_map->volume) return nullptr;
  return stage.pixel->felt_map->volume->known() > 0 ? stage.pixel->felt_map->volume.get() : nullptr;
}

void MapOverlay::add_to(render::FrameState& picture, const curves::SampleModel& sample, const exhibit::WallState& wall,
                        bool retracting, const MapView& view) {
  if (!sample.felt_map || wall.centerpiece != exhibit::Centerpiece::Instrument) return;
  lay_colours(sample, wall, picture);
  const bool seen = view.slice || view.equal_force_n;
  if (!seen || volume_of(stage_) == nullptr) return;
  if (!volume_) volume_ = std::make_unique<exhibit::VolumeView>(stage_.wall_scene);
  using Way = curves::ForceVolume::Way;
  if (view.equal_force_n) volume_->add_surface(sample, wall, *view.equal_force_n, picture);
  if (view.slice) volume_->add_slice(sample, wall, retracting ? Way::Retract : Way::Approach, picture);
}

// Heights are those of the sample's own colours; an image, and the colours of key E, show them, too.
void MapOverlay::lay_colours(const curves::SampleModel& map, const exhibit::WallState& wall,
                             render::FrameState& picture) {
  if (wall.scan || wall.false_colours) return;
  const render::MapPicture& shown = panels_.picture_of(*map.pixel);
  const exhibit::MapQuantity quantity = panels_.map_quantity();
  if (quantity == exhibit::MapQuantity::Height) return;
  const double release_z_m = map.scaling.release_z_m();
  if (!laid_ || laid_->quantity != quantity || laid_->release_z_m != release_z_m) {
    const exhibit::ScanSubject subject = exhibit::scan_subject(stage_.wall_scene, *wall.material, map);
    laid_ = std::make_unique<const Laid>(Laid{quantity, release_z_m, exhibit::map_relief(shown, map, subject)});
  }
  exhibit::lay_map(laid_->relief, shown, stage_.wall_scene, wall, picture);
}

}  // namespace afm::app
