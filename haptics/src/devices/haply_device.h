// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "core/clock.h"
#include "core/latest_value.h"
#include "core/result.h"
#include "devices/haply_message.h"
#include "drivers/command_fade.h"
#include "drivers/driver_thread.h"
#include "haptics/device_registry.h"

namespace afm::haptics {

class HaplyLink;

inline constexpr std::uint16_t kHaplyServicePort = 10001;  // port of the manufacturer's service on this machine
inline constexpr const char* kHaplyPortVariable = "TOUCHAFM_HAPLY_PORT";
inline constexpr const char* kHaplyDeviceVariable = "TOUCHAFM_HAPLY_DEVICE";  // variable with the id of the arm

// Haply Inverse3, Inverse3x or Minverse, through the Inverse Service that the manufacturer's set-up starts on this
// machine. One thread talks to the service, one message in each direction about every millisecond; the servo reads the
// newest position, writes the newest force, and never waits. Turn-On is the grip's button.
//
// - A force that the servo has not renewed fades to zero (CommandFade).
// - Without a position for kStallNs the device is not healthy, so the governor cuts the force, and zero is sent
//   unasked: the service keeps applying the last force, even while it reports nothing. Zero is also sent before every
//   disconnection.
// - A lost service is looked for again every kRetryNs. The arm stays the same: a force never moves to another hand.
class HaplyDevice final : public HapticDevice {
 public:
  static constexpr std::int64_t kStallNs = 20'000'000;
  static constexpr std::int64_t kRetryNs = 200'000'000;

  // Takes the arm with the id `wanted`, or the first one if that is empty. DeviceMissing: no service, or no such arm
  // that reports its position within two seconds. `clock` must outlive the device, and is the one that provides the
  // time of read(). `offer` is called for each connection.
  static core::Result<std::unique_ptr<HaplyDevice>> open(const core::Clock& clock,
                                                         std::uint16_t port = kHaplyServicePort,
                                                         OfferReleasePath offer = {}, const std::string& wanted = {});

  // Devices that the service lists; starts nothing.
  static core::Result<HaplyInventory> query(std::uint16_t port = kHaplyServicePort);

  ~HaplyDevice() override;  // sends zero force before closing

  const DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t now_ns) noexcept override;
  void write(const ForceCommand& command) noexcept override;
  bool driver_is_realtime() const noexcept override { return thread_.is_realtime(); }

 private:
  struct Frame {
    std::int64_t time_ns = 0;
    glm::dvec3 position_m{0.0};
    std::uint32_t button = 0;
  };

  HaplyDevice(const core::Clock& clock, std::uint16_t port, std::unique_ptr<HaplyLink> link, OfferReleasePath offer,
              const std::string& wanted);

  void serve() noexcept;  // runs the service's thread, beginning with the connection in `link_`
  void exchange();
  void part() noexcept;
  void list(const std::string& message);
  HaplyName typed(const HaplyName& arm) const;
  void offer_release() const;
  void tell(const glm::dvec3& force_n);
  glm::dvec3 force_for(std::int64_t now_ns);

  const core::Clock& clock_;
  std::uint16_t port_;
  DeviceSpec spec_;
  std::unique_ptr<HaplyLink> link_;
  OfferReleasePath offer_;

  core::LatestValue<Frame> frames_;
  core::LatestValue<TimedForce> commands_;
  std::atomic<bool> closing_{false};
  std::atomic<bool> exchanging_{true};  // false once the connection has ended with zero force
  std::atomic<bool> released_{true};    // true: no force sent since the last zero
  HaplyName first_;                     // arm in use; constant once known_ is set
  std::atomic<bool> known_{false};

  // servo's thread
  Frame frame_;

  // service's thread
  std::string wanted_;  // id of the arm; empty until the first one is known
  HaplyName arm_;       // arm that this connection reports; empty: none yet
  HaplyInventory inventory_;
  std::string listed_;  // newest list of devices written to the log
  TimedForce command_;
  std::int64_t force_ns_ = 0;
  std::int64_t heard_ns_ = 0;
  std::int64_t complained_ns_ = 0;
  CommandFade fade_;
  DriverThread thread_;  // last member, because the thread uses all the others
};

// Entry for the registry.
core::Result<std::unique_ptr<HapticDevice>> open_haply(const DeviceRequest& request, ProbeLog& log);
void probe_haply(const Environment& environment, ProbeLog& log);

}  // namespace afm::haptics
