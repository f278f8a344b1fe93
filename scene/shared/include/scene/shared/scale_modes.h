// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/enumerators.h"

namespace afm::scene {

// Scaling of nanometres and nanonewtons to the hand: one scale for all materials; one that fits each material (the
// default); the same with small forces amplified by a bounded compression; with lateral distances enlarged so much
// that single atoms are felt; or, if there are particles to push, one that makes these large.
enum class ScaleMode : std::uint32_t { Common = 0, Fit = 1, Compressed = 2, Atoms = 3, Particles = 4 };

struct ScaleModeText {
  ScaleMode mode;
  const char* word;     // value of --scale
  const char* meaning;  // text in the help and on the wall
};

inline constexpr std::array kScaleModes{
    ScaleModeText{ScaleMode::Common, "common", "one scale for all samples"},
    ScaleModeText{ScaleMode::Fit, "fit", "each sample on its own scale"},
    ScaleModeText{ScaleMode::Compressed, "compressed", "weak forces amplified"},
    ScaleModeText{ScaleMode::Atoms, "atoms", "an atom is 1.9 mm wide sideways"},
    ScaleModeText{ScaleMode::Particles, "particles", "a particle is up to 10 mm wide"}};
static_assert(core::has_row_for_each(kScaleModes, &ScaleModeText::mode));

// The scales that every sample has: all but that of the particles.
inline constexpr std::array kScalesOfSamples{kScaleModes[0], kScaleModes[1], kScaleModes[2], kScaleModes[3]};
static_assert(kScalesOfSamples.size() + 1 == kScaleModes.size() && kScaleModes.back().mode == ScaleMode::Particles);

constexpr const ScaleModeText& text_of(ScaleMode mode) { return kScaleModes[core::index_of(mode)]; }

// Next mode in order; the first one after the last. Without particles there is no scale for them.
constexpr ScaleMode after(ScaleMode mode, bool has_particles) {
  const ScaleMode next = kScaleModes[(core::index_of(mode) + 1) % kScaleModes.size()].mode;
  return next == ScaleMode::Particles && !has_particles ? after(next, has_particles) : next;
}

}  // namespace afm::scene
