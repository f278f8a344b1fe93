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
  std::string name;  // as the device calls itself, with its numbers: "SpaceMouse Compact (256f:c635)"
  bool is_wand = false;
  bool usable = false;
  std::string said;  // what it is, or why it cannot be used and what to do
};

// Looks at every HID device that the system shows; those that are wands are opened and closed again. Fails if the
// library cannot be started. One thread at a time.
core::Result<std::vector<HidFinding>> find_hid_wands(const std::vector<HidMapping>& mappings);

// A wand by hidapi: the first one that can be opened, plugged in before or later. Devices are looked for once a second
// as long as none is open; one that cannot be opened is tried again after 0.1, 0.2, 0.4 s and so on, because the rights
// of a new device come a little later than the device. When it is unplugged its buttons are released and it points
// nowhere, until it comes again.
class HidSource final : public WandSource {
 public:
  // The clock must outlive it.
  static core::Result<std::unique_ptr<HidSource>> open(std::vector<HidMapping> mappings, const HandPlace& place,
                                                       const core::Clock& clock);
  ~HidSource() override;

  WandState poll() override;

  std::uint64_t refused_reports() const { return refused_; }  // on the thread that polls

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
  std::vector<std::string> paths_;  // of the wands that were seen last, in the order in which they are tried
  std::vector<KnownHid> known_;     // what they are
  std::int64_t next_look_ns_ = 0;
  std::int64_t next_open_ns_ = 0;
  std::int64_t open_pause_ns_ = 0;
  std::string complaint_;  // as it was logged last
  std::uint64_t refused_ = 0;
};

}  // namespace afm::input
