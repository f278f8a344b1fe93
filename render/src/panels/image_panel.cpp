// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "panels/panel_painting.h"
#include "panels/plot_scale.h"
#include "panels/title_text.h"

namespace afm::render {
namespace {

constexpr float kImageTop = 146.0F;  // top of the images, below title and subtitle
constexpr float kBetween = 26.0F;
constexpr float kImageCaption = 44.0F;  // height of a caption above a picture
constexpr float kImageTicks = 60.0F;    // height of the ticks below trace and retrace
constexpr float kColorBar = 92.0F;      // height of the colour bar with its numbers
constexpr float kColorBarHeight = 30.0F;
constexpr float kImageFoot = 26.0F;
constexpr float kSmallShare = 0.62F;  // preferred side of a small picture, relative to a large one
constexpr float kTickLength = 8.0F;

constexpr Color kUnderScaleBar{{0.0F, 0.0F, 0.0F}, 0.55F};
constexpr Color kUnmeasured{{0.10F, 0.12F, 0.16F}, 1.0F};

struct Square {
  glm::vec2 from{0.0F};
  float side = 0.0F;

  glm::vec2 to() const { return from + glm::vec2(side); }
};

// Squares of a panel: the two large ones side by side; the small pictures and the profile in a row below them or in a
// column on the right, whichever leaves the large ones larger.
struct Layout {
  std::array<Square, 2> heights;
  std::array<Square, 3> smaller;  // error, lateral force, profile
  glm::vec2 bar_from{0.0F}, bar_to{0.0F};
};

Layout column_layout(glm::vec2 size, float labels) {
  const float width = size.x - 2.0F * kMargin - labels, height = size.y - kImageTop - kImageFoot;
  const float small = std::min((height - 3.0F * kImageCaption - 2.0F * 8.0F) / 3.0F, 0.28F * width);
  const float large =
      std::min((width - small - 2.0F * kBetween) / 2.0F, height - kImageCaption - kImageTicks - kColorBar);
  Layout layout;
  const float spare = width - 2.0F * large - small - 2.0F * kBetween;
  const float left = kMargin + labels + 0.25F * spare;
  // spare height goes above the bar, which then lies at the bottom of the panel
  const float top =
      kImageTop + kImageCaption + 0.35F * std::max(0.0F, height - kImageCaption - kImageTicks - kColorBar - large);
  layout.heights = {Square{{left, top}, large}, Square{{left + large + kBetween, top}, large}};
  const float right = size.x - kMargin - small;
  const float pitch = (height + 8.0F) / 3.0F;
  for (std::size_t i = 0; i < layout.smaller.size(); ++i) {
    layout.smaller[i] = {{right, kImageTop + kImageCaption + static_cast<float>(i) * pitch}, small};
  }
  layout.bar_from = {left, top + large + kImageTicks};
  layout.bar_to = {left + 2.0F * large + kBetween, layout.bar_from.y + kColorBarHeight};
  return layout;
}

Layout row_layout(glm::vec2 size, float labels) {
  const float width = size.x - 2.0F * kMargin - labels, height = size.y - kImageTop - kImageFoot;
  const float by_height = (height - 2.0F * kImageCaption - kImageTicks - kColorBar) / (1.0F + kSmallShare);
  const float large = std::min((width - kBetween) / 2.0F, by_height);
  const float small = std::min((width + labels - 2.0F * kBetween) / 3.0F,
                               height - 2.0F * kImageCaption - kImageTicks - kColorBar - large);
  Layout layout;
  const float left = kMargin + labels + 0.5F * (width - 2.0F * large - kBetween), top = kImageTop + kImageCaption;
  layout.heights = {Square{{left, top}, large}, Square{{left + large + kBetween, top}, large}};
  layout.bar_from = {left, top + large + kImageTicks};
  layout.bar_to = {left + 2.0F * large + kBetween, layout.bar_from.y + kColorBarHeight};
  const float row = layout.bar_from.y + kColorBar + kImageCaption;
  const float apart = (size.x - 2.0F * kMargin - 3.0F * small) / 2.0F;
  for (std::size_t i = 0; i < layout.smaller.size(); ++i) {
    layout.smaller[i] = {{kMargin + static_cast<float>(i) * (small + apart), row}, small};
  }
  return layout;
}

Layout layout_of(glm::vec2 size, float labels) {
  const Layout column = column_layout(size, labels), row = row_layout(size, labels);
  return column.heights[0].side > row.heights[0].side ? column : row;
}

// Draws the picture with its caption above it, on a plate that shows through unmeasured areas.
void paint_map(Canvas& canvas, const ImageMap& map, const Square& at, TextStyle style) {
  canvas.shrunk_text(at.from - glm::vec2(0.0F, kImageCaption - 2.0F), style, palette::kInk, map.title, at.side);
  canvas.rectangle(at.from, at.to(), kUnmeasured);
  canvas.push_clip(at.from, at.to());
  canvas.grid(at.from, at.to(), map.grid);
  canvas.pop_clip();
  canvas.outline(at.from, at.to(), 2.0F, palette::kAxis);
}

// Round tick distance along the area, with as many ticks as there is room for numbers.
double tick_of(const Canvas& canvas, const ImagePanel& panel, float side_mm) {
  int most = 5;
  double step = tick_step(panel.side, most);
  while (most > 1) {
    const std::string widest = tick_text(panel.side, step, panel.decimal_mark);
    const double apart_mm = step / panel.side * static_cast<double>(side_mm);
    if (static_cast<double>(canvas.text_width_mm(TextStyle::Small, widest)) + 14.0 < apart_mm) break;
    step = tick_step(panel.side, --most);
  }
  return step;
}

void paint_axes(Canvas& canvas, const ImagePanel& panel, const Layout& layout) {
  const Square& trace = layout.heights[0];
  const double step = tick_of(canvas, panel, trace.side);
  const float per_unit = trace.side / static_cast<float>(panel.side);
  const float em = text_height_mm(TextStyle::Small);
  for (int i = 0; static_cast<double>(i) * step <= panel.side * (1.0 + 1e-9); ++i) {
    const double at_unit = static_cast<double>(i) * step;
    const std::string number = tick_text(at_unit, step, panel.decimal_mark);
    const float along = static_cast<float>(at_unit) * per_unit;
    for (const Square& height : layout.heights) {
      const glm::vec2 foot(height.from.x + along, height.to().y);
      canvas.line(foot, foot + glm::vec2(0.0F, kTickLength), 2.5F, palette::kAxis);
      canvas.text(foot + glm::vec2(0.0F, kTickLength + 2.0F), TextStyle::Small, palette::kMuted, number,
                  i == 0 ? Align::Left : Align::Center);
    }
    const glm::vec2 side(trace.from.x, trace.to().y - along);
    canvas.line(side, side - glm::vec2(kTickLength, 0.0F), 2.5F, palette::kAxis);
    if (i > 0) {
      canvas.text(side - glm::vec2(kTickLength + 6.0F, 0.5F * em), TextStyle::Small, palette::kMuted, number,
                  Align::Right);
    }
  }
  canvas.text({trace.from.x - kTickLength - 6.0F, trace.to().y - em}, TextStyle::Small, palette::kMuted,
              panel.side_unit, Align::Right);
}

// Draws the scale bar in the picture's lower right corner, on a plate that makes it visible on every colour.
void paint_scale_bar(Canvas& canvas, const ImagePanel& panel, const Square& at) {
  const float length = static_cast<float>(panel.scale_bar / panel.side) * at.side;
  const std::string text = fmt::format("{:g} {}", panel.scale_bar, panel.side_unit);
  const float em = text_height_mm(TextStyle::Small);
  const float scale = std::min(1.0F, 0.42F * at.side / canvas.text_width_mm(TextStyle::Small, text));
  const float width = std::max(length, canvas.text_width_mm(TextStyle::Small, text, scale)) + 20.0F;
  const glm::vec2 to = at.to() - glm::vec2(10.0F), from = to - glm::vec2(width, scale * em + 26.0F);
  canvas.rectangle(from, to, kUnderScaleBar, 8.0F);
  const float middle = 0.5F * (from.x + to.x);
  canvas.text({middle, from.y + 3.0F}, TextStyle::Small, palette::kInk, text, Align::Center, scale);
  canvas.rectangle({middle - 0.5F * length, to.y - 16.0F}, {middle + 0.5F * length, to.y - 8.0F}, palette::kInk);
}

// Marks the scan line of the tip at both edges, with a thin line in between.
void paint_line(Canvas& canvas, double line, const Square& at) {
  const float y = at.from.y + static_cast<float>(std::clamp(line, 0.0, 1.0)) * at.side;
  canvas.line({at.from.x, y}, {at.to().x, y}, 2.5F, palette::kYellow);
  for (const float sign : {-1.0F, 1.0F}) {
    const float edge = sign < 0.0F ? at.from.x : at.to().x;
    const std::array<glm::vec2, 3> mark{glm::vec2(edge - sign * 12.0F, y), glm::vec2(edge + sign * 2.0F, y - 9.0F),
                                        glm::vec2(edge + sign * 2.0F, y + 9.0F)};
    canvas.polygon(mark, palette::kYellow);
  }
}

void paint_bar(Canvas& canvas, const ImagePanel& panel, const Layout& layout) {
  const std::size_t count = panel.bar.size();
  if (count < 2) return;
  const glm::vec2 from = layout.bar_from, to = layout.bar_to;
  const float width = to.x - from.x;
  ColorGrid grid{.columns = static_cast<std::uint32_t>(count), .rows = 2, .colors = {}};
  for (int row = 0; row < 2; ++row) {
    for (const glm::vec3& c : panel.bar) {
      const auto byte = [](float share) { return static_cast<std::uint8_t>(std::lround(255.0F * share)); };
      grid.colors.push_back({byte(c.r), byte(c.g), byte(c.b), 255});
    }
  }
  canvas.grid(from, to, grid);
  canvas.outline(from, to, 2.0F, palette::kAxis);
  const double range = panel.bar_high_nm - panel.bar_low_nm;
  if (!(range > 0.0)) return;
  const double step = tick_step(range, 4);
  const float end = to.x - canvas.text_width_mm(TextStyle::Small, "nm") - 14.0F;
  for (double z = std::ceil(panel.bar_low_nm / step - 1e-9) * step; z <= panel.bar_high_nm + 1e-9 * step; z += step) {
    const float x = from.x + static_cast<float>((z - panel.bar_low_nm) / range) * width;
    const std::string number = tick_text(z, step, panel.decimal_mark);
    const float half = 0.5F * canvas.text_width_mm(TextStyle::Small, number);
    canvas.line({x, to.y}, {x, to.y + kTickLength}, 2.5F, palette::kAxis);
    const float middle = std::clamp(x, from.x + half, to.x - half);
    if (middle + half > end) continue;  // room reserved for the unit
    canvas.text({middle, to.y + kTickLength}, TextStyle::Small, palette::kMuted, number, Align::Center);
  }
  canvas.text({to.x, to.y + kTickLength}, TextStyle::Small, palette::kMuted, "nm", Align::Right);
}

void paint_profile(Canvas& canvas, const ProfilePlot& plot, const Square& at) {
  canvas.shrunk_text(at.from - glm::vec2(0.0F, kImageCaption - 2.0F), TextStyle::Small, palette::kInk, plot.title,
                     at.side);
  canvas.rectangle(at.from, at.to(), kUnmeasured);
  canvas.outline(at.from, at.to(), 2.0F, palette::kAxis);
  const glm::dvec2 range = plot.high - plot.low;
  if (!(range.x > 0.0) || !(range.y > 0.0)) return;
  constexpr float kInset = 8.0F;
  canvas.push_clip(at.from, at.to());
  for (const ProfilePlot::Line& line : plot.lines) {
    std::vector<glm::vec2>& places = canvas.memory().points;
    places.clear();
    for (const glm::vec2& point : line.points) {
      const glm::vec2 share((glm::dvec2(point) - plot.low) / range);
      places.push_back(at.from + glm::vec2(kInset) + glm::vec2(share.x, 1.0F - share.y) * (at.side - 2.0F * kInset));
    }
    const Color color{line.color, 1.0F};
    if (line.dashed) {
      canvas.dashed_polyline(places, 4.0F, 12.0F, 8.0F, color);
    } else {
      canvas.polyline(places, 5.0F, color);
    }
  }
  canvas.pop_clip();
  float x = at.from.x + 8.0F;
  const float em = text_height_mm(TextStyle::Small);
  float whole = 0.0F;
  for (const ProfilePlot::Line& line : plot.lines) {
    whole += 42.0F + canvas.text_width_mm(TextStyle::Small, line.label) + 12.0F;
  }
  const float scale = std::min(0.85F, (at.side - 16.0F) / std::max(whole, 1.0F));
  const float y = at.from.y + 6.0F + 0.5F * em;
  for (const ProfilePlot::Line& line : plot.lines) {
    const std::array<glm::vec2, 2> stroke{glm::vec2(x, y), glm::vec2(x + scale * 34.0F, y)};
    if (line.dashed) {
      canvas.dashed_polyline(stroke, 4.0F, 12.0F, 8.0F, {line.color, 1.0F});
    } else {
      canvas.polyline(stroke, 5.0F, {line.color, 1.0F});
    }
    canvas.text({x + scale * 42.0F, y - 0.5F * scale * em}, TextStyle::Small, palette::kInk, line.label, Align::Left,
                scale);
    x += scale * (54.0F + canvas.text_width_mm(TextStyle::Small, line.label));
  }
}

}  // namespace

void paint(Canvas& canvas, const ImagePanel& panel) {
  canvas.panel_background();
  const float width = canvas.size_mm().x - 2.0F * kMargin;
  paint_title(canvas, {kMargin, 24.0F}, panel.title, width);
  canvas.shrunk_text({kMargin, 92.0F}, TextStyle::Body, palette::kYellow, panel.subtitle, width);
  const double step = tick_step(panel.side, 5);
  const float labels =
      canvas.text_width_mm(TextStyle::Small, tick_text(panel.side, step, panel.decimal_mark)) + kTickLength + 8.0F;
  const Layout layout = layout_of(canvas.size_mm(), labels);
  for (std::size_t i = 0; i < panel.heights.size(); ++i) {
    paint_map(canvas, panel.heights[i], layout.heights[i], TextStyle::Body);
    if (panel.line) paint_line(canvas, *panel.line, layout.heights[i]);
  }
  paint_axes(canvas, panel, layout);
  paint_scale_bar(canvas, panel, layout.heights[0]);
  paint_bar(canvas, panel, layout);
  for (std::size_t i = 0; i < std::min(panel.smaller.size(), layout.smaller.size() - 1); ++i) {
    paint_map(canvas, panel.smaller[i], layout.smaller[i], TextStyle::Small);
  }
  paint_profile(canvas, panel.profile, layout.smaller.back());
}

}  // namespace afm::render
