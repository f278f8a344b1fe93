// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/shared/particle_blocks.h"
#include "servo/live_picture.h"
#include "servo/session_file.h"

namespace afm::servo {

// First number of a tick or an event that a replay did not reproduce.
struct Difference {
  std::size_t index = 0;  // index of the differing sample or event
  std::string quantity;   // name of the quantity, "hand_force_N"
  double recorded = 0;    // recorded value, the number of an enumerator
  double replayed = 0;
};

struct Replay {
  std::size_t ticks = 0;   // number of ticks compared
  std::size_t events = 0;  // number of events in the replay
  std::size_t different_ticks = 0;
  std::optional<Difference> first;  // first difference of a sample
  std::optional<Difference> first_event;
  double largest_tip_n = 0;   // largest difference of the force on the tip
  double largest_hand_n = 0;  // largest difference of the force on the hand, along the sample's normal

  bool identical() const { return !first && !first_event; }
};

// Part of a session to compare, in seconds from its first tick. Earlier ticks are replayed too, because the forces
// depend on them.
struct ReplayRange {
  double from_s = 0;
  double to_s = std::numeric_limits<double>::infinity();

  bool holds(double at_s) const { return at_s >= from_s && at_s <= to_s; }
};

// A tick of a replay as the session has it, the events since the tick before it, and the particles after it in the
// replay. Valid only in the call.
struct ReplayedTick {
  const scene::TipSample& sample;
  std::span<const scene::TipEvent> events;
  std::span<const scene::ParticlePage> pages;
  const LivePicture* picture = nullptr;  // picture at level 1 and 2; null at level 0
};
using HearTick = std::function<void(const ReplayedTick& tick)>;

// Runs the recorded hand through a servo at the recorded times, with the renderer's heartbeats as recorded, and
// compares every number bit for bit. Needs no clock, and takes about a thousandth of the session's time. Fails if a
// servo rejects the session's materials or settings. Calls `hear` for every tick up to the end of the range, if it is
// set.
core::Result<Replay> replay(const RecordedSession& session, const ReplayRange& range = {}, const HearTick& hear = {});

// Particles after a tick. A session has their poses only at its start: all others follow from its hand.
struct ReplayedParticles {
  std::vector<scene::ParticlePage> pages;
  std::vector<scene::MarkTile> tiles{};  // marks of a soft sample or of ink
  scene::TipPush push;
  scene::PlannedPush plan;
  std::optional<PictureNow> picture{};  // picture at level 1 and 2, shown in `pages`; empty at level 0
};

// Replays a session with particles up to its last tick at or before `time_ns`, and at least its first. Fails as
// replay() does, and if the replay has other places than the session had.
core::Result<ReplayedParticles> replay_particles(const RecordedSession& session, std::int64_t time_ns,
                                                 const HearTick& hear = {});

}  // namespace afm::servo
