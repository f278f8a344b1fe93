// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cluster/messages.h"
#include "exhibit/friction/friction_history.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/state/cycle_history.h"

namespace afm::exhibit {

// What a wall has built up from the journal, for a node that comes late or has missed a part.
struct WallHistory {
  std::uint64_t journal = 0;  // how many records it holds
  CycleHistory cycles;
  FrictionHistory friction;
  std::vector<cluster::EditRecord> edits;  // the newest of each material that has one
  std::vector<cluster::ScanRecord> scan;   // how the one that is shown began, and its changes; empty: none is shown

  explicit WallHistory(std::size_t materials) : cycles(materials) {}

  void apply(const cluster::JournalRecord& record);
};

std::vector<std::byte> save_history(std::uint64_t journal, const CycleHistory& cycles, const FrictionHistory& friction,
                                    std::span<const cluster::EditRecord> edits,
                                    std::span<const cluster::ScanRecord> scan);

// A scan as it is recorded, and back.
cluster::ScanRecord record_of(const ScanChange& change, std::size_t material, const std::optional<HandPart>& hand);
ScanChange change_of(const cluster::ScanRecord& record);
std::optional<HandPart> hand_of(const cluster::ScanRecord& record);

// Whether a record can be applied: a scan has bounds that those who carry it do not know.
bool is_applicable(const cluster::JournalRecord& record);

// Adds a change to those of a scan; those that are no longer seen are dropped.
void add_change(const cluster::ScanRecord& change, std::vector<cluster::ScanRecord>& scan);

// Nothing where the document is not one of so many materials, or any number in it is not valid.
std::optional<WallHistory> load_history(std::span<const std::byte> document, std::size_t materials);

}  // namespace afm::exhibit
