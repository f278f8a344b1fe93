// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/view_control.h"
#include "cluster/frame_message.h"
#include "exhibit/state/particles_now.h"

namespace afm::app {

class ClusterMaster;
struct ViewParts;

// Connects the live window to the other machines of the wall: sends them the inputs of each frame, and all show it
// together. Must come after all controls that change the picture.
class ClusterControl final : public ViewControl {
 public:
  // Both arguments must outlive the object.
  ClusterControl(ViewParts& parts, ClusterMaster& master);

  void take(const ViewInput& input, const ViewFrame& frame) override;
  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void add_to_picture(render::FrameState& picture, const ViewFrame& frame) override;
  void before_showing(const Beat& beat) override;
  void restart(Restart what) override;
  void finish() override;

 private:
  void share_scan();

  ViewParts& parts_;
  ClusterMaster& master_;
  cluster::FrameMessage message_{};  // inputs of the current frame
  exhibit::ParticlesNow particles_;  // particles as all machines show them
};

}  // namespace afm::app
