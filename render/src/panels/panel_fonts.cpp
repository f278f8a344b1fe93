// SPDX-License-Identifier: Apache-2.0
#include "panels/panel_fonts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

#include "core/enumerators.h"
#include "core/system_packages.h"

namespace afm::render {
namespace {

struct StyleRow {
  TextStyle style;
  float height_mm;
  FontFace first;
  FontFace second;  // source of glyphs that the first lacks, or its replacement
  bool only_numbers = false;
};

// Largest resolution, sufficient for 8192 pixels across the paper's wall.
constexpr float kMostTexelsPerMm = 5.4F;
constexpr float kCoarser = 0.75F;  // reduction step when the glyphs do not fit into an image

// Styles, at least in medium weight: thin strokes are invisible from the back of a room.
constexpr std::array<StyleRow, kTextStyles> kStyles{{
    {TextStyle::Small, 30.0F, FontFace::InterMedium, FontFace::DejaVu},
    {TextStyle::Body, 40.0F, FontFace::InterMedium, FontFace::DejaVu},
    {TextStyle::Strong, 44.0F, FontFace::InterSemiBold, FontFace::DejaVuBold},
    {TextStyle::Title, 60.0F, FontFace::InterSemiBold, FontFace::DejaVuBold},
    {TextStyle::Guidance, 72.0F, FontFace::InterSemiBold, FontFace::DejaVuBold},
    {TextStyle::Figure, 194.0F, FontFace::InterSemiBold, FontFace::DejaVuBold, true},
}};
static_assert(core::has_row_for_each(kStyles, &StyleRow::style));

// Latin, Greek, Cyrillic capitals for the labels of keys, punctuation with the typographic minus and dashes, subscripts
// and superscripts, arrows, mathematical operators.
constexpr std::array<ImWchar, 19> kGlyphRanges{0x0020, 0x00FF, 0x0391, 0x03C9, 0x0401, 0x042F, 0x2010,
                                               0x2027, 0x2030, 0x2044, 0x2070, 0x209C, 0x2190, 0x2193,
                                               0x2200, 0x2265, 0x2266, 0x226B, 0};

// Plus, comma, hyphen, point, digits and the typographic minus.
constexpr std::array<ImWchar, 7> kNumberRanges{0x002B, 0x002E, 0x0030, 0x0039, 0x2212, 0x2212, 0};

// Allocates memory or throws, since ImGui does not check for null.
void* memory_or_throw(std::size_t size, void* /*unused*/) {
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
void give_back(void* place, void* /*unused*/) { std::free(place); }

std::optional<std::string>& bytes_of(FontFiles& fonts, FontFace face) { return fonts[static_cast<std::size_t>(face)]; }

core::Result<PanelFonts> draw_glyphs(FontFiles& bytes, float texels_per_mm, float true_mm) {
  PanelFonts result{.atlas = std::make_unique<ImFontAtlas>(), .texels_per_mm = texels_per_mm, .true_mm = true_mm};
  result.atlas->Flags |= ImFontAtlasFlags_NoMouseCursors;
  for (std::size_t style = 0; style < kTextStyles; ++style) {
    const auto& row = kStyles[style];
    const float pixels = std::max(1.0F, std::round(row.height_mm * result.texels_per_mm));
    ImFontConfig config;
    config.OversampleH = row.only_numbers ? 1 : 2;
    config.OversampleV = 1;
    for (const FontFace face : {row.first, row.second}) {
      auto& file = bytes_of(bytes, face);
      if (!file) continue;
      config.FontDataOwnedByAtlas = false;
      ImFont* font = result.atlas->AddFontFromMemoryTTF(file->data(), static_cast<int>(file->size()), pixels, &config,
                                                        row.only_numbers ? kNumberRanges.data() : kGlyphRanges.data());
      result.fonts[style] = config.MergeMode ? result.fonts[style] : font;
      config.MergeMode = result.fonts[style] != nullptr;
    }
  }
  if (!result.atlas->Build()) {
    return core::failure(core::ErrorCategory::Failed,
                         "cannot rasterise the panels' fonts: reinstall Inter and DejaVu Sans");
  }
  return result;
}

}  // namespace

float text_height_mm(TextStyle style) { return kStyles[static_cast<std::size_t>(style)].height_mm; }

core::Result<FontFiles> read_panel_fonts() {
  FontFinder finder(font_folders());
  FontFiles fonts;
  for (const StyleRow& style : kStyles) {
    for (const FontFace face : {style.first, style.second}) {
      auto& bytes = bytes_of(fonts, face);
      if (!bytes) bytes = finder.read(face);
    }
    auto& second = bytes_of(fonts, style.second);
    if (!second && !bytes_of(fonts, style.first)) second = finder.read_similar(style.second);
    if (second || bytes_of(fonts, style.first)) continue;
    std::string folders;
    for (const std::string& folder : font_folders()) folders += folder + ", ";
    return core::failure(core::ErrorCategory::Failed,
                         "cannot find a font for the panels (looked for Inter and DejaVu Sans in " + folders +
                             "and asked fontconfig): " +
                             core::install_command(core::package_system_of(core::read_os_release()),
                                                   std::array{core::SystemPart::Fonts}));
  }
  return fonts;
}

core::Result<PanelFonts> draw_panel_fonts(FontFiles& files, double texels_per_m, double millimetre_m,
                                          std::uint32_t largest_image) {
  ImGui::SetAllocatorFunctions(memory_or_throw, give_back);
  const auto true_mm = static_cast<float>(1e-3 / millimetre_m);
  float texels_per_mm = std::min(static_cast<float>(texels_per_m * millimetre_m), kMostTexelsPerMm);
  auto fonts = draw_glyphs(files, texels_per_mm, true_mm);
  while (fonts && fonts->atlas->TexHeight > static_cast<int>(largest_image)) {
    texels_per_mm *= kCoarser;
    fonts = draw_glyphs(files, texels_per_mm, true_mm);
  }
  return fonts;
}

}  // namespace afm::render
