// SPDX-License-Identifier: Apache-2.0
#include "panels/panel_fonts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "core/whole_file.h"

namespace afm::render {
namespace {

struct StyleRow {
  float height_mm;
  const char* inter;
  const char* dejavu;
};

// Largest resolution, sufficient for 8192 pixels across the paper's wall.
constexpr float kMostTexelsPerMm = 5.4F;
constexpr float kCoarser = 0.75F;  // reduction step when the glyphs do not fit into an image

constexpr const char* kInterFolder = "/usr/share/fonts/opentype/inter/";
constexpr const char* kDejavuFolder = "/usr/share/fonts/truetype/dejavu/";

// Styles in the order of TextStyle, at least in medium weight: thin strokes are invisible from the back of a room.
constexpr std::array<StyleRow, kTextStyles> kStyles{{
    {30.0F, "Inter-Medium.otf", "DejaVuSans.ttf"},
    {40.0F, "Inter-Medium.otf", "DejaVuSans.ttf"},
    {44.0F, "Inter-SemiBold.otf", "DejaVuSans-Bold.ttf"},
    {60.0F, "Inter-SemiBold.otf", "DejaVuSans-Bold.ttf"},
    {72.0F, "Inter-SemiBold.otf", "DejaVuSans-Bold.ttf"},
}};

// Latin, Greek, Cyrillic capitals for the labels of keys, punctuation with the typographic minus and dashes, subscripts
// and superscripts, arrows, mathematical operators.
constexpr std::array<ImWchar, 19> kGlyphRanges{0x0020, 0x00FF, 0x0391, 0x03C9, 0x0401, 0x042F, 0x2010,
                                               0x2027, 0x2030, 0x2044, 0x2070, 0x209C, 0x2190, 0x2193,
                                               0x2200, 0x2265, 0x2266, 0x226B, 0};

// True for a file with an OpenType signature; ImGui ends the program for any other.
bool is_font(const std::string& bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("OTTO"sv) || bytes.starts_with("\0\1\0\0"sv);
}

// Never returns null, since ImGui does not check.
void* memory_or_throw(std::size_t size, void* /*unused*/) {
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
void give_back(void* place, void* /*unused*/) { std::free(place); }

core::Result<PanelFonts> draw_glyphs(float texels_per_mm, float true_mm) {
  PanelFonts result{.atlas = std::make_unique<ImFontAtlas>(), .texels_per_mm = texels_per_mm, .true_mm = true_mm};
  result.atlas->Flags |= ImFontAtlasFlags_NoMouseCursors;
  std::deque<std::string> files;  // read by the atlas when it is built
  for (std::size_t style = 0; style < kTextStyles; ++style) {
    const auto& row = kStyles[style];
    const float pixels = std::max(1.0F, std::round(row.height_mm * result.texels_per_mm));
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 1;
    for (const std::string& path : {std::string(kInterFolder) + row.inter, std::string(kDejavuFolder) + row.dejavu}) {
      auto bytes = core::read_file(path);
      if (bytes && is_font(*bytes)) {
        std::string& file = files.emplace_back(std::move(*bytes));
        config.FontDataOwnedByAtlas = false;
        ImFont* font = result.atlas->AddFontFromMemoryTTF(file.data(), static_cast<int>(file.size()), pixels, &config,
                                                          kGlyphRanges.data());
        result.fonts[style] = config.MergeMode ? result.fonts[style] : font;
        config.MergeMode = result.fonts[style] != nullptr;
      }
    }
    if (result.fonts[style] == nullptr) {
      return core::failure(core::ErrorCategory::Failed, std::string("cannot find a font for the panels (looked for ") +
                                                            kInterFolder + row.inter + " and " + kDejavuFolder +
                                                            row.dejavu + "): install fonts-inter or fonts-dejavu-core");
    }
  }
  if (!result.atlas->Build()) {
    return core::failure(core::ErrorCategory::Failed,
                         "cannot rasterise the panels' fonts: reinstall fonts-inter and fonts-dejavu-core");
  }
  return result;
}

}  // namespace

float text_height_mm(TextStyle style) { return kStyles[static_cast<std::size_t>(style)].height_mm; }

core::Result<PanelFonts> load_panel_fonts(double texels_per_m, double millimetre_m, std::uint32_t largest_image) {
  ImGui::SetAllocatorFunctions(memory_or_throw, give_back);
  const auto true_mm = static_cast<float>(1e-3 / millimetre_m);
  float texels_per_mm = std::min(static_cast<float>(texels_per_m * millimetre_m), kMostTexelsPerMm);
  auto fonts = draw_glyphs(texels_per_mm, true_mm);
  while (fonts && fonts->atlas->TexHeight > static_cast<int>(largest_image)) {
    texels_per_mm *= kCoarser;
    fonts = draw_glyphs(texels_per_mm, true_mm);
  }
  return fonts;
}

}  // namespace afm::render
