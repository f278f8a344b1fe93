// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/shared/field_visitor.h"

// Blocks of a picture of particles that is computed while a tip pushes them (docs/manipulation.md, "A picture that
// grows old").
namespace afm::scene {

// ---- constant after the segment is created (written by touchafm, part of SharedParticles) ----

inline constexpr std::uint32_t kHighestLevel = 2;
inline constexpr std::uint32_t kLargestSeed = 65535;

// How far the picture of the particles is from them: level and seed of scene::PushScript.
struct SharedLevel {
  std::uint32_t level =
      0;                   // 0: the particles themselves are shown; 1: the computed picture is right; 2: drift, scatter
  std::uint32_t seed = 1;  // seed of drift and scatter, 1 to 65535
  std::int64_t since_ns = 0;  // start of the drift, a time as in TipState; 0: first tick of the servo

  bool operator==(const SharedLevel&) const = default;
};

template <class Visit, RecordOf<SharedLevel>... Record>
constexpr void for_each_field(Visit&& visit, Record&... level) {
  visit("level", level.level...);
  visit("seed", level.seed...);
  visit("since_ns", level.since_ns...);
}
static_assert(all_fields_described<SharedLevel>());

// ---- written by touchafm-servo ----

// State of the sample below the tip from which a picture of some level is computed, recorded in every tick.
struct LevelSample {
  std::int64_t since_ns = 0;  // start of the drift; 0: none
  std::uint64_t met = 0;      // as in TipPush, but 0 at level 0
};

template <class Visit, RecordOf<LevelSample>... Record>
constexpr void for_each_field(Visit&& visit, Record&... level) {
  visit("drift_since_ns", level.since_ns...);
  visit("met", level.met...);
}
static_assert(all_fields_described<LevelSample>());

}  // namespace afm::scene
