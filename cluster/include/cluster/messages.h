// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "scene/shared/field_visitor.h"
#include "scene/shared/task_score.h"
#include "scene/shared/tip_blocks.h"

// Messages between the machines of a wall: trivially copyable blocks, each in one datagram. Data from the network is
// used only after decode() has checked all of it. No message leads to the servo.
namespace afm::cluster {

// Keeps a datagram with the headers of UDP, IP and DDS below the 1500 bytes of an Ethernet frame: every fragment could
// be lost.
inline constexpr std::size_t kMostDatagramBytes = 1300;

// Increase whenever the meaning of a message changes.
inline constexpr std::uint32_t kClusterVersion = 13;

// Header of every message. Each master draws a random `session` when it starts.
struct ClusterHeader {
  std::uint32_t version = kClusterVersion;
  std::uint32_t node = 0;  // index into Wall::nodes: sender of a ReadyMessage
  std::uint64_t session = 0;
  std::uint64_t number = 0;  // number of the frame, of a batch's first record, or of a document

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

// State of a node that has drawn a frame or reports its progress; the master measures times on its own clock.
enum class NodeState : std::uint32_t { Loading = 0, Drawing = 1, OtherBuild = 2, OtherScene = 3 };

struct ReadyMessage {
  ClusterHeader header{};
  NodeState state = NodeState::Loading;
  std::uint32_t wants_history = 0;  // 1: some earlier records are missing
  std::uint64_t digest = 0;         // digest of the frame as built, or of the scene or the build if those differ
  std::int64_t frame_sent_ns = 0;   // copy from FrameMessage, master's clock
  std::int64_t frame_came_ns = 0;   // arrival of the frame, node's clock
  std::int64_t ready_sent_ns = 0;   // sending of this answer, node's clock
  std::int64_t swapped_ns = 0;      // display of the previous frame, node's clock
  std::uint64_t lost_records = 0;   // number of gaps in the journal so far
  std::uint32_t draw_us = 0;
  std::uint32_t late_swaps = 0;  // number of frames shown although no SwapMessage arrived
  std::uint32_t stops = 0;       // number of presses of Stop so far
  std::uint32_t unseen = 0;      // 1: picture of this node visible to nobody

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
  visit("stops", ready.stops...);
  visit("unseen", ready.unseen...);
}
static_assert(scene::all_fields_described<ReadyMessage>());

// Command to show the frame: all awaited nodes have drawn it.
struct SwapMessage {
  ClusterHeader header{};
};

template <class Visit, scene::RecordOf<SwapMessage>... Record>
constexpr void for_each_field(Visit&& visit, Record&... swap) {
  visit("header", swap.header...);
}
static_assert(scene::all_fields_described<SwapMessage>());

// Parameters of a material as set by a person: curves::LiveParameters::State, and the servo's revision.
struct EditRecord {
  std::uint32_t material = 0;
  std::uint32_t revision = 0;
  std::array<std::int32_t, 8> steps{};
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

// Start of a scan on the wall, or a change of its settings: exhibit::ScanChange, with the hand's part of it.
struct ScanRecord {
  std::uint32_t material = 0;
  std::uint32_t frame = 0;  // frame and pixel from which it takes effect
  std::uint32_t pixel = 0;
  std::uint32_t has_hand = 0;  // 1: the following fields describe the HandPart
  std::uint32_t paints = 0;
  std::uint32_t feedback = 0;
  double side_m = 0;
  std::uint64_t first_tick = 0;
  std::array<double, 9> choice{};  // values in the order of exhibit::ScanChoice

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

// Changed pose of a particle, or changed source of its place in the picture.
struct PoseRecord {
  std::uint32_t particle = 0;
  std::uint32_t known = 0;  // value of servo::Known
  scene::ParticlePose pose{};

  bool operator==(const PoseRecord&) const = default;
};

template <class Visit, scene::RecordOf<PoseRecord>... Record>
constexpr void for_each_field(Visit&& visit, Record&... record) {
  visit("particle", record.particle...);
  visit("known", record.known...);
  visit("pose", record.pose...);
}
static_assert(scene::all_fields_described<PoseRecord>());

// Picture of the particles at levels 1 and 2: servo::PictureNow without the fields of PoseRecord, and a look's load.
struct PictureRecord {
  static constexpr std::uint32_t kMostKnown = 2;  // largest servo::Known

  std::uint32_t level = 0;  // 0: no picture, and all other fields are ignored
  std::uint32_t particle = 0;
  std::uint32_t all_measured = 1;
  std::uint32_t looks = 0;
  std::uint32_t newest_particle = 0;
  std::uint32_t newest_lines = 0;
  std::uint32_t newest_found = 0;  // 1: newest_off_m is valid
  std::uint32_t looking = 0;       // 1: look_share describes the current look
  double look_share = 0;
  double age_s = 0;
  double doubt_m = 0;
  double newest_off_m = 0;
  double newest_swept_above_n = 0;
  double look_load_n = 0;  // load of the next look

  bool operator==(const PictureRecord&) const = default;
};

template <class Visit, scene::RecordOf<PictureRecord>... Record>
constexpr void for_each_field(Visit&& visit, Record&... record) {
  visit("level", record.level...);
  visit("particle", record.particle...);
  visit("all_measured", record.all_measured...);
  visit("looks", record.looks...);
  visit("newest_particle", record.newest_particle...);
  visit("newest_lines", record.newest_lines...);
  visit("newest_found", record.newest_found...);
  visit("looking", record.looking...);
  visit("look_share", record.look_share...);
  visit("age_s", record.age_s...);
  visit("doubt_m", record.doubt_m...);
  visit("newest_off_m", record.newest_off_m...);
  visit("newest_swept_above_N", record.newest_swept_above_n...);
  visit("look_load_N", record.look_load_n...);
}
static_assert(scene::all_fields_described<PictureRecord>());

// Changed row of a MarkTile.
struct MarkRecord {
  std::uint32_t tile = 0;
  std::uint32_t row = 0;
  std::array<double, scene::kTileSide> pressed_m{};
  std::array<double, scene::kTileSide> back_m{};

  bool operator==(const MarkRecord&) const = default;
};

template <class Visit, scene::RecordOf<MarkRecord>... Record>
constexpr void for_each_field(Visit&& visit, Record&... record) {
  visit("tile", record.tile...);
  visit("row", record.row...);
  visit("pressed_m", record.pressed_m...);
  visit("back_m", record.back_m...);
}
static_assert(scene::all_fields_described<MarkRecord>());

// Records that every node must receive completely and in order: each sample and jump of the tip, each edit, each change
// of a scan, each particle that has moved, the push of a frame, the score of a task, the plan of a push, each row of
// marks that has changed, and the picture of the particles.
enum class JournalKind : std::uint32_t {
  Sample = 0,
  Event = 1,
  Edit = 2,
  Forget = 3,
  ScanBegin = 4,
  ScanChange = 5,
  ScanEnd = 6,
  Pose = 7,
  Push = 8,
  Score = 9,
  Plan = 10,
  Mark = 11,
  Picture = 12
};

class JournalRecord {
 public:
  JournalRecord() = default;  // Forget: clears all curves
  explicit JournalRecord(const scene::TipSample& sample) : kind_(JournalKind::Sample) { set(sample); }
  explicit JournalRecord(const scene::TipEvent& event) : kind_(JournalKind::Event) { set(event); }
  explicit JournalRecord(const EditRecord& edit) : kind_(JournalKind::Edit) { set(edit); }
  JournalRecord(JournalKind kind, const ScanRecord& scan) : kind_(kind) { set(scan); }  // kinds of a scan
  explicit JournalRecord(const PoseRecord& pose) : kind_(JournalKind::Pose) { set(pose); }
  explicit JournalRecord(const scene::TipPush& push) : kind_(JournalKind::Push) { set(push); }
  explicit JournalRecord(const scene::TaskScore& score) : kind_(JournalKind::Score) { set(score); }
  explicit JournalRecord(const scene::PlannedPush& plan) : kind_(JournalKind::Plan) { set(plan); }
  explicit JournalRecord(const MarkRecord& mark) : kind_(JournalKind::Mark) { set(mark); }
  explicit JournalRecord(const PictureRecord& picture) : kind_(JournalKind::Picture) { set(picture); }

  JournalKind kind() const { return kind_; }
  // Valid only for records of that kind.
  scene::TipSample sample() const { return get<scene::TipSample>(); }
  scene::TipEvent event() const { return get<scene::TipEvent>(); }
  EditRecord edit() const { return get<EditRecord>(); }
  ScanRecord scan() const { return get<ScanRecord>(); }
  PoseRecord pose() const { return get<PoseRecord>(); }
  scene::TipPush push() const { return get<scene::TipPush>(); }
  scene::TaskScore score() const { return get<scene::TaskScore>(); }
  scene::PlannedPush plan() const { return get<scene::PlannedPush>(); }
  MarkRecord mark() const { return get<MarkRecord>(); }
  PictureRecord picture() const { return get<PictureRecord>(); }

  // True if enumerators are known, numbers finite, materials below scene::kMaxMaterials, and particles below
  // scene::kMaxParticles.
  bool valid() const;

 private:
  // Size of a sample without its last fields, inputs for a picture of particles, which no other machine computes.
  static constexpr std::size_t kBodyBytes = offsetof(scene::TipSample, level);

  template <class Body>
  static constexpr std::size_t bytes_of() {
    static_assert(sizeof(Body) <= kBodyBytes || std::is_same_v<Body, scene::TipSample>);
    return std::min(sizeof(Body), kBodyBytes);
  }
  template <class Body>
  void set(const Body& body) {
    const auto bytes = std::as_bytes(std::span(&body, 1)).first(bytes_of<Body>());
    for (std::size_t i = 0; i < bytes.size(); ++i) body_[i] = bytes[i];
  }
  template <class Body>
  Body get() const {
    Body body;
    const auto bytes = std::as_writable_bytes(std::span(&body, 1)).first(bytes_of<Body>());
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = body_[i];
    return body;
  }

  JournalKind kind_ = JournalKind::Forget;
  std::uint32_t padding_ = 0;
  alignas(8) std::array<std::byte, kBodyBytes> body_{};
};

// Records header.number to header.number + count - 1; only these are sent.
struct JournalBatch {
  static constexpr std::size_t kMost = (kMostDatagramBytes - sizeof(ClusterHeader) - 8) / sizeof(JournalRecord);

  ClusterHeader header{};
  std::uint32_t count = 0;
  std::uint32_t padding = 0;
  std::array<JournalRecord, kMost> records{};
};

// Piece of a document longer than a datagram: the model of the wall, or the history. All pieces except the last are
// full.
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

// Decodes a datagram if all of it is valid: its length, its version, every number and enumerator.
template <class Message>
std::optional<Message> decode(std::span<const std::byte> datagram);

// Number of bytes that encode(message) sends.
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
