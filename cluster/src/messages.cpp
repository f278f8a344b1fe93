// SPDX-License-Identifier: Apache-2.0
#include "cluster/messages.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "cluster/frame_message.h"
#include "core/enumerators.h"
#include "scene/shared/shared_segment.h"

namespace afm::cluster {

namespace {

constexpr double kLargestSent = 1e9;     // limit as in the shared scene
constexpr double kUnitTolerance = 1e-3;  // deviation of an orientation's length from 1
constexpr double kLargestSwingM = 1e-3;
constexpr std::int32_t kFarthestStep = 8192;  // steps between an edited and the loaded value: the side of a map

template <std::floating_point Number>
bool sound(Number value) {
  return std::isfinite(value) && std::abs(static_cast<double>(value)) <= kLargestSent;
}
template <std::integral Integer>
bool sound(Integer /*any*/) {
  return true;
}
template <class Enumerator>
  requires std::is_enum_v<Enumerator>
bool sound(Enumerator value) {
  return core::is_enumerator(value);
}
template <class Number, std::size_t Count>
bool sound(const std::array<Number, Count>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](Number number) { return sound(number); });
}
template <scene::Described Block>
bool sound(const Block& block) {
  bool all = true;
  for_each_field([&](const char*, const auto& value) { all = all && sound(value); }, block);
  return all;
}

// Limit for the numbers of materials and particles in a block: the largest possible model.
const scene::SharedModel& most_materials() {
  static const std::unique_ptr<const scene::SharedModel> model = [] {
    auto most = std::make_unique<scene::SharedModel>();
    most->material_count = scene::kMaxMaterials;
    most->particles.count = scene::kMaxParticles;
    return most;
  }();
  return *model;
}

bool is_material(std::int32_t material) {
  return material >= -1 && material < static_cast<std::int32_t>(scene::kMaxMaterials);
}

bool is_turned(const scene::Pose& pose) {
  double square = 0;
  for (const double part : pose.orientation) square += part * part;
  return std::abs(square - 1.0) < kUnitTolerance;
}

bool is_valid(const EditRecord& edit) {
  const auto near = [](std::int32_t step) { return std::abs(step) <= kFarthestStep; };
  return edit.material < scene::kMaxMaterials && std::all_of(edit.steps.begin(), edit.steps.end(), near) &&
         edit.refused_row >= -1 && edit.refused_row < static_cast<std::int32_t>(edit.steps.size()) &&
         std::abs(edit.refused_direction) <= 1;
}

bool is_valid(const ScanRecord& scan) {
  return sound(scan) && scan.material < scene::kMaxMaterials && scan.has_hand <= 1 && scan.paints <= 1 &&
         scan.feedback <= 1;
}

bool is_valid(const PoseRecord& record) {
  double square = 0;
  for (const double part : record.pose.orientation) square += part * part;
  return sound(record) && record.particle < scene::kMaxParticles && record.known <= PictureRecord::kMostKnown &&
         std::abs(square - 1.0) < kUnitTolerance;
}

bool is_valid(const PictureRecord& picture) {
  return sound(picture) && picture.level <= scene::kHighestLevel && picture.particle < scene::kMaxParticles &&
         picture.newest_particle < scene::kMaxParticles && picture.all_measured <= 1 && picture.newest_found <= 1 &&
         picture.looking <= 1;
}

bool is_valid(const MarkRecord& record) {
  const auto near = [](double height_m) { return std::abs(height_m) <= scene::kMostMarkM; };  // false for NaN
  return record.tile < scene::kMarkTiles && record.row < scene::kTileSide &&
         std::all_of(record.pressed_m.begin(), record.pressed_m.end(), near) &&
         std::all_of(record.back_m.begin(), record.back_m.end(), near);
}

bool is_valid(const ReadyMessage& ready) {
  return sound(ready) && ready.wants_history <= 1 && ready.unseen <= 1 && ready.header.node < scene::kMostNodes;
}

bool is_valid(const SwapMessage& /*any*/) { return true; }

bool is_valid(const ShownMoment& moment) {
  return sound(moment) && moment.flags <= ShownMoment::kAllFlags &&
         moment.centerpiece < ShownMoment::kMostCenterpieces && moment.centerpiece != ShownMoment::kNoCenterpiece &&
         is_material(moment.hovered) && is_turned(moment.wand) && moment.fade >= 0 && moment.fade <= 1 &&
         moment.journey_orders >= 0 && moment.journey_orders <= 9 && moment.cue_age_s >= 0 &&
         moment.cue_age_s <= ShownMoment::kLongestCueS;
}

bool is_valid(const ShownView& view) {
  const auto human = [](double ipd_m) { return ipd_m >= 0 && ipd_m <= scene::kLargestIpdM; };
  return sound(view) && is_turned(view.head) && human(view.ipd_m) && human(view.drawn_ipd_m) && view.mode >= -1 &&
         view.mode < static_cast<std::int32_t>(scene::kStereoModes.size()) && view.flags <= ShownView::kAllFlags &&
         view.relief <= 1;
}

bool is_valid(const ShownPanels& panels) {
  return panels.flags <= ShownPanels::kAllFlags && panels.right < ShownPanels::kMostRight &&
         panels.marked < ShownPanels::kMostRows && panels.hand < ShownPanels::kMostHands &&
         panels.control_kind < ShownPanels::kMostControls && panels.control_index < ShownPanels::kMostTargets;
}

bool is_valid(const FrameMessage& frame) {
  const double amplitude_m = frame.tip.swing.amplitude_m;
  return sound(frame.tip) && amplitude_m >= 0 && amplitude_m <= kLargestSwingM && frame.tip.slow_motion > 0 &&
         frame.tip.realtime <= 1 && is_material(frame.tip.material) && is_valid(frame.moment) && is_valid(frame.view) &&
         is_valid(frame.panels) && frame.texts.bytes.back() == '\0';
}

bool is_valid(const JournalBatch& batch) {
  return batch.count >= 1 && batch.count <= JournalBatch::kMost &&
         std::all_of(batch.records.begin(), batch.records.begin() + batch.count,
                     [](const JournalRecord& record) { return record.valid(); });
}

bool is_valid(const DocumentPiece& piece) {
  const std::size_t pieces = (piece.total_bytes + DocumentPiece::kBytes - 1) / DocumentPiece::kBytes;
  return piece.total_bytes > 0 && piece.total_bytes <= kMostDocumentBytes && piece.index < pieces;
}

template <class Message>
constexpr std::size_t kLeastBytes = sizeof(Message);
template <>
constexpr std::size_t kLeastBytes<JournalBatch> = offsetof(JournalBatch, records);

}  // namespace

bool JournalRecord::valid() const {
  if (!core::is_enumerator(kind_)) return false;
  switch (kind_) {
    case JournalKind::Sample:
      return sample().material >= 0 && scene::is_valid(sample(), most_materials());
    case JournalKind::Event:
      return event().material >= 0 && scene::is_valid(event(), most_materials());
    case JournalKind::Edit:
      return is_valid(edit());
    case JournalKind::ScanBegin:
    case JournalKind::ScanChange:
      return is_valid(scan());
    case JournalKind::Pose:
      return is_valid(pose());
    case JournalKind::Push:
      return scene::is_valid(push(), most_materials());
    case JournalKind::Score:
      return sound(score());
    case JournalKind::Plan:
      return scene::is_valid(plan(), most_materials());
    case JournalKind::Mark:
      return is_valid(mark());
    case JournalKind::Picture:
      return is_valid(picture());
    case JournalKind::Forget:
    case JournalKind::ScanEnd:
      break;
  }
  return true;
}

std::size_t encoded_bytes(const JournalBatch& batch) {
  return offsetof(JournalBatch, records) + batch.count * sizeof(JournalRecord);
}

template <class Message>
std::optional<Message> decode(std::span<const std::byte> datagram) {
  Message message;
  if (datagram.size() < kLeastBytes<Message> || datagram.size() > sizeof(Message)) return std::nullopt;
  const std::span<std::byte> to = std::as_writable_bytes(std::span(&message, 1));
  std::copy(datagram.begin(), datagram.end(), to.begin());
  if (message.header.version != kClusterVersion || !is_valid(message)) return std::nullopt;
  if (datagram.size() != encoded_bytes(message)) return std::nullopt;
  return message;
}

template std::optional<ReadyMessage> decode<ReadyMessage>(std::span<const std::byte>);
template std::optional<SwapMessage> decode<SwapMessage>(std::span<const std::byte>);
template std::optional<JournalBatch> decode<JournalBatch>(std::span<const std::byte>);
template std::optional<DocumentPiece> decode<DocumentPiece>(std::span<const std::byte>);
template std::optional<FrameMessage> decode<FrameMessage>(std::span<const std::byte>);

}  // namespace afm::cluster
