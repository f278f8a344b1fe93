// SPDX-License-Identifier: Apache-2.0
#include "app/live/live_controls.h"

#include <utility>

#include "app/cluster/cluster_control.h"
#include "app/headset/headset_control.h"
#include "app/lesson/instructor_control.h"
#include "app/lesson/lesson_control.h"
#include "app/live/journey_control.h"
#include "app/live/kept_control.h"
#include "app/live/map_control.h"
#include "app/live/particles_control.h"
#include "app/live/place_control.h"
#include "app/live/scan_control.h"
#include "app/live/sight_control.h"
#include "app/live/sound_control.h"
#include "app/live/view_settings.h"
#include "app/live/visitor_control.h"
#include "app/view/view_controls.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "exhibit/frame/exhibit_setup.h"
#include "scene/samples/particle_set.h"

namespace afm::app {

template <typename Control, typename... Arguments>
Control& LiveControls::add(Arguments&&... arguments) {
  auto control = std::make_unique<Control>(parts_, std::forward<Arguments>(arguments)...);
  Control& added = *control;
  owned_.push_back(std::move(control));
  parts_.controls.add(added);
  return added;
}

namespace {

WallUse use_of(const ViewParts& parts, const LiveFeatures& features) {
  if (features.lesson != nullptr) return WallUse::Lesson;
  return parts.stage.particles ? WallUse::Particles : WallUse::Free;
}

}  // namespace

// In the order of ViewControl's calls: a lesson hides the scan's panels, the sound follows both, and the other machines
// receive the result.
LiveControls::LiveControls(ViewParts& parts, const ViewSettings& settings, const LiveFeatures& features)
    : parts_(parts), use_(use_of(parts, features)), unattended_(settings.unattended), owners_{.parts = parts} {
  parts.panels.use_for(use_);
  const bool worn = features.headset != nullptr;
  if (settings.kept) add<KeptControl>(*settings.kept);
  if (worn) add<HeadsetControl>(*features.headset);
  if (!worn) add<SightControl>();
  if (features.instructor != nullptr && features.lesson != nullptr) {
    add<InstructorControl>(*features.lesson, *features.instructor, [this](render::Key key) { press(key); });
  }
  if (settings.unattended) add<VisitorControl>(settings.idle_s);
  using Motion = exhibit::JourneyTravel::Motion;
  using Eyes = PlaceControl::Eyes;
  owners_.place = &add<PlaceControl>(settings.head_script, worn ? Eyes::OfHeadset : Eyes::Followed);
  owners_.journey = &add<JourneyControl>(worn ? Motion::Steps : Motion::Glide);
  if (features.lesson != nullptr) owners_.lesson = &add<LessonControl>(*features.lesson);
  if (parts.stage.particles) owners_.particles = &add<ParticlesControl>(*parts.stage.particles);
  owners_.scan = &add<ScanControl>();
  owners_.map = &add<MapControl>(settings.equal_force_n);
  owners_.sound = &add<SoundControl>();
  if (features.cluster != nullptr) add<ClusterControl>(*features.cluster);
}

LiveControls::~LiveControls() = default;

void LiveControls::press(render::Key key) {
  for (const LiveKey& row : live_keys()) {
    if (!row.holds(key) || row.press == nullptr || !row.acts(use_) || (row.staff && unattended_)) continue;
    row.press(owners_, static_cast<std::size_t>(key) - static_cast<std::size_t>(row.key));
  }
}

}  // namespace afm::app
