// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "panels/grid_sheet.h"
#include "panels/marker_layout.h"
#include "panels/panel_fonts.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::render {

struct Color {
  glm::vec3 srgb{1.0F};
  float alpha = 1.0F;
};

// Colours of the panels: light ink on a dark background, and the palette of Okabe and Ito, whose colours differ
// with any kind of colour vision.
namespace palette {
inline constexpr Color kPlate{{0.055F, 0.066F, 0.090F}, 0.90F};
inline constexpr Color kEdge{{0.62F, 0.70F, 0.80F}, 0.30F};
inline constexpr Color kInk{{0.95F, 0.96F, 0.97F}, 1.0F};
inline constexpr Color kMuted{{0.68F, 0.73F, 0.79F}, 1.0F};
inline constexpr Color kGrid{{0.70F, 0.78F, 0.88F}, 0.14F};
inline constexpr Color kAxis{{0.78F, 0.83F, 0.89F}, 0.75F};
inline constexpr Color kOrange{{0.902F, 0.624F, 0.0F}, 1.0F};
inline constexpr Color kSkyBlue{{0.337F, 0.706F, 0.914F}, 1.0F};
inline constexpr Color kYellow{{0.941F, 0.894F, 0.259F}, 1.0F};
}  // namespace palette

// Colour as drawn. In high contrast the plate is black, and ink, edges and axes are white; colours that distinguish
// curves, states and values stay.
Color shown(Color color, PanelContrast contrast);

enum class Align { Left, Center, Right };

// Scratch memory, kept so that repainting allocates nothing, and the grids of all paintings since its clear().
struct CanvasMemory {
  GridSheet grids;
  std::vector<ImVec2> texels;
  std::vector<glm::vec2> points, dash;
  std::vector<MarkerLabel> labels;
  std::vector<LabelBox> boxes;
};

// Draws in millimetres from the panel's top left corner, x to the right and y down. Hides Dear ImGui's draw list.
class Canvas {
 public:
  Canvas(ImDrawList& list, const PanelFonts& fonts, CanvasMemory& memory, glm::vec2 size_mm,
         PanelContrast contrast = PanelContrast::Normal);

  glm::vec2 size_mm() const { return size_mm_; }

  // Length of a millimetre of the room, in the panels' millimetres, which are used everywhere else here.
  float true_mm() const { return fonts_.true_mm; }

  // Approximate number of an eye image's pixels per millimetre: textures have twice this resolution.
  float pixels_per_mm() const { return 0.5F * fonts_.texels_per_mm; }

  // Draws the panel's plate with its rounded edge.
  void panel_background(Color edge = palette::kEdge, float edge_width_mm = 2.0F);

  // Draws a line of text. `position` is at the top of the line, at its left end, middle or right end. An underscore
  // starts a subscript that ends before the next character other than a letter or digit: "Z_jtc". `scale` reduces the
  // style's size.
  void text(glm::vec2 position, TextStyle style, Color color, std::string_view text, Align align = Align::Left,
            float scale = 1.0F);
  float text_width_mm(TextStyle style, std::string_view text, float scale = 1.0F) const;

  // Draws left-aligned text, cut with an ellipsis if it would be wider than `width_mm`.
  void fitted_text(glm::vec2 position, TextStyle style, Color color, std::string_view text, float width_mm,
                   float scale = 1.0F);

  // Draws left-aligned text, reduced if it would be wider, and vertically centred on its line.
  void shrunk_text(glm::vec2 position, TextStyle style, Color color, std::string_view text, float width_mm);

  // Scratch memory for the caller, which keeps nothing from one call to the next. No function of this class uses
  // `points` and `labels`.
  CanvasMemory& memory() { return memory_; }

  void line(glm::vec2 from, glm::vec2 to, float width_mm, Color color);
  void polyline(std::span<const glm::vec2> points, float width_mm, Color color);
  void dashed_polyline(std::span<const glm::vec2> points, float width_mm, float dash_mm, float gap_mm, Color color);
  void rectangle(glm::vec2 from, glm::vec2 to, Color color, float rounding_mm = 0.0F);
  void outline(glm::vec2 from, glm::vec2 to, float width_mm, Color color, float rounding_mm = 0.0F);
  void disc(glm::vec2 center, float radius_mm, Color color);
  void polygon(std::span<const glm::vec2> convex, Color color);

  // Draws the grid's colours, one at the centre of each cell and blended in between; the outer half cells are constant.
  // The shape's texture is CanvasMemory::grids, its places are texels there, and its colour is the grid's digest.
  void grid(glm::vec2 from, glm::vec2 to, const ColorGrid& grid);

  // Draws nothing outside the rectangle until pop_clip().
  void push_clip(glm::vec2 from, glm::vec2 to);
  void pop_clip();

 private:
  ImVec2 texel(glm::vec2 mm) const;
  ImU32 packed(Color color) const;
  float draw_text_run(glm::vec2 position, TextStyle style, float scale, Color color, std::string_view run,
                      bool visible) const;
  float text_pass(glm::vec2 position, TextStyle style, float scale, Color color, std::string_view text,
                  bool visible) const;

  ImDrawList& list_;
  const PanelFonts& fonts_;
  CanvasMemory& memory_;
  glm::vec2 size_mm_;
  PanelContrast contrast_;
};

}  // namespace afm::render
