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

// Address that a tracker sends to, and the pose of its frame in the room.
struct DtrackSettings {
  std::string address = "127.0.0.1";  // of this machine, IPv4
  std::uint16_t port = 5000;
  std::uint32_t flystick = 0;
  glm::dvec3 tracker_origin_m{0.0};  // room_from_tracker, a rigid transform
  // z upwards and y towards the wall, as DTrack's room calibration leaves them and assets/wands/dtrack.toml says
  glm::dquat room_from_tracker{std::numbers::sqrt2 / 2.0, -std::numbers::sqrt2 / 2.0, 0.0, 0.0};
};

// Data received so far.
struct DtrackUpdate {
  std::int64_t time_ns = 0;  // when the newest good packet came
  std::uint64_t good_packets = 0;
  std::uint64_t bad_packets = 0;  // no frames
  std::uint64_t old_packets = 0;  // frames whose number is not above the newest one's: late, or sent again
  std::uint64_t lost_frames = 0;  // that are missing between the numbers of two frames
  DtrackFrame frame{};
};

// The bodies in the room's frame.
DtrackBody in_room(const DtrackBody& body, const DtrackSettings& settings);

// A Flystick and whatever else a DTrack system tracks. Whatever comes in on the port, at whatever rate: what is no
// frame is counted and dropped, and so is a frame that is older than the newest one; a tracker that was started anew
// counts from the beginning, after 250 ms of silence. Without a good packet for 250 ms the wand is not connected and
// its buttons are up. Button 1 selects, 2 grabs, 3 scales, 4 goes home; the joystick flies.
class DtrackSource final : public WandSource {
 public:
  // The clock must outlive it. DeviceMissing: cannot listen there.
  static core::Result<std::unique_ptr<DtrackSource>> open(const DtrackSettings& settings, const core::Clock& clock);

  WandState poll() override;

  // The newest, for heads and for counts; any thread, as long as this lives.
  DtrackUpdate newest() const { return update_.load().value_or(DtrackUpdate{}); }

  std::uint16_t port() const { return port_; }  // as bound: one that was free if it was asked for as 0

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
  std::uint32_t frame_step_ =
      0;  // between two numbers of frames, the smallest seen: a tracker may send every second one
  core::LatestValue<DtrackUpdate> update_;
};

}  // namespace afm::input
