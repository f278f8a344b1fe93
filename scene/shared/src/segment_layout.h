// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/latest_value.h"
#include "core/spsc_ring.h"
#include "scene/shared/shared_segment.h"

namespace afm::scene {

inline constexpr std::uint64_t kSegmentMagic = 0x314D46414D464154;  // bytes "TAFMAFM1" in memory

// Sizes of the blocks in this build, in the order of SegmentLayout: two builds that differ reject each other.
using BlockSizes = std::array<std::uint32_t, 16>;
inline constexpr BlockSizes kBlockSizes{
    sizeof(SharedModel), sizeof(SceneTransforms),   sizeof(Selection),    sizeof(MaterialEdit),
    sizeof(HandScript),  sizeof(RendererHeartbeat), sizeof(TipState),     sizeof(TipSample),
    sizeof(TipEvent),    sizeof(ServoTiming),       sizeof(SharedDevice), sizeof(ScanLead),
    sizeof(TipPush),     sizeof(ParticlePage),      sizeof(PlannedPush),  sizeof(MarkTile)};

struct SegmentHeader {
  std::uint64_t magic = kSegmentMagic;
  std::uint32_t version = kSegmentVersion;
  std::uint32_t padding = 0;
  std::uint64_t total_bytes = 0;
  std::uint64_t scene_digest = 0;
  BlockSizes block_bytes = kBlockSizes;
};

// Layout of the segment, byte for byte. No pointers; every channel has one writer.
struct SegmentLayout {
  alignas(4096) SegmentHeader header;
  alignas(4096) SharedModel model;

  // written by touchafm
  alignas(4096) core::LatestValue<SceneTransforms> transforms;
  core::LatestValue<Selection> selection;
  std::array<core::LatestValue<MaterialEdit>, kMaxMaterials> edits;  // newest edit of every material
  core::LatestValue<HandScript> hand_script;
  core::LatestValue<ScanLead> scan_lead;
  core::LatestValue<PlannedPush> plan;
  core::LatestValue<RendererHeartbeat> heartbeat;

  // written by touchafm-servo; touchafm writes the tail of a ring
  alignas(4096) core::LatestValue<TipState> tip_state;
  core::LatestValue<ServoTiming> timing;
  core::LatestValue<SharedDevice> device;
  core::LatestValue<TipPush> tip_push;
  std::array<core::LatestValue<ParticlePage>, kParticlePages> particle_pages;
  std::array<core::LatestValue<MarkTile>, kMarkTiles> mark_tiles;
  core::SpscRing<TipSample, kSampleRingCapacity> samples;
  core::SpscRing<TipEvent, kEventRingCapacity> events;
};

static_assert(std::is_standard_layout_v<SegmentLayout> && std::is_trivially_destructible_v<SegmentLayout>);

}  // namespace afm::scene
