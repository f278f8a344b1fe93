// SPDX-License-Identifier: Apache-2.0
#include "panels/title_text.h"

#include <algorithm>
#include <array>

namespace afm::render {
namespace {

constexpr float kHalfSize = 0.6F;    // size of letters on two lines, relative to the style
constexpr float kHalfPitch = 0.54F;  // distance of the two lines, relative to the style's height
constexpr float kRise = 0.06F;       // rise of the two lines above the place of one, relative to the style's height

// Factor that fits a line of text into `room_mm`.
float fit_to(const Canvas& canvas, TextStyle style, std::string_view text, float room_mm, float scale) {
  return std::min(1.0F, room_mm / std::max(canvas.text_width_mm(style, text, scale), 1.0F));
}

// Splits text at the space with the shortest resulting lines; the second is empty if there is no space.
std::array<std::string_view, 2> halves_of(const Canvas& canvas, TextStyle style, std::string_view text) {
  std::array<std::string_view, 2> best{text, {}};
  float least = canvas.text_width_mm(style, text);
  for (std::size_t at = text.find(' '); at != std::string_view::npos; at = text.find(' ', at + 1)) {
    const std::array halves{text.substr(0, at), text.substr(at + 1)};
    const float wider = std::max(canvas.text_width_mm(style, halves[0]), canvas.text_width_mm(style, halves[1]));
    if (wider < least) best = halves;
    least = std::min(least, wider);
  }
  return best;
}

}  // namespace

void shrunk_text(Canvas& canvas, glm::vec2 position, const Ink& ink, std::string_view text, float room_mm,
                 float scale) {
  const float fit = fit_to(canvas, ink.style, text, room_mm, scale);
  if (fit < ink.smallest) return canvas.fitted_text(position, ink.style, ink.color, text, room_mm, scale);
  const float lift = 0.5F * scale * (1.0F - fit) * text_height_mm(ink.style);
  canvas.text(position + glm::vec2(0.0F, lift), ink.style, ink.color, text, Align::Left, fit * scale);
}

void paint_title(Canvas& canvas, glm::vec2 position, std::string_view title, float room_mm, float scale) {
  constexpr Ink kInk{TextStyle::Title, palette::kInk};
  const std::array halves = halves_of(canvas, kInk.style, title);
  const bool one_fits = fit_to(canvas, kInk.style, title, room_mm, scale) >= kHalfSize;
  const bool two_fit = !halves[1].empty() && std::ranges::all_of(halves, [&](std::string_view half) {
    return fit_to(canvas, kInk.style, half, room_mm, kHalfSize * scale) >= kInk.smallest;
  });
  if (one_fits || !two_fit) return shrunk_text(canvas, position, kInk, title, room_mm, scale);
  const float em = scale * text_height_mm(kInk.style);
  position.y -= kRise * em;
  for (const std::string_view half : halves) {
    shrunk_text(canvas, position, kInk, half, room_mm, kHalfSize * scale);
    position.y += kHalfPitch * em;
  }
}

}  // namespace afm::render
