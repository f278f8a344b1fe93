// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "input/hid_catalog.h"
#include "input/hid_mapping.h"
#include "input/hid_wand.h"
#include "input/wand_source.h"

namespace afm::input {

// Result of the search for one HID device, as text.
struct HidFinding {
  std::string path;
  std::string name;  // name reported by the device, with its numbers: "SpaceMouse Compact (256f:c635)"
  bool is_wand = false;
  bool usable = false;
  std::string said;  // description, or why it cannot be used and what to do
};

// Examines every HID device that the system lists; wands are opened and closed again. Fails if the library cannot be
// started. One thread at a time.
core::Result<std::vector<HidFinding>> find_hid_wands(const std::vector<HidMapping>& mappings);

// Wand through hidapi: the first one that can be opened, plugged in before or later. Looks for devices once a second
// while none is open. A device that cannot be opened is tried again after 0.1, 0.2, 0.4 s and so on, because the
// permissions of a new device are set a little after it appears. When unplugged, it releases its buttons and points
// nowhere until it is back.
class HidSource final : public WandSource {
 public:
  // The clock must outlive it.
  static core::Result<std::unique_ptr<HidSource>> open(std::vector<HidMapping> mappings, const HandPlace& place,
                                                       const core::Clock& clock);
  ~HidSource() override;

  WandState poll() override;

  std::uint64_t refused_reports() const { return refused_; }  // only on the polling thread

 private:
  struct Device;
  HidSource(std::vector<HidMapping> mappings, const HandPlace& place, const core::Clock& clock);

  void look(std::int64_t now_ns);
  void try_to_open(std::int64_t now_ns);
  void lose();
  WandState nothing() const;
  void complain(const std::string& complaint);

  std::vector<HidMapping> mappings_;
  HandPlace place_;
  const core::Clock& clock_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<HidWand> wand_;
  std::vector<std::string> paths_;  // wands seen last, in the order of attempts
  std::vector<KnownHid> known_;     // descriptions of these wands
  std::int64_t next_look_ns_ = 0;
  std::int64_t next_open_ns_ = 0;
  std::int64_t open_pause_ns_ = 0;
  std::string complaint_;  // as last logged
  std::uint64_t refused_ = 0;
};

}  // namespace afm::input
