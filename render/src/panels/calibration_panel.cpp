// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "panels/panel_painting.h"

namespace afm::render {
namespace {

constexpr float kWallHeightMm = 2286.0F;  // the texts are sized for it; on other screens they scale with it
constexpr Color kGround{{0.10F, 0.10F, 0.11F}, 1.0F};
constexpr Color kFine{{0.30F, 0.32F, 0.35F}, 1.0F};
constexpr Color kCoarse{{0.52F, 0.55F, 0.60F}, 1.0F};
constexpr Color kWhite{{1.0F, 1.0F, 1.0F}, 1.0F};
constexpr Color kBlack{{0.0F, 0.0F, 0.0F}, 1.0F};

constexpr float kLeastIpdMm = 45.0F, kMostIpdMm = 80.0F;  // range for nearly all adults (Dodgson 2004)

constexpr Color kRamp{{0.20F, 0.78F, 0.58F}, 1.0F};

Color grey(float srgb) { return {glm::vec3(srgb), 1.0F}; }

// Draws lines `step` apart in both directions; two of them cross at `from`.
void paint_grid(Canvas& canvas, glm::vec2 from, float step, float width, Color color) {
  const glm::vec2 size = canvas.size_mm();
  const auto first = [&](float place) { return place - step * std::floor(place / step); };
  for (float x = first(from.x); x <= size.x; x += step) canvas.line({x, 0.0F}, {x, size.y}, width, color);
  for (float y = first(from.y); y <= size.y; y += step) canvas.line({0.0F, y}, {size.x, y}, width, color);
}

// Draws the borders of the blending ramps, with their widths.
void paint_ramps(Canvas& canvas, const CalibrationPanel& panel, float unit) {
  const glm::vec2 size = canvas.size_mm(), middle = 0.5F * size;
  const float thick = 4.0F * unit, gap = 16.0F * unit;
  for (std::size_t edge = 0; edge < panel.ramps.size(); ++edge) {
    const std::string& width = panel.ramp_widths.at(edge);
    if (width.empty()) continue;
    const scene::EdgeRamp& ramp = panel.ramps.at(edge);
    const glm::length_t axis = edge % 2 == 0 ? 0 : 1;
    const bool from_low = edge < 2;
    float at = 0.0F;
    for (const double inwards_m : {ramp.begin_m, ramp.begin_m + ramp.width_m}) {
      const float inwards = static_cast<float>(inwards_m * 1e3) * canvas.true_mm();
      at = from_low ? inwards : size[axis] - inwards;
      glm::vec2 begin(0.0F), end = size;
      begin[axis] = end[axis] = at;
      canvas.line(begin, end, thick, kRamp);
    }
    const Align align = axis == 1 ? Align::Center : from_low ? Align::Left : Align::Right;
    const float line_height = 50.0F * unit;
    const glm::vec2 place = axis == 0 ? glm::vec2(at + (from_low ? gap : -gap), 0.22F * size.y)
                                      : glm::vec2(middle.x, from_low ? at + gap : at - gap - line_height);
    canvas.text(place, TextStyle::Body, kRamp, width, align, unit);
  }
}

void paint_circle(Canvas& canvas, glm::vec2 center, float radius, float width, Color color) {
  constexpr std::size_t kCorners = 180;
  std::array<glm::vec2, kCorners + 1> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / kCorners;
    points[i] = center + radius * glm::vec2(std::cos(angle), std::sin(angle));
  }
  canvas.polyline(points, width, color);
}

// Draws a ruler at true scale that measures from the mark at its left end.
void paint_ruler(Canvas& canvas, glm::vec2 zero, float unit, double ipd_m) {
  const auto tick = [&](float mm, float height, Color color) {
    const float x = mm * canvas.true_mm();
    canvas.line(zero + glm::vec2(x, 0.0F), zero + glm::vec2(x, -height * unit), 1.5F * unit, color);
  };
  canvas.line(zero, zero + glm::vec2(kMostIpdMm * canvas.true_mm(), 0.0F), 1.5F * unit, kWhite);
  tick(0.0F, 60.0F, kWhite);
  for (float mm = kLeastIpdMm; mm <= kMostIpdMm; mm += 5.0F)
    tick(mm, std::fmod(mm, 10.0F) == 0.0F ? 50.0F : 30.0F, kWhite);
  tick(static_cast<float>(ipd_m * 1e3), 80.0F, palette::kOrange);
}

// Draws grey steps from black to white in encoded values, and black and white stripes next to the grey with half of
// white's luminance.
void paint_greys(Canvas& canvas, glm::vec2 at, float unit) {
  const glm::vec2 patch(70.0F * unit);
  constexpr int kSteps = 11;
  for (int i = 0; i < kSteps; ++i) {
    const glm::vec2 from = at + glm::vec2(patch.x * static_cast<float>(i), 0.0F);
    canvas.rectangle(from, from + patch, grey(static_cast<float>(i) / (kSteps - 1)));
  }
  const glm::vec2 stripes = at + glm::vec2(patch.x * (kSteps + 1), 0.0F);
  canvas.rectangle(stripes, stripes + patch, kBlack);
  constexpr int kPairs = 7;
  const float pitch = patch.y / kPairs;
  for (int i = 0; i < kPairs; ++i) {
    const float y = pitch * static_cast<float>(i);
    canvas.rectangle(stripes + glm::vec2(0.0F, y), stripes + glm::vec2(patch.x, y + 0.5F * pitch), kWhite);
  }
  canvas.rectangle(stripes + glm::vec2(patch.x, 0.0F), stripes + glm::vec2(2.0F * patch.x, patch.y),
                   grey(188.0F / 255.0F));
}

}  // namespace

void paint(Canvas& canvas, const CalibrationPanel& panel) {
  const glm::vec2 size = canvas.size_mm(), middle = 0.5F * size;
  const float unit = size.y / kWallHeightMm;
  const float step = static_cast<float>(panel.square_m * 1e3) * canvas.true_mm();
  canvas.rectangle({0.0F, 0.0F}, size, kGround);
  const glm::vec2 crossing = middle + glm::vec2(panel.grid_from_m * 1e3) * canvas.true_mm();
  paint_grid(canvas, crossing, step, 1.5F * unit, kFine);
  paint_grid(canvas, crossing, 10.0F * step, 3.0F * unit, kCoarse);
  paint_ramps(canvas, panel, unit);
  canvas.outline(glm::vec2(2.0F * unit), size - 2.0F * unit, 4.0F * unit, kWhite);
  paint_circle(canvas, middle, 0.44F * std::min(size.x, size.y), 4.0F * unit, palette::kSkyBlue);
  canvas.line({middle.x - 300.0F * unit, middle.y}, {middle.x + 300.0F * unit, middle.y}, 5.0F * unit,
              palette::kYellow);
  canvas.line({middle.x, middle.y - 300.0F * unit}, {middle.x, middle.y + 300.0F * unit}, 5.0F * unit,
              palette::kYellow);

  const auto line = [&](float y, TextStyle style, std::string_view text) {
    const float scale = std::min(unit, 0.96F * size.x / std::max(canvas.text_width_mm(style, text), 1.0F));
    canvas.text({middle.x, y * unit}, style, kWhite, text, Align::Center, scale);
  };
  line(220.0F, TextStyle::Title, panel.size);
  line(320.0F, TextStyle::Strong, panel.mode);
  line(390.0F, TextStyle::Body, panel.legend);
  paint_ruler(canvas, {middle.x - 0.5F * kMostIpdMm * canvas.true_mm(), 1840.0F * unit}, unit, panel.ipd_m);
  line(1860.0F, TextStyle::Body, panel.ruler);
  paint_greys(canvas, {middle.x - 490.0F * unit, 1950.0F * unit}, unit);
}

void paint(Canvas& canvas, const EyeMark& mark) {
  const glm::vec2 size = canvas.size_mm();
  const float width = 0.16F * std::min(size.x, size.y);
  const auto at = [&](float x, float y) { return glm::vec2(x, y) * (size - width) + 0.5F * width; };
  if (mark.eye == scene::Eye::Left) {
    const std::array stroke{at(0.1F, 0.0F), at(0.1F, 1.0F), at(0.9F, 1.0F)};
    canvas.polyline(stroke, width, kWhite);
    return;
  }
  const std::array stroke{at(0.1F, 1.0F),  at(0.1F, 0.0F),   at(0.6F, 0.0F),  at(0.85F, 0.1F),
                          at(0.9F, 0.27F), at(0.85F, 0.44F), at(0.6F, 0.55F), at(0.1F, 0.55F)};
  canvas.polyline(stroke, width, kWhite);
  canvas.line(at(0.5F, 0.55F), at(0.9F, 1.0F), width, kWhite);
}

}  // namespace afm::render
