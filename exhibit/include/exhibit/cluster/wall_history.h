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
#include "scene/shared/soft_blocks.h"

namespace afm::exhibit {

// State that a wall has accumulated from the journal, for a node that joins late or has missed a part.
struct WallHistory {
  std::uint64_t journal = 0;  // number of records that it includes
  CycleHistory cycles;
  FrictionHistory friction;
  std::vector<cluster::EditRecord> edits;  // newest edit of each edited material
  std::vector<cluster::ScanRecord> scan;   // start and changes of the current scan; empty: no scan
  std::vector<scene::ParticlePage> pages;  // poses of the particles
  std::vector<std::uint8_t> known;         // servo::Known values, one for each pose
  scene::TipPush push;
  scene::TaskScore score;
  scene::PlannedPush plan;
  cluster::PictureRecord picture;
  std::vector<scene::MarkTile> tiles;  // tiles of marks; empty: no marks yet
  std::uint64_t marks = 0;             // number of rows of marks included

  explicit WallHistory(std::size_t materials) : cycles(materials) {}

  void apply(const cluster::JournalRecord& record);
};

std::vector<std::byte> save_history(std::uint64_t journal, const CycleHistory& cycles, const FrictionHistory& friction,
                                    std::span<const cluster::EditRecord> edits,
                                    std::span<const cluster::ScanRecord> scan,
                                    std::span<const scene::ParticlePage> pages = {}, const scene::TipPush& push = {},
                                    const scene::TaskScore& score = {}, const scene::PlannedPush& plan = {},
                                    std::span<const scene::MarkTile> tiles = {},
                                    std::span<const std::uint8_t> known = {},
                                    const cluster::PictureRecord& picture = {});

// Rows of the newer tiles that differ, at most `most`; `before` has as many tiles, or none, which means all are level.
std::vector<cluster::MarkRecord> changed_rows(std::span<const scene::MarkTile> before,
                                              std::span<const scene::MarkTile> now, std::size_t most);

// Stores a valid row in its tile; creates the kMarkTiles tiles if there are none.
void put_row(const cluster::MarkRecord& row, std::vector<scene::MarkTile>& tiles);

// Conversion of a scan to its record and back.
cluster::ScanRecord record_of(const ScanChange& change, std::size_t material, const std::optional<HandPart>& hand);
ScanChange change_of(const cluster::ScanRecord& record);
std::optional<HandPart> hand_of(const cluster::ScanRecord& record);

// Returns whether a record can be applied. The network does not know the limits of a scan's values.
bool is_applicable(const cluster::JournalRecord& record);

// Adds a change to those of a scan, and drops changes that are no longer visible.
void add_change(const cluster::ScanRecord& change, std::vector<cluster::ScanRecord>& scan);

// Empty if the document has another number of materials or any invalid value.
std::optional<WallHistory> load_history(std::span<const std::byte> document, std::size_t materials);

}  // namespace afm::exhibit
