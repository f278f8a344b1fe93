// SPDX-License-Identifier: Apache-2.0
#include "panels/canvas.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

namespace afm::render {
namespace {

constexpr const char* kEllipsis = "\u2026";
constexpr float kPlateRounding = 22.0F;
constexpr float kSubscriptScale = 0.75F;
constexpr float kSubscriptDrop = 0.34F;  // fraction of the line's height

bool in_subscript(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80;
}

}  // namespace

Color shown(Color color, PanelContrast contrast) {
  constexpr float kStronger = 2.5F;  // factor for faint colours in high contrast
  if (contrast == PanelContrast::Normal) return color;
  const bool plate = color.srgb == palette::kPlate.srgb;
  if (contrast == PanelContrast::Opaque) return {color.srgb, plate ? 1.0F : color.alpha};
  if (plate) return {glm::vec3(0.0F), 1.0F};
  const auto neutral = {palette::kInk, palette::kMuted, palette::kEdge, palette::kAxis};
  const bool is_neutral =
      std::any_of(neutral.begin(), neutral.end(), [&](const Color& each) { return each.srgb == color.srgb; });
  return is_neutral ? Color{glm::vec3(1.0F), std::min(1.0F, kStronger * color.alpha)} : color;
}

Canvas::Canvas(ImDrawList& list, const PanelFonts& fonts, CanvasMemory& memory, glm::vec2 size_mm,
               PanelContrast contrast)
    : list_(list), fonts_(fonts), memory_(memory), size_mm_(size_mm), contrast_(contrast) {}

ImU32 Canvas::packed(Color color) const {
  const Color drawn = shown(color, contrast_);
  return ImGui::ColorConvertFloat4ToU32({drawn.srgb.r, drawn.srgb.g, drawn.srgb.b, drawn.alpha});
}

ImVec2 Canvas::texel(glm::vec2 mm) const { return {mm.x * fonts_.texels_per_mm, mm.y * fonts_.texels_per_mm}; }

void Canvas::panel_background(Color edge, float edge_width_mm) {
  const glm::vec2 inset(0.5F * edge_width_mm + 1.0F);
  rectangle(inset, size_mm_ - inset, palette::kPlate, kPlateRounding);
  outline(inset, size_mm_ - inset, edge_width_mm, edge, kPlateRounding);
}

// Draws or only measures one run of plain text; returns its width.
float Canvas::draw_text_run(glm::vec2 position, TextStyle style, float scale, Color color, std::string_view run,
                            bool visible) const {
  const ImFont* font = fonts_.fonts[static_cast<std::size_t>(style)];
  const float size = font->FontSize * scale;
  const char* const begin = run.data();
  const char* const end = begin + run.size();
  if (visible) {
    list_.AddText(font, size, texel(position), packed(color), begin, end);
  }
  return font->CalcTextSizeA(size, 1e9F, 0.0F, begin, end).x / fonts_.texels_per_mm;
}

float Canvas::text_pass(glm::vec2 position, TextStyle style, float scale, Color color, std::string_view text,
                        bool visible) const {
  const float drop = kSubscriptDrop * text_height_mm(style) * scale;
  const float start = position.x;
  while (!text.empty()) {
    const auto mark = std::min(text.find('_'), text.size());
    position.x += draw_text_run(position, style, scale, color, text.substr(0, mark), visible);
    text.remove_prefix(mark);
    if (text.empty()) {
      break;
    }
    text.remove_prefix(1);
    const auto end = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), in_subscript) - text.begin());
    position.x += draw_text_run(position + glm::vec2(0.0F, drop), style, scale * kSubscriptScale, color,
                                text.substr(0, end), visible);
    text.remove_prefix(end);
  }
  return position.x - start;
}

float Canvas::text_width_mm(TextStyle style, std::string_view text, float scale) const {
  return text_pass(glm::vec2(0.0F), style, scale, palette::kInk, text, false);
}

void Canvas::text(glm::vec2 position, TextStyle style, Color color, std::string_view text, Align align, float scale) {
  if (align != Align::Left) {
    position.x -= text_width_mm(style, text, scale) * (align == Align::Center ? 0.5F : 1.0F);
  }
  text_pass(position, style, scale, color, text, true);
}

void Canvas::fitted_text(glm::vec2 position, TextStyle style, Color color, std::string_view text, float width_mm,
                         float scale) {
  if (text_width_mm(style, text, scale) <= width_mm) {
    this->text(position, style, color, text, Align::Left, scale);
    return;
  }
  const float room = width_mm - text_width_mm(style, kEllipsis, scale);
  while (!text.empty() && text_width_mm(style, text, scale) > room) {
    // removes whole UTF-8 characters: continuation bytes together with their first byte
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) {
      text.remove_suffix(1);
    }
    text.remove_suffix(1);
  }
  this->text(position, style, color, text, Align::Left, scale);
  this->text(position + glm::vec2(text_width_mm(style, text, scale), 0.0F), style, color, kEllipsis, Align::Left,
             scale);
}

void Canvas::shrunk_text(glm::vec2 position, TextStyle style, Color color, std::string_view text, float width_mm) {
  const float scale = std::min(1.0F, width_mm / std::max(text_width_mm(style, text), 1.0F));
  const float lower = 0.5F * (1.0F - scale) * text_height_mm(style);
  this->text(position + glm::vec2(0.0F, lower), style, color, text, Align::Left, scale);
}

void Canvas::line(glm::vec2 from, glm::vec2 to, float width_mm, Color color) {
  list_.AddLine(texel(from), texel(to), packed(color), width_mm * fonts_.texels_per_mm);
}

// Draws a polyline. Breaks it at sharp turns, where Dear ImGui's mitres spike, and covers the joint with a disc.
void Canvas::polyline(std::span<const glm::vec2> points, float width_mm, Color color) {
  std::vector<ImVec2>& texels = memory_.texels;
  texels.clear();
  const float width = width_mm * fonts_.texels_per_mm;
  const auto flush = [&] {
    if (texels.size() > 1) {
      list_.AddPolyline(texels.data(), static_cast<int>(texels.size()), packed(color), ImDrawFlags_None, width);
    }
    texels.clear();
  };
  glm::vec2 direction(0.0F);
  glm::vec2 last(0.0F);
  for (const auto& point : points) {
    const bool first = texels.empty();
    const glm::vec2 step = point - last;
    const float length = first ? 0.0F : glm::length(step);
    if (!first && length < 0.05F) {
      continue;
    }
    if (texels.size() > 1 && glm::dot(direction, step / length) < 0.5F) {
      flush();
      list_.AddCircleFilled(texel(last), 0.5F * width, packed(color));
      texels.push_back(texel(last));
    }
    direction = first ? glm::vec2(0.0F) : step / length;
    texels.push_back(texel(point));
    last = point;
  }
  flush();
}

void Canvas::dashed_polyline(std::span<const glm::vec2> points, float width_mm, float dash_mm, float gap_mm,
                             Color color) {
  std::vector<glm::vec2>& dash = memory_.dash;
  dash.clear();
  float place = 0.0F;  // position within the period of dash and gap
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const float length = glm::distance(points[i], points[i + 1]);
    float done = 0.0F;
    while (done < length) {
      const bool drawn = place < dash_mm;
      const float step = std::min(length - done, (drawn ? dash_mm : dash_mm + gap_mm) - place);
      if (drawn && dash.empty()) {
        dash.push_back(glm::mix(points[i], points[i + 1], done / length));
      }
      done += step;
      place += std::max(step, 1e-4F);
      if (drawn) {
        dash.push_back(glm::mix(points[i], points[i + 1], std::min(done / length, 1.0F)));
      }
      if (drawn && place >= dash_mm) {
        polyline(dash, width_mm, color);
        dash.clear();
      }
      if (place >= dash_mm + gap_mm) {
        place = 0.0F;
      }
    }
  }
  polyline(dash, width_mm, color);
}

void Canvas::rectangle(glm::vec2 from, glm::vec2 to, Color color, float rounding_mm) {
  list_.AddRectFilled(texel(from), texel(to), packed(color), rounding_mm * fonts_.texels_per_mm);
}

void Canvas::outline(glm::vec2 from, glm::vec2 to, float width_mm, Color color, float rounding_mm) {
  list_.AddRect(texel(from), texel(to), packed(color), rounding_mm * fonts_.texels_per_mm, ImDrawFlags_None,
                width_mm * fonts_.texels_per_mm);
}

void Canvas::disc(glm::vec2 center, float radius_mm, Color color) {
  list_.AddCircleFilled(texel(center), radius_mm * fonts_.texels_per_mm, packed(color));
}

void Canvas::polygon(std::span<const glm::vec2> convex, Color color) {
  std::vector<ImVec2>& texels = memory_.texels;
  texels.clear();
  std::transform(convex.begin(), convex.end(), std::back_inserter(texels), [this](glm::vec2 p) { return texel(p); });
  list_.AddConvexPolyFilled(texels.data(), static_cast<int>(texels.size()), packed(color));
}

void Canvas::grid(glm::vec2 from, glm::vec2 to, const ColorGrid& grid) {
  if (grid.columns < 2 || grid.rows < 2) return;
  const GridSheet::Place place = memory_.grids.add(grid);
  list_.PushTextureID(&memory_.grids);
  list_.PrimReserve(6, 4);
  list_.PrimRectUV(texel(from), texel(to), {place.from.x, place.from.y}, {place.to.x, place.to.y}, place.digest);
  list_.PopTextureID();
}

void Canvas::push_clip(glm::vec2 from, glm::vec2 to) { list_.PushClipRect(texel(from), texel(to), true); }
void Canvas::pop_clip() { list_.PopClipRect(); }

}  // namespace afm::render
