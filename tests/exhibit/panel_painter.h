// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <vector>

#include "panels/panel_painting.h"

namespace afm::test {

inline constexpr std::uint32_t kLargestImage = 16384;

inline render::PanelFonts load_panel_fonts(double texels_per_m, double millimetre_m) {
  render::FontFiles files = render::read_panel_fonts().value();
  return render::draw_panel_fonts(files, texels_per_m, millimetre_m, kLargestImage).value();
}

struct ContextEnd {
  void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
};

// Measurements of a painted panel, in texels of a picture with two texels per pixel.
struct Painted {
  ImVec2 low{1e9F, 1e9F}, high{-1e9F, -1e9F};
  glm::vec2 size{0.0F};
  bool cut = false;              // true: a text ends in an ellipsis
  float state_height_px = 0.0F;  // height of the plate around the state's word
  float letter_px = 0.0F;        // mean height of its letters
  float least_em_m = 1.0F;       // em square of the smallest letter, on the wall
  float largest_em_m = 0.0F;
  float left_px = 1e9F, right_px = -1e9F;  // left and right end of all letters
  float bottom_px = -1e9F;                 // lowest end of all letters
  bool overlapping = false;                // true: a large letter overlaps a small one, if checked

  bool inside(float slack = 1.0F) const {
    return low.x >= -slack && low.y >= -slack && high.x <= size.x + slack && high.y <= size.y + slack;
  }
};

class Painter {
 public:
  Painter(double texels_per_m, double millimetre_m)
      : fonts_(load_panel_fonts(texels_per_m, millimetre_m)),
        millimetre_m_(millimetre_m),
        imgui_(ImGui::CreateContext(fonts_.atlas.get())) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts_.atlas->GetTexDataAsAlpha8(&pixels, &width, &height);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    for (const ImFont* font : fonts_.fonts) {
      for (const ImFontGlyph& glyph : font->Glyphs) {
        em_of_height_.try_emplace({glyph.U0, glyph.V0, glyph.U1, glyph.V1}, font->FontSize / (glyph.Y1 - glyph.Y0));
      }
    }
  }

  void look_for_overlaps(bool whether) { looks_for_overlaps_ = whether; }

  template <class Content>
  Painted paint(const Content& content, const render::PanelPlacement& placement, const glm::vec3& state_color = {}) {
    Painted painted;
    const glm::vec2 size_mm(glm::length(placement.right_m) / millimetre_m_,
                            glm::length(placement.up_m) / millimetre_m_);
    painted.size = size_mm * fonts_.texels_per_mm;
    ImGui::GetIO().DisplaySize = {painted.size.x, painted.size.y};
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    render::Canvas canvas(list, fonts_, memory_, size_mm);
    render::paint(canvas, content);
    float top = 1e9F, bottom = -1e9F;
    for (const ImDrawVert& vertex : list.VtxBuffer) {
      painted.low = {std::min(painted.low.x, vertex.pos.x), std::min(painted.low.y, vertex.pos.y)};
      painted.high = {std::max(painted.high.x, vertex.pos.x), std::max(painted.high.y, vertex.pos.y)};
      painted.cut = painted.cut || is_ellipsis(vertex.uv);
      const ImVec4 color = ImGui::ColorConvertU32ToFloat4(vertex.col);
      if (glm::distance(glm::vec3(color.x, color.y, color.z), state_color) > 0.01F) continue;
      top = std::min(top, vertex.pos.y);
      bottom = std::max(bottom, vertex.pos.y);
    }
    painted.state_height_px = 0.5F * (bottom - top);
    painted.letter_px = 0.5F * mean_letter(list);
    measure_letters(list, painted);
    ImGui::Render();
    return painted;
  }

 private:
  // Mean height of the letters, which are the rectangles that vary in both directions of the atlas.
  static float mean_letter(const ImDrawList& list) {
    float sum = 0.0F;
    int letters = 0;
    for (int i = 0; i + 3 < list.VtxBuffer.Size; ++i) {
      const ImDrawVert &a = list.VtxBuffer[i], &b = list.VtxBuffer[i + 1], &c = list.VtxBuffer[i + 2];
      if (a.uv.y != b.uv.y || a.uv.x == b.uv.x || b.uv.x != c.uv.x || b.uv.y == c.uv.y) continue;
      if (c.uv.x > 1.0F) continue;  // colour grid, whose places are texels
      sum += c.pos.y - a.pos.y;
      ++letters;
    }
    return letters > 0 ? sum / static_cast<float>(letters) : 0.0F;
  }

  // Measures the letters; each is recognised by its place in the atlas.
  void measure_letters(const ImDrawList& list, Painted& painted) const {
    const float texel_m = static_cast<float>(millimetre_m_) / fonts_.texels_per_mm;
    struct Letter {
      ImVec2 low, high;
      float em_m;
    };
    std::vector<Letter> letters;
    for (int i = 0; i + 3 < list.VtxBuffer.Size; ++i) {
      const ImDrawVert &from = list.VtxBuffer[i], &to = list.VtxBuffer[i + 2];
      const auto em = em_of_height_.find({from.uv.x, from.uv.y, to.uv.x, to.uv.y});
      if (em == em_of_height_.end()) continue;
      const float em_m = em->second * (to.pos.y - from.pos.y) * texel_m;
      painted.least_em_m = std::min(painted.least_em_m, em_m);
      painted.largest_em_m = std::max(painted.largest_em_m, em_m);
      painted.left_px = std::min(painted.left_px, from.pos.x);
      painted.right_px = std::max(painted.right_px, to.pos.x);
      painted.bottom_px = std::max(painted.bottom_px, to.pos.y);
      if (!looks_for_overlaps_) continue;
      for (const Letter& other : letters) {
        const bool apart = from.pos.x >= other.high.x || to.pos.x <= other.low.x || from.pos.y >= other.high.y ||
                           to.pos.y <= other.low.y;
        const float larger = std::max(em_m, other.em_m), smaller = std::min(em_m, other.em_m);
        painted.overlapping = painted.overlapping || (!apart && larger > 2.0F * smaller);
      }
      letters.push_back({from.pos, to.pos, em_m});
    }
  }

  bool is_ellipsis(const ImVec2& uv) const {
    constexpr ImWchar kEllipsis = 0x2026;
    return std::any_of(fonts_.fonts.begin(), fonts_.fonts.end(), [&](ImFont* font) {
      const ImFontGlyph* const glyph = font->FindGlyphNoFallback(kEllipsis);
      return glyph != nullptr && uv.x == glyph->U0 && uv.y == glyph->V0;
    });
  }

  render::PanelFonts fonts_;
  double millimetre_m_;
  bool looks_for_overlaps_ = false;
  std::unique_ptr<ImGuiContext, ContextEnd> imgui_;
  std::map<std::array<float, 4>, float> em_of_height_;  // em size of letters, by height and place in the atlas
  render::CanvasMemory memory_;
};

}  // namespace afm::test
