// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "panels/font_finder.h"

namespace afm::render {

// Purpose of a text; determines its size on the wall.
// Figure has only the characters of numbers.
enum class TextStyle { Small, Body, Strong, Title, Guidance, Figure };
inline constexpr std::size_t kTextStyles = 6;

// Height of the em square, in the panels' millimetres.
float text_height_mm(TextStyle style);

// Glyphs of all styles, drawn once at the resolution of the panels' textures.
struct PanelFonts {
  std::unique_ptr<ImFontAtlas> atlas;
  std::array<ImFont*, kTextStyles> fonts{};
  float texels_per_mm = 1.0F;  // resolution of the panels
  float true_mm = 1.0F;        // length of a millimetre of the room, in the panels' millimetres
};

// Contents of the font files, in the order of FontFace; nothing for a font that another replaces.
using FontFiles = std::array<std::optional<std::string>, kFontFaces>;

// Reads Inter, and DejaVu Sans for missing glyphs or as a replacement: from the program's assets, from Debian's
// packages fonts-inter and fonts-dejavu-core, or from where fontconfig says, which may offer another font. Failed: no
// font is found.
core::Result<FontFiles> read_panel_fonts();

// Draws the glyphs, which takes longer than most of a program's start. Lengths as in RendererOptions; the resolution is
// reduced if the glyphs would need an image of more than `largest_image` texels each way. Failed: a file is no font.
core::Result<PanelFonts> draw_panel_fonts(FontFiles& files, double texels_per_m, double millimetre_m,
                                          std::uint32_t largest_image);

}  // namespace afm::render
