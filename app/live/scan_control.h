// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "app/view/view_control.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/scan_hand.h"

namespace afm::app {

struct ViewParts;

// Controls the scan of the sample under the tip in the live window.
class ScanControl final : public ViewControl {
 public:
  explicit ScanControl(ViewParts& parts);

  void toggle();
  void toggle_truth();
  void next_hand();
  void toggle_feedback();
  void toggle_colours();

  void take(const ViewInput& input, const ViewFrame& frame) override;
  void update(const ViewFrame& frame) override;
  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  std::optional<std::string> guidance(const exhibit::Phrases& phrases) const override;
  void restart(Restart what) override;

 private:
  void begin();
  void end();
  bool has_hand() const { return scan_ && scan_->progress().hand; }
  exhibit::HandSize hand_size() const;
  std::optional<exhibit::HandPart> hand_part(const exhibit::ScanSubject& subject) const;
  void move_simulated_hand(double frame_s);
  void give_hand_back();

  ViewParts& parts_;
  std::optional<exhibit::LiveScan> scan_;
  std::size_t material_ = 0;     // index of the scanned material
  std::uint64_t begun_ = 0;      // number of scans started
  std::int64_t scanned_ns_ = 0;  // time up to which the scan was advanced
  scene::ScanHand hand_ = scene::ScanHand::Apart;
  bool feedback_ = true;
  bool false_colours_ = false;  // colours of the sample while no image is taken
  exhibit::HandSize size_;      // size at the start of this scan
  exhibit::LeadingScan leading_;
  scene::HandScript script_;  // motion of the simulated hand; revision 0: inactive
  glm::dvec3 aim_m_{0.0};
  double way_s_ = 0;  // time since the start of its path over the sample
};

}  // namespace afm::app
