// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "scene/shared/field_visitor.h"
#include "scene/shared/tip_blocks.h"

// The messages between the machines of a wall: trivially copyable blocks, each in one datagram. What comes from the
// network is used only after decode() has checked all of it. No message leads to the servo.
namespace afm::cluster {

// With the headers of UDP, IP and DDS it stays below the 1500 bytes of an Ethernet frame: every fragment could be lost.
inline constexpr std::size_t kMostDatagramBytes = 1300;

// Raised whenever the meaning of a message changes.
inline constexpr std::uint32_t kClusterVersion = 1;

// Of every message. `session` is drawn by each master when it starts.
struct ClusterHeader {
  std::uint32_t version = kClusterVersion;
  std::uint32_t node = 0;  // of Wall::nodes: who sends a ReadyMessage
  std::uint64_t session = 0;
  std::uint64_t number = 0;  // of the frame, of a batch's first record, or of a document

  bool operator==(const ClusterHeader&) const = default;
};

template <class Visit, scene::RecordOf<ClusterHeader>... Record>
constexpr void for_each_field(Visit&& visit, Record&... header) {
  visit("version", header.version...);
  visit("node", header.node...);
  visit("session", header.session...);
  visit("number", header.number...);
}
static_assert(scene::all_fields_described<ClusterHeader>());

// A node has drawn a frame, or says where it stands; the master counts times in its own clock.
enum class NodeState : std::uint32_t { Loading = 0, Drawing = 1, OtherBuild = 2, OtherScene = 3 };

struct ReadyMessage {
  ClusterHeader header{};
  NodeState state = NodeState::Loading;
  std::uint32_t wants_history = 0;  // 1: it lacks what was felt before, or a part of it
  std::uint64_t digest = 0;         // of the frame as it was built; of its scene or its build where those differ
  std::int64_t frame_sent_ns = 0;   // as in FrameMessage, the master's clock
  std::int64_t frame_came_ns = 0;   // the node's clock
  std::int64_t ready_sent_ns = 0;   // likewise
  std::int64_t swapped_ns = 0;      // likewise: when the frame before was let go
  std::uint64_t lost_records = 0;   // holes of the journal until now
  std::uint32_t draw_us = 0;
  std::uint32_t late_swaps = 0;  // frames that were shown although no word to show them came

  bool operator==(const ReadyMessage&) const = default;
};

template <class Visit, scene::RecordOf<ReadyMessage>... Record>
constexpr void for_each_field(Visit&& visit, Record&... ready) {
  visit("header", ready.header...);
  visit("state", ready.state...);
  visit("wants_history", ready.wants_history...);
  visit("digest", ready.digest...);
  visit("frame_sent_ns", ready.frame_sent_ns...);
  visit("frame_came_ns", ready.frame_came_ns...);
  visit("ready_sent_ns", ready.ready_sent_ns...);
  visit("swapped_ns", ready.swapped_ns...);
  visit("lost_records", ready.lost_records...);
  visit("draw_us", ready.draw_us...);
  visit("late_swaps", ready.late_swaps...);
}
static_assert(scene::all_fields_described<ReadyMessage>());

// All that are awaited have drawn the frame: show it.
struct SwapMessage {
  ClusterHeader header{};
};

template <class Visit, scene::RecordOf<SwapMessage>... Record>
constexpr void for_each_field(Visit&& visit, Record&... swap) {
  visit("header", swap.header...);
}
static_assert(scene::all_fields_described<SwapMessage>());

// The parameters of a material as a person has set them: curves::LiveParameters::State, and the servo's revision.
struct EditRecord {
  std::uint32_t material = 0;
  std::uint32_t revision = 0;
  std::array<std::int32_t, 6> steps{};
  std::int32_t refused_row = -1;
  std::int32_t refused_direction = 0;

  bool operator==(const EditRecord&) const = default;
};

template <class Visit, scene::RecordOf<EditRecord>... Record>
constexpr void for_each_field(Visit&& visit, Record&... edit) {
  visit("material", edit.material...);
  visit("revision", edit.revision...);
  visit("steps", edit.steps...);
  visit("refused_row", edit.refused_row...);
  visit("refused_direction", edit.refused_direction...);
}
static_assert(scene::all_fields_described<EditRecord>());

// A scan on the wall begins, or its settings change: exhibit::ScanChange, with the part that the hand has in it.
struct ScanRecord {
  std::uint32_t material = 0;
  std::uint32_t frame = 0;  // from which pixel on
  std::uint32_t pixel = 0;
  std::uint32_t has_hand = 0;  // 1: a HandPart follows
  std::uint32_t paints = 0;
  std::uint32_t feedback = 0;
  double side_m = 0;
  std::uint64_t first_tick = 0;
  std::array<double, 7> choice{};  // in the order of exhibit::ScanChoice

  bool operator==(const ScanRecord&) const = default;
};

template <class Visit, scene::RecordOf<ScanRecord>... Record>
constexpr void for_each_field(Visit&& visit, Record&... scan) {
  visit("material", scan.material...);
  visit("frame", scan.frame...);
  visit("pixel", scan.pixel...);
  visit("has_hand", scan.has_hand...);
  visit("paints", scan.paints...);
  visit("feedback", scan.feedback...);
  visit("side_m", scan.side_m...);
  visit("first_tick", scan.first_tick...);
  visit("choice", scan.choice...);
}
static_assert(scene::all_fields_described<ScanRecord>());

// Records that every node must receive completely and in order: each sample and jump of the tip, each edit, each change
// of a scan.
enum class JournalKind : std::uint32_t {
  Sample = 0,
  Event = 1,
  Edit = 2,
  Forget = 3,
  ScanBegin = 4,
  ScanChange = 5,
  ScanEnd = 6
};

class JournalRecord {
 public:
  JournalRecord() = default;  // Forget: all curves are empty again
  explicit JournalRecord(const scene::TipSample& sample) : kind_(JournalKind::Sample) { set(sample); }
  explicit JournalRecord(const scene::TipEvent& event) : kind_(JournalKind::Event) { set(event); }
  explicit JournalRecord(const EditRecord& edit) : kind_(JournalKind::Edit) { set(edit); }
  JournalRecord(JournalKind kind, const ScanRecord& scan) : kind_(kind) { set(scan); }  // of the last three

  JournalKind kind() const { return kind_; }
  // Of that kind alone.
  scene::TipSample sample() const { return get<scene::TipSample>(); }
  scene::TipEvent event() const { return get<scene::TipEvent>(); }
  EditRecord edit() const { return get<EditRecord>(); }
  ScanRecord scan() const { return get<ScanRecord>(); }

  // Enumerators known, numbers finite, materials below scene::kMaxMaterials.
  bool valid() const;

 private:
  template <class Body>
  void set(const Body& body) {
    const auto bytes = std::as_bytes(std::span(&body, 1));
    for (std::size_t i = 0; i < bytes.size(); ++i) body_[i] = bytes[i];
  }
  template <class Body>
  Body get() const {
    Body body;
    const auto bytes = std::as_writable_bytes(std::span(&body, 1));
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = body_[i];
    return body;
  }

  JournalKind kind_ = JournalKind::Forget;
  std::uint32_t padding_ = 0;
  alignas(8) std::array<std::byte, sizeof(scene::TipSample)> body_{};
};

// The records header.number to header.number + count - 1; only those are sent.
struct JournalBatch {
  static constexpr std::size_t kMost = (kMostDatagramBytes - sizeof(ClusterHeader) - 8) / sizeof(JournalRecord);

  ClusterHeader header{};
  std::uint32_t count = 0;
  std::uint32_t padding = 0;
  std::array<JournalRecord, kMost> records{};
};

// A piece of a document that is longer than a datagram: the model of the wall, or what was felt before. All pieces but
// the last are full.
struct DocumentPiece {
  static constexpr std::size_t kBytes = 1200;

  ClusterHeader header{};
  std::uint32_t index = 0;
  std::uint32_t total_bytes = 0;
  std::array<std::byte, kBytes> bytes{};
};

inline constexpr std::uint32_t kMostDocumentBytes = 8U << 20U;

static_assert(std::is_trivially_copyable_v<ReadyMessage> && sizeof(ReadyMessage) <= kMostDatagramBytes);
static_assert(std::is_trivially_copyable_v<SwapMessage> && sizeof(SwapMessage) <= kMostDatagramBytes);
static_assert(std::is_trivially_copyable_v<JournalBatch> && sizeof(JournalBatch) <= kMostDatagramBytes);
static_assert(std::is_trivially_copyable_v<DocumentPiece> && sizeof(DocumentPiece) <= kMostDatagramBytes);

// The message of a datagram, if all of it is valid: its length, its version, every number and enumerator.
template <class Message>
std::optional<Message> decode(std::span<const std::byte> datagram);

// Of the bytes that encode(message) sends.
std::size_t encoded_bytes(const JournalBatch& batch);
template <class Message>
constexpr std::size_t encoded_bytes(const Message& /*any*/) {
  return sizeof(Message);
}

template <class Message>
std::span<const std::byte> encode(const Message& message) {
  return std::as_bytes(std::span(&message, 1)).first(encoded_bytes(message));
}

}  // namespace afm::cluster
