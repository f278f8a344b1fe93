// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/wall_history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/members.h"
#include "scene/shared/shared_segment.h"

namespace afm::exhibit {

namespace {

class HistoryWriter {
 public:
  template <class Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void operator()(const bool& value) { (*this)(static_cast<std::uint8_t>(value ? 1 : 0)); }
  template <class Value>
  void operator()(const std::vector<Value>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    const auto bytes = std::as_bytes(std::span(values));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

// Reads a history. After the first invalid value, all later fields keep their values.
class HistoryReader {
 public:
  explicit HistoryReader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class Value>
  void operator()(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    read(std::as_writable_bytes(std::span(&value, 1)));
    if constexpr (std::is_floating_point_v<Value>) valid_ = valid_ && !std::isnan(value);
  }
  void operator()(bool& value) {
    std::uint8_t byte = 0;
    (*this)(byte);
    valid_ = valid_ && byte <= 1;
    value = byte == 1;
  }
  template <class Value>
  void operator()(std::vector<Value>& values) {
    std::uint64_t count = 0;
    (*this)(count);
    valid_ = valid_ && count <= left_.size() / sizeof(Value);
    if (!valid_) return;
    values.resize(count);
    read(std::as_writable_bytes(std::span(values)));
    if constexpr (sizeof(Value) % sizeof(double) == 0 && !std::is_same_v<Value, cluster::EditRecord> &&
                  !std::is_same_v<Value, cluster::ScanRecord> && !std::is_same_v<Value, scene::ParticlePage> &&
                  !std::is_same_v<Value, cluster::MarkRecord>)
      check_doubles(values);
  }

  bool whole() const { return valid_ && left_.empty(); }

 private:
  void read(std::span<std::byte> to) {
    valid_ = valid_ && left_.size() >= to.size();
    if (!valid_ || to.empty()) return;
    std::memcpy(to.data(), left_.data(), to.size());
    left_ = left_.subspan(to.size());
  }

  // Points of curves and loops, which contain nothing else.
  template <class Value>
  void check_doubles(const std::vector<Value>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(double)) {
      double number = 0;
      std::memcpy(&number, bytes.data() + at, sizeof(number));
      valid_ = valid_ && std::isfinite(number);
    }
  }

  std::span<const std::byte> left_;
  bool valid_ = true;
};

constexpr std::size_t kMostRows = std::size_t{scene::kMarkTiles} * scene::kTileSide;

cluster::MarkRecord row_of(const scene::MarkTile& tile, std::uint32_t number, std::uint32_t row) {
  cluster::MarkRecord record{.tile = number, .row = row};
  const std::ptrdiff_t first = std::ptrdiff_t{row} * std::ptrdiff_t{scene::kTileSide};
  std::copy_n(tile.pressed_m.begin() + first, scene::kTileSide, record.pressed_m.begin());
  std::copy_n(tile.back_m.begin() + first, scene::kTileSide, record.back_m.begin());
  return record;
}

}  // namespace

void WallHistory::apply(const cluster::JournalRecord& record) {
  ++journal;
  // ignores a record for a material that this wall lacks
  const auto has = [&](std::int32_t material) { return static_cast<std::size_t>(material) < cycles.curves().size(); };
  switch (record.kind()) {
    case cluster::JournalKind::Sample: {
      const scene::TipSample sample = record.sample();
      if (!has(sample.material)) return;
      cycles.add(sample);
      friction.add(sample);
      return;
    }
    case cluster::JournalKind::Event:
      if (has(record.event().material)) cycles.add(record.event());
      return;
    case cluster::JournalKind::Edit: {
      const cluster::EditRecord edit = record.edit();
      if (edit.material >= cycles.curves().size()) return;
      std::erase_if(edits, [&](const cluster::EditRecord& earlier) { return earlier.material == edit.material; });
      edits.push_back(edit);
      return;
    }
    case cluster::JournalKind::ScanBegin:
      scan.assign(1, record.scan());
      return;
    case cluster::JournalKind::ScanChange:
      if (!scan.empty()) add_change(record.scan(), scan);
      return;
    case cluster::JournalKind::ScanEnd:
      scan.clear();
      return;
    case cluster::JournalKind::Pose: {
      const cluster::PoseRecord moved = record.pose();
      if (pages.size() < scene::pages_of(moved.particle + 1)) pages.resize(scene::pages_of(moved.particle + 1));
      pages[scene::page_of(moved.particle)].poses[moved.particle % scene::kPosesPerPage] = moved.pose;
      known.resize(pages.size() * scene::kPosesPerPage);
      known[moved.particle] = static_cast<std::uint8_t>(moved.known);
      return;
    }
    case cluster::JournalKind::Push:
      push = record.push();
      return;
    case cluster::JournalKind::Score:
      score = record.score();
      return;
    case cluster::JournalKind::Plan:
      plan = record.plan();
      return;
    case cluster::JournalKind::Picture:
      picture = record.picture();
      return;
    case cluster::JournalKind::Mark:
      put_row(record.mark(), tiles);
      ++marks;
      return;
    case cluster::JournalKind::Forget:
      cycles = CycleHistory(cycles.curves().size());
      friction = {};
      return;
  }
}

std::vector<cluster::MarkRecord> changed_rows(std::span<const scene::MarkTile> before,
                                              std::span<const scene::MarkTile> now, std::size_t most) {
  static const scene::MarkTile kBare;
  std::vector<cluster::MarkRecord> rows;
  for (std::uint32_t tile = 0; tile < now.size(); ++tile) {
    const scene::MarkTile& was = before.empty() ? kBare : before[tile];
    if (was == now[tile]) continue;
    for (std::uint32_t row = 0; row < scene::kTileSide; ++row) {
      const cluster::MarkRecord old = row_of(was, tile, row), newer = row_of(now[tile], tile, row);
      if (old == newer) continue;
      if (rows.size() == most) return rows;
      rows.push_back(newer);
    }
  }
  return rows;
}

void put_row(const cluster::MarkRecord& row, std::vector<scene::MarkTile>& tiles) {
  if (tiles.empty()) tiles.resize(scene::kMarkTiles);
  scene::MarkTile& tile = tiles[row.tile];
  const std::size_t first = std::size_t{row.row} * scene::kTileSide;
  std::copy(row.pressed_m.begin(), row.pressed_m.end(), tile.pressed_m.begin() + static_cast<std::ptrdiff_t>(first));
  std::copy(row.back_m.begin(), row.back_m.end(), tile.back_m.begin() + static_cast<std::ptrdiff_t>(first));
}

cluster::ScanRecord record_of(const ScanChange& change, std::size_t material, const std::optional<HandPart>& hand) {
  cluster::ScanRecord record{
      .material = static_cast<std::uint32_t>(material), .frame = change.frame, .pixel = change.pixel};
  record.choice =
      std::apply([](const auto&... numbers) { return std::array{numbers...}; }, core::members_of(change.choice));
  if (hand) {
    record.has_hand = 1;
    record.paints = hand->paints ? 1 : 0;
    record.feedback = hand->feedback ? 1 : 0;
    record.side_m = hand->side_m;
    record.first_tick = hand->first_tick;
  }
  return record;
}

ScanChange change_of(const cluster::ScanRecord& record) {
  ScanChange change{.frame = record.frame, .pixel = record.pixel};
  core::members_of(change.choice) = std::tuple_cat(record.choice);
  return change;
}

std::optional<HandPart> hand_of(const cluster::ScanRecord& record) {
  if (record.has_hand == 0) return std::nullopt;
  return HandPart{.paints = record.paints != 0,
                  .feedback = record.feedback != 0,
                  .side_m = record.side_m,
                  .first_tick = record.first_tick};
}

bool is_applicable(const cluster::JournalRecord& record) {
  if (record.kind() != cluster::JournalKind::ScanBegin && record.kind() != cluster::JournalKind::ScanChange)
    return true;
  const cluster::ScanRecord scan = record.scan();
  return LiveScan::valid(
      {.frame = scan.frame, .pixel = scan.pixel, .truth = false, .changes = {change_of(scan)}, .hand = hand_of(scan)});
}

void add_change(const cluster::ScanRecord& change, std::vector<cluster::ScanRecord>& scan) {
  const auto place = [](const cluster::ScanRecord& record) { return std::pair(record.frame, record.pixel); };
  if (place(change) <= place(scan.back())) scan.pop_back();
  scan.push_back(change);
  // the settings of the oldest visible frame come from the last change before it
  while (scan.size() > 1 && scan[1].frame + 2 < change.frame) scan.erase(scan.begin());
}

std::vector<std::byte> save_history(std::uint64_t journal, const CycleHistory& cycles, const FrictionHistory& friction,
                                    std::span<const cluster::EditRecord> edits,
                                    std::span<const cluster::ScanRecord> scan,
                                    std::span<const scene::ParticlePage> pages, const scene::TipPush& push,
                                    const scene::TaskScore& score, const scene::PlannedPush& plan,
                                    std::span<const scene::MarkTile> tiles, std::span<const std::uint8_t> known,
                                    const cluster::PictureRecord& picture) {
  HistoryWriter writer;
  writer(journal);
  writer(static_cast<std::uint64_t>(cycles.curves().size()));
  CycleHistory::visit_state(cycles, writer);
  FrictionHistory::visit_state(friction, writer);
  writer(std::vector<cluster::EditRecord>(edits.begin(), edits.end()));
  writer(std::vector<cluster::ScanRecord>(scan.begin(), scan.end()));
  writer(std::vector<scene::ParticlePage>(pages.begin(), pages.end()));
  writer(push);
  writer(score);
  writer(plan);
  writer(changed_rows({}, tiles, kMostRows));
  writer(std::vector<std::uint8_t>(known.begin(), known.end()));
  writer(picture);
  return writer.take();
}

std::optional<WallHistory> load_history(std::span<const std::byte> document, std::size_t materials) {
  HistoryReader reader(document);
  WallHistory history(materials);
  std::uint64_t count = 0;
  reader(history.journal);
  reader(count);
  if (count != materials) return std::nullopt;
  CycleHistory::visit_state(history.cycles, reader);
  FrictionHistory::visit_state(history.friction, reader);
  reader(history.edits);
  reader(history.scan);
  reader(history.pages);
  reader(history.push);
  reader(history.score);
  reader(history.plan);
  std::vector<cluster::MarkRecord> rows;
  reader(rows);
  reader(history.known);
  reader(history.picture);
  const auto is_edit = [&](const cluster::EditRecord& edit) {
    return edit.material < materials && cluster::JournalRecord(edit).valid();
  };
  const auto is_scan = [&](const cluster::ScanRecord& scan) {
    const cluster::JournalRecord record(cluster::JournalKind::ScanChange, scan);
    return scan.material < materials && record.valid() && is_applicable(record);
  };
  const bool valid = reader.whole() && history.cycles.sound() && history.friction.sound() &&
                     std::all_of(history.edits.begin(), history.edits.end(), is_edit) &&
                     std::all_of(history.scan.begin(), history.scan.end(), is_scan) &&
                     history.pages.size() <= scene::kParticlePages &&
                     std::all_of(history.pages.begin(), history.pages.end(),
                                 [](const scene::ParticlePage& page) { return scene::is_valid(page); }) &&
                     cluster::JournalRecord(history.push).valid() && cluster::JournalRecord(history.score).valid() &&
                     cluster::JournalRecord(history.plan).valid() && cluster::JournalRecord(history.picture).valid() &&
                     history.known.size() == history.pages.size() * scene::kPosesPerPage &&
                     std::all_of(history.known.begin(), history.known.end(),
                                 [](std::uint8_t known) { return known <= cluster::PictureRecord::kMostKnown; }) &&
                     std::all_of(rows.begin(), rows.end(),
                                 [](const cluster::MarkRecord& row) { return cluster::JournalRecord(row).valid(); });
  if (!valid) return std::nullopt;
  for (const cluster::MarkRecord& row : rows) put_row(row, history.tiles);
  history.marks = rows.size();
  return history;
}

}  // namespace afm::exhibit
