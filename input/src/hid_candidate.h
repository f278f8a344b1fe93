// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/clock.h"
#include "input/hid_catalog.h"
#include "input/hid_wand.h"

namespace afm::input {

// Printable ASCII of a text of hidapi: a device's own name may contain terminal codes.
std::string plain_hid_text(const wchar_t* text);

// Reason why a device cannot be opened, and what to do.
std::string why_hid_is_closed(const std::string& path);

// One of the possible wands: opened as soon as the system allows it, read, and watched for its use. A device
// that cannot be opened is tried again after 0.1, 0.2, 0.4 s and so on, because the permissions of a new device are set
// a little after it appears. One thread.
class HidCandidate {
 public:
  HidCandidate(std::string path, const KnownHid& known);
  ~HidCandidate();

  const std::string& path() const { return path_; }
  const std::string& name() const { return known_.name; }
  bool is_open() const { return device_ != nullptr; }

  // Returns whether this call has opened it. Logs the reason if it cannot, once.
  bool try_to_open(const HandPlace& place, std::int64_t now_ns);

  // Processes the reports, waiting for the first of them for up to `patience_ms`. False: it is unplugged. Logs the
  // first, tenth, hundredth ... report that the driver does not understand.
  bool read(int patience_ms, const core::Clock& clock);

  const WandState& state() const { return state_; }

  // Presses of Stop since the previous call.
  std::uint32_t take_stops();

  // Time of the last use: a button pressed, or a motion that is not the noise of a stick or the drift of a sensor.
  // 0: never.
  std::int64_t used_ns() const { return used_ns_; }

 private:
  struct Device;
  void watch(std::int64_t now_ns);
  void refuse(std::span<const std::uint8_t> report);

  std::string path_;
  KnownHid known_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<HidWand> wand_;
  std::int64_t next_open_ns_ = 0;
  std::int64_t open_pause_ns_;
  std::string complaint_;  // reason last logged
  WandState state_;
  WandState earlier_;            // earlier state, for comparison with the newest one
  std::int64_t earlier_ns_ = 0;  // time of the earlier state
  std::int64_t steady_ns_ = 0;   // time at which a motion sensor has settled
  std::int64_t used_ns_ = 0;
  std::uint32_t counted_stops_ = 0;
  std::uint64_t refused_ = 0;       // number of reports that the driver did not understand
  std::uint64_t next_refusal_ = 1;  // number of such reports at which the next line is logged
};

}  // namespace afm::input
