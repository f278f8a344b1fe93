// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/enumerators.h"

namespace afm::scene {

// Scaling of nanometres and nanonewtons to the hand: one scale for all materials; one that fits each material (the
// default); the same with small forces amplified by a bounded compression; or with lateral distances enlarged so much
// that single atoms are felt.
enum class ScaleMode : std::uint32_t { Common = 0, Fit = 1, Compressed = 2, Atoms = 3 };

struct ScaleModeText {
  ScaleMode mode;
  const char* word;     // value of --scale
  const char* meaning;  // text in the help and on the wall
};

inline constexpr std::array kScaleModes{ScaleModeText{ScaleMode::Common, "common", "one scale for all samples"},
                                        ScaleModeText{ScaleMode::Fit, "fit", "each sample on its own scale"},
                                        ScaleModeText{ScaleMode::Compressed, "compressed", "weak forces amplified"},
                                        ScaleModeText{ScaleMode::Atoms, "atoms", "an atom is 1.9 mm wide sideways"}};
static_assert(core::has_row_for_each(kScaleModes, &ScaleModeText::mode));

constexpr const ScaleModeText& text_of(ScaleMode mode) { return kScaleModes[core::index_of(mode)]; }

// Next mode in order; the first one after the last.
constexpr ScaleMode after(ScaleMode mode) { return kScaleModes[(core::index_of(mode) + 1) % kScaleModes.size()].mode; }

}  // namespace afm::scene
