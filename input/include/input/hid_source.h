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

class HidCandidate;

// Result of the search for one HID device, as text.
struct HidFinding {
  std::string path;
  std::string name;  // name reported by the device, with its numbers: "SpaceMouse Compact (256f:c635)"
  bool is_wand = false;
  bool usable = false;
  std::string said;  // description, or the reason why it cannot be used with the remedy
};

// Examines every HID device that the system lists; wands are opened and closed again. Fails if the library cannot be
// started. One thread at a time.
core::Result<std::vector<HidFinding>> find_hid_wands(const std::vector<HidMapping>& mappings);

// Wand through hidapi, plugged in before or later. Every wand that could be meant is opened; the first one is followed
// until another one is used, which takes over as soon as the present one rests: for a second, with no button down. Stop
// counts on all of them. Looks for devices once a second. When the followed one is unplugged, it releases its buttons
// and points nowhere until it or another one is there.
class HidSource final : public WandSource {
 public:
  // The clock must outlive it. With a text, only wands with that node, or with it in their name or numbers, are opened.
  static core::Result<std::unique_ptr<HidSource>> open(std::vector<HidMapping> mappings, const HandPlace& place,
                                                       const core::Clock& clock, const std::string& wanted = "");
  ~HidSource() override;

  WandState poll() override;

 private:
  HidSource(std::vector<HidMapping> mappings, const HandPlace& place, const core::Clock& clock, std::string wanted);

  void look(std::int64_t now_ns);
  void open_candidates(std::int64_t now_ns);
  bool read_candidates();
  void choose(std::int64_t now_ns);
  void follow(HidCandidate& candidate, const std::string& place);
  WandState nothing() const;

  std::vector<HidMapping> mappings_;
  HandPlace place_;
  const core::Clock& clock_;
  std::string wanted_;
  std::vector<std::unique_ptr<HidCandidate>> candidates_;  // wands found in the last search, by their nodes
  HidCandidate* followed_ = nullptr;                       // wand in use, one of candidates_; null: none
  std::int64_t next_look_ns_ = 0;
  bool complained_ = false;  // true: the log names the wanted wand as missing
  std::uint32_t stops_ = 0;
};

}  // namespace afm::input
