// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <string>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "physics/law.h"
#include "scene/shared/felt_heights.h"
#include "scene/shared/tip_blocks.h"

namespace afm::physics {
struct DrivenLever;
}

// Memory shared by touchafm and touchafm-servo: a header page, the constant SharedModel, and one channel per block.
namespace afm::scene {

// Increase whenever the meaning of a block changes; changes of a block's size are detected automatically.
inline constexpr std::uint32_t kSegmentVersion = 21;

inline constexpr std::uint32_t kSampleRingCapacity = 16384;  // 16 s at 1 kHz
inline constexpr std::uint32_t kEventRingCapacity = 256;

struct SegmentLayout;

// Checks that counts are in range, parents come before children, names are terminated, numbers finite, and materials
// and curves valid as below.
core::Result<void> validate(const SharedModel& model);

// Checks that physics::validate() accepts a material, and that its law and options are known; the counts are those of
// its SharedModel. Only building it can show if it can also be felt.
core::Result<void> validate(const SharedContact& material, std::uint32_t curve_count, std::uint32_t height_field_count,
                            const SharedTopography& topography = {});

// Checks that physics::validate() accepts the particles, that there are at most kMaxParticles, and that their size and
// threshold in a hand are positive. Takes some 10 ms for the most particles.
core::Result<void> validate(const SharedParticles& particles);

physics::LawOptions law_options(const SharedContact& material);

// Lever of a material in tapping mode; throws like physics::driven_lever().
physics::DrivenLever tapping_lever(const SharedContact& material);

// True if a block is valid: indices within counts, enumerators known, numbers finite.
bool is_valid(const SharedMeasuredCurve& curve);
bool is_valid(const SharedLawMap& map);  // also valid without a map
bool is_valid(const SceneTransforms& transforms, const SharedModel& model);
bool is_valid(const Selection& selection, const SharedModel& model);
bool is_valid(const HandScript& script);
bool is_valid(const ScanLead& lead);
bool is_valid(const RendererHeartbeat& heartbeat);
bool is_valid(const SharedDevice& device);
bool is_valid(const TipState& state, const SharedModel& model);
bool is_valid(const TipSample& sample, const SharedModel& model);
bool is_valid(const TipEvent& event, const SharedModel& model);
bool is_valid(const ParticlePage& page);
bool is_valid(const PlannedPush& plan, const SharedModel& model);
bool is_valid(const TipPush& push, const SharedModel& model);

// Reason why a force law cannot be felt with this friction; empty if it can. The paper's law is felt as in the paper.
std::string why_no_friction(physics::FrictionLaw friction, physics::Law law, physics::Pressure reduced_modulus);

// Transform of `node` at rest, composed with its parents. `model` is valid and `node` is less than its node_count.
glm::dmat4 rest_room_from_node(const SharedModel& model, std::uint32_t node);

// touchafm's end of the channels. Keep one for the lifetime of the segment and use it from one thread: it is the single
// writer of the blocks it stores and the single consumer of the two rings. Never waits; drops and counts implausible
// data.
class RendererSide {
 public:
  void store(const SceneTransforms& transforms) noexcept;
  void store(const Selection& selection) noexcept;
  void store(const MaterialEdit& edit, std::uint32_t material) noexcept;  // material < material_count
  void store(const HandScript& script) noexcept;
  void store(const ScanLead& lead) noexcept;
  void store(const PlannedPush& plan) noexcept;
  void store(const RendererHeartbeat& heartbeat) noexcept;

  // Last value stored by this side, for a process that replaces one that died and must continue its revisions. Empty if
  // nothing was stored completely.
  std::optional<Selection> last_selection() const noexcept;
  std::optional<HandScript> last_hand_script() const noexcept;
  std::optional<MaterialEdit> last_edit(std::uint32_t material) const noexcept;  // material < material_count

  // Empty before the servo's first tick, or if the servo died in the middle of a store.
  std::optional<TipState> tip_state() noexcept;
  std::optional<ServoTiming> servo_timing() const noexcept;  // updated about 5 times a second

  std::optional<SharedDevice> device() noexcept;  // empty until a servo has started

  // Empty without particles, or before the servo's first tick.
  std::optional<TipPush> tip_push() noexcept;

  // Page of poses if it is newer than the one last returned by this side. `page` < kParticlePages.
  std::optional<ParticlePage> new_particle_page(std::uint32_t page) noexcept;

  // Same for a tile of a soft sample. `tile` < kMarkTiles.
  std::optional<MarkTile> new_mark_tile(std::uint32_t tile) noexcept;

  // Next sample or event in order, or empty.
  std::optional<TipSample> pop_sample() noexcept;
  std::optional<TipEvent> pop_event() noexcept;

  std::uint64_t lost_samples() const noexcept;  // samples dropped by the servo because the ring was full
  std::uint64_t refused_blocks() const noexcept { return refused_; }

 private:
  friend class SharedSegment;
  explicit RendererSide(SegmentLayout& layout) : layout_(&layout) {}

  SegmentLayout* layout_;
  std::array<std::uint64_t, kParticlePages> seen_pages_{};
  std::array<std::uint64_t, kMarkTiles> seen_tiles_{};
  std::uint64_t refused_ = 0;
};

// The servo's end of the channels, only for its thread; wait-free, so usable in a tick. The new_...() functions return
// each value once: they are empty if nothing new has arrived, and the caller keeps its old value.
class ServoSide {
 public:
  std::optional<SceneTransforms> new_transforms() noexcept;
  std::optional<Selection> new_selection() noexcept;
  std::optional<HandScript> new_hand_script() noexcept;
  std::optional<ScanLead> new_scan_lead() noexcept;
  std::optional<PlannedPush> new_plan() noexcept;
  std::optional<RendererHeartbeat> new_heartbeat() noexcept;

  void store(const TipState& state) noexcept;
  void store(const ServoTiming& timing) noexcept;
  void store(const SharedDevice& device) noexcept;
  void store(const TipPush& push) noexcept;
  void store(const ParticlePage& page, std::uint32_t number) noexcept;  // number < kParticlePages
  void store(const MarkTile& tile, std::uint32_t number) noexcept;      // number < kMarkTiles
  void push(const TipSample& sample) noexcept;  // counted as lost if the renderer is 16 s behind
  void push(const TipEvent& event) noexcept;

  // Last page stored by this side, for a servo that replaces one that ended and continues with its poses; empty if it
  // is not valid. `number` < kParticlePages.
  std::optional<ParticlePage> last_particle_page(std::uint32_t number) const noexcept;

  // Same for a tile. `number` < kMarkTiles.
  std::optional<MarkTile> last_mark_tile(std::uint32_t number) const noexcept;

  std::uint32_t refused_blocks() const noexcept { return refused_; }

 private:
  friend class SharedSegment;
  explicit ServoSide(SegmentLayout& layout) : layout_(&layout) {}

  SegmentLayout* layout_;
  std::uint64_t seen_transforms_ = 0;
  std::uint64_t seen_selection_ = 0;
  std::uint64_t seen_script_ = 0;
  std::uint64_t seen_lead_ = 0;
  std::uint64_t seen_plan_ = 0;
  std::uint64_t seen_heartbeat_ = 0;
  std::uint32_t refused_ = 0;
};

// Interface for the thread that builds the servo's contact models.
class EditSide {
 public:
  // Newest edit of this material, returned once; unchecked. `material` < kMaxMaterials.
  std::optional<MaterialEdit> new_edit(std::uint32_t material) noexcept;

  // Newest selection, returned once; empty if it is not valid.
  std::optional<Selection> new_selection() noexcept;

 private:
  friend class SharedSegment;
  explicit EditSide(SegmentLayout& layout) : layout_(&layout) {}

  SegmentLayout* layout_;
  std::array<std::uint64_t, kMaxMaterials> seen_{};
  std::uint64_t seen_selection_ = 0;
};

// Anonymous memory file, sealed against resizing and mapped. It has no name: processes get it by inheriting the
// descriptor, and it disappears when the last of them ends. Can also be shared by two threads of one process.
class SharedSegment {
 public:
  // `model` must be valid (see validate); `scene_digest` is digest(Scene) of the scene that it describes; `topography`
  // has the size given in the model. A segment without one is no longer than its blocks.
  static core::Result<SharedSegment> create(const SharedModel& model, std::uint64_t scene_digest,
                                            const Topography& topography = {});

  // Maps a segment created by another process. The error names both versions if they differ.
  static core::Result<SharedSegment> attach(core::FileDescriptor descriptor);

  int descriptor() const noexcept { return descriptor_.get(); }
  const SharedModel& model() const noexcept;
  std::uint64_t scene_digest() const noexcept;

  // Current copy of the topography; without columns if there is none. Unchecked: see is_valid.
  Topography topography() const;

  // Call each function once per process that uses that side; the segment must outlive the result (moving the segment is
  // harmless).
  RendererSide renderer_side() noexcept { return RendererSide(*layout_); }
  ServoSide servo_side() noexcept { return ServoSide(*layout_); }
  EditSide edit_side() noexcept { return EditSide(*layout_); }

 private:
  struct Unmap {
    std::size_t bytes = 0;
    void operator()(SegmentLayout* layout) const noexcept;
  };

  SharedSegment(core::FileDescriptor descriptor, SegmentLayout* layout, std::size_t bytes)
      : descriptor_(std::move(descriptor)), layout_(layout, Unmap{bytes}) {}

  core::FileDescriptor descriptor_;
  std::unique_ptr<SegmentLayout, Unmap> layout_;
};

}  // namespace afm::scene
