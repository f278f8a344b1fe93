// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/result.h"

namespace afm::render {

// Purpose of a text; determines its size on the wall.
enum class TextStyle { Small, Body, Strong, Title, Guidance };
inline constexpr std::size_t kTextStyles = 5;

// Height of the em square, in the panels' millimetres.
float text_height_mm(TextStyle style);

// Glyphs of all styles, drawn once at the resolution of the panels' textures.
struct PanelFonts {
  std::unique_ptr<ImFontAtlas> atlas;
  std::array<ImFont*, kTextStyles> fonts{};
  float texels_per_mm = 1.0F;  // resolution of the panels
  float true_mm = 1.0F;        // a millimetre of the room, in the panels' millimetres
};

// Reads the system's fonts: Inter (fonts-inter), and DejaVu Sans (fonts-dejavu-core) for missing glyphs or as a
// replacement. Lengths as in RendererOptions; the resolution is reduced if the glyphs would need an image of more than
// `largest_image` texels each way. Failed: neither font is installed.
core::Result<PanelFonts> load_panel_fonts(double texels_per_m, double millimetre_m, std::uint32_t largest_image);

}  // namespace afm::render
