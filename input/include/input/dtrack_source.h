// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <string>

#include "core/clock.h"
#include "core/file_descriptor.h"
#include "core/latest_value.h"
#include "core/result.h"
#include "input/dtrack.h"
#include "input/hid_wand.h"
#include "input/wand_source.h"

namespace afm::input {

// Address that receives a tracker's packets, and the pose of the tracker's frame in the room.
struct DtrackSettings {
  std::string address = "127.0.0.1";  // IPv4 address of this machine, or a multicast group, which is joined
  std::uint16_t port = 5000;
  std::uint32_t flystick = 0;
  glm::dvec3 tracker_origin_m{0.0};  // position of the tracker's frame in the room
  // rotation room_from_tracker: z up and y towards the wall, as after DTrack's room calibration and in the wand file
  glm::dquat room_from_tracker{std::numbers::sqrt2 / 2.0, -std::numbers::sqrt2 / 2.0, 0.0, 0.0};
};

// Data received so far.
struct DtrackUpdate {
  std::int64_t time_ns = 0;  // arrival time of the newest valid packet
  std::uint64_t good_packets = 0;
  std::uint64_t bad_packets = 0;  // packets without a valid frame
  std::uint64_t old_packets = 0;  // frames with a number not above the newest: late, or repeated
  std::uint64_t lost_frames = 0;  // frames missing between the numbers of two frames
  std::uint64_t left_out = 0;     // bodies, Flysticks and lines left out of valid frames
  DtrackFaults faults{};          // faults of the newest packet that has any
  DtrackFrame frame{};
};

// Transforms a body to the room's frame.
DtrackBody in_room(const DtrackBody& body, const DtrackSettings& settings);

// A Flystick and everything else that a DTrack system tracks. Accepts any traffic on the port, at any rate: invalid
// packets are counted and dropped, as are frames older than the newest one. Several programs can listen to a multicast
// group, but only one to an address: a second one would take the first one's packets. A restarted tracker counts from
// the beginning, after 250 ms of silence. Without a valid packet for 250 ms, the wand is not connected and its buttons
// are up. Button 1 selects, 2 grabs, 3 scales, 4 goes home; the joystick flies.
class DtrackSource final : public WandSource {
 public:
  // The clock must outlive it. DeviceMissing: the port cannot be opened.
  static core::Result<std::unique_ptr<DtrackSource>> open(const DtrackSettings& settings, const core::Clock& clock);

  WandState poll() override;

  // Newest data, for heads and counts; any thread, as long as this object lives.
  DtrackUpdate newest() const { return update_.load().value_or(DtrackUpdate{}); }

  std::uint16_t port() const { return port_; }  // port in use, a free one if 0 was requested

 private:
  DtrackSource(const DtrackSettings& settings, const core::Clock& clock, core::FileDescriptor socket,
               std::uint16_t port);

  bool receive(int patience_ms);
  bool is_silent() const;
  void count_lost(std::uint32_t step);

  DtrackSettings settings_;
  const core::Clock& clock_;
  core::FileDescriptor socket_;
  std::uint16_t port_;
  DtrackUpdate now_;
  std::uint32_t frame_step_ = 0;  // smallest step of frame numbers so far: a tracker may send every second frame
  core::LatestValue<DtrackUpdate> update_;
};

}  // namespace afm::input
