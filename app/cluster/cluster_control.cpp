// SPDX-License-Identifier: Apache-2.0
#include "app/cluster/cluster_control.h"

#include <utility>

#include "app/cluster/cluster_master.h"
#include "app/display/view_picture.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_hand.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "exhibit/cluster/frame_digest.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/cluster/living_screens.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/scan_panels.h"
#include "scene/samples/particle_set.h"
#include "servo/servo_client.h"

namespace afm::app {

ClusterControl::ClusterControl(ViewParts& parts, ClusterMaster& master) : parts_(parts), master_(master) {
  parts_.turn.draws_unseen = true;
  if (master_.nodes_show_sample()) {
    parts_.turn.seen_elsewhere_ns = [this](std::int64_t now_ns) { return master_.seen_ns(now_ns); };
  }
  parts_.servo.hear([this](const scene::TipSample& sample) { master_.hear(sample); });
  parts_.servo.hear_events([this](const scene::TipEvent& event) {
    if (physics::is_jump(event.kind)) master_.hear(event);
  });
}

void ClusterControl::share_scan() {
  const ShownScan& shown = parts_.turn.scan;
  master_.follow_scan(shown.scan, shown.material, shown.begun);
}

// Shares the scan before the samples of a painting hand arrive.
void ClusterControl::take(const ViewInput& /*input*/, const ViewFrame& /*frame*/) {
  share_scan();
  if (master_.take_stop()) parts_.choice.stop_force();
  if (parts_.turn.failure) return;
  parts_.turn.failure = master_.rival();
  parts_.turn.leaving = parts_.turn.leaving || parts_.turn.failure;
}

// Sends this frame's inputs, and replaces the moment by the sent one, so that this machine omits the same parts.
void ClusterControl::add_to_moment(exhibit::Moment& now, ViewFrame& frame) {
  message_ = {};
  exhibit::set_moment(now, parts_.servo.link().tip(), frame.caption, parts_.turn.blank || parts_.turn.dark, message_);
  message_.panels = parts_.panels.told(frame.pointed, parts_.hand.source());
  message_.view = parts_.picture.told();
  share_scan();
  if (now.wall.particles != nullptr) {
    master_.follow_particles(*now.wall.particles, parts_.stage.particles->particles.size());
    particles_ = master_.as_recorded(*now.wall.particles);
  }
  master_.send(message_, parts_.panels.edits(), parts_.servo.cycles(), parts_.servo.friction());
  exhibit::Moment shared = exhibit::moment_of(message_);
  shared.curves = now.curves;
  if (now.wall.particles != nullptr) shared.wall.particles = &particles_;
  if (parts_.turn.scan.scan != nullptr) exhibit::show_scan(*parts_.turn.scan.scan, shared);
  now = std::move(shared);
  frame.caption = exhibit::caption_of(message_);
}

void ClusterControl::add_to_picture(render::FrameState& picture, const ViewFrame& /*frame*/) {
  auto& banner = picture.panels.banner;
  add_warning(missing_text(message_.missing, parts_.stage.wall, parts_.stage.phrases()), banner.content);
  banner.placement =
      exhibit::on_living_screens(banner.placement, parts_.stage.wall, {.nodes = message_.missing, .master = false});
  master_.built(exhibit::digest_of(picture, message_.view));
}

void ClusterControl::before_showing(const Beat& beat) { master_.barrier(beat); }

void ClusterControl::restart(Restart what) {
  if (what == Restart::Everything) master_.forget();
}

void ClusterControl::finish() { master_.log_summary(); }

}  // namespace afm::app
