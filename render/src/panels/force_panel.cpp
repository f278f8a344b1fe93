// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>

#include "panels/panel_painting.h"
#include "panels/plot_scale.h"
#include "panels/title_text.h"

namespace afm::render {
namespace {

constexpr float kColumn = 1.0F;  // a third of a pixel at 960 pixels on a wall of 3 m
constexpr float kRetractWidth = 7.0F;
constexpr float kApproachWidth = 4.5F;
constexpr float kFadedAlpha = 0.50F;
constexpr float kCursorRadius = 19.0F;

// The live force: its top, and the baseline of digits of all sizes, as a fraction of the em
// square.
constexpr float kFigureTop = -10.0F, kBaseline = 0.80F;
constexpr std::string_view kWidestNumber = "\u221200.00", kWidestUnit = "nN";

// Calls `visit` for each character of a UTF-8 text.
template <class Visit>
void for_each_letter(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    std::size_t end = 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
    visit(text.substr(0, end));
    text.remove_prefix(end);
  }
}

float cell_width(const Canvas& canvas, std::string_view letter) {
  const bool digit = std::isdigit(static_cast<unsigned char>(letter.front())) != 0;
  return canvas.text_width_mm(TextStyle::Figure, digit ? "0" : letter);
}

// Position of the axes on the canvas, and their ranges.
struct Plot {
  glm::vec2 top_left{0.0F};
  glm::vec2 bottom_right{0.0F};
  double place_min = 0, place_max = 1, force_min = 0, force_max = 1;

  float x(double place_nm) const {
    const auto share = static_cast<float>((place_nm - place_min) / (place_max - place_min));
    return top_left.x + share * (bottom_right.x - top_left.x);
  }
  float y(double force_nn) const {
    const auto share = static_cast<float>((force_nn - force_min) / (force_max - force_min));
    return bottom_right.y - share * (bottom_right.y - top_left.y);
  }
  glm::vec2 place(const PlotPoint& point) const { return {x(point.place_nm), y(point.force_nn)}; }
};

// Replaces an empty or inverted range, so that there is always an axis.
std::pair<double, double> sane_range(double low, double high) {
  if (std::isfinite(low) && std::isfinite(high) && high > low) {
    return {low, high};
  }
  return {-1.0, 1.0};
}

constexpr float kUnitGap = 12.0F;

// Width of a number in the largest digits, with its unit. Digits have equal cells, so that none moves when another
// changes.
float number_width(const Canvas& canvas, std::string_view number, std::string_view unit) {
  float width = kUnitGap + canvas.text_width_mm(TextStyle::Title, unit);
  for_each_letter(number, [&](std::string_view letter) { width += cell_width(canvas, letter); });
  return width;
}

// Draws a number with its unit that ends at `right`, smaller if it is wider than `room`.
void paint_number(Canvas& canvas, std::string_view text, float right, float top, float room) {
  const std::size_t space = std::min(text.rfind(' '), text.size());
  const std::string_view number = text.substr(0, space), unit = text.substr(std::min(space + 1, text.size()));
  const float scale = std::min(1.0F, room / number_width(canvas, number, unit));
  const float large = text_height_mm(TextStyle::Figure), small = text_height_mm(TextStyle::Title);
  top += 0.5F * (1.0F - scale) * large;
  // on the baseline of the digits
  canvas.text({right, top + scale * kBaseline * (large - small)}, TextStyle::Title, palette::kMuted, unit, Align::Right,
              scale);
  float x = right - scale * number_width(canvas, number, unit);
  for_each_letter(number, [&](std::string_view letter) {
    const float cell = scale * cell_width(canvas, letter);
    canvas.text({x + 0.5F * cell, top}, TextStyle::Figure, palette::kInk, letter, Align::Center, scale);
    x += cell;
  });
}

// Draws title, part of the cycle and current force: side by side, or on a narrow panel below each other. Returns the
// lower end.
float paint_heading(Canvas& canvas, const ForcePanel& panel) {
  constexpr float kPlain = 146.0F, kApart = 30.0F, kLeastShrunk = 0.75F, kLine = 56.0F, kTail = 16.0F;
  const float whole = 162.0F + (panel.words.decimal_mark == ',' ? kTail : 0.0F);  // below the digits, or a comma
  const float width = canvas.size_mm().x - 2.0F * kMargin, right = kMargin + width;
  const auto heading = [&](float room) {
    paint_title(canvas, {kMargin, 24.0F}, panel.title, room);
    canvas.shrunk_text({kMargin, 92.0F}, TextStyle::Body, palette::kYellow, panel.stage, room);
  };
  if (panel.live.empty()) {
    heading(width);
    return kPlain;
  }
  const float room = width - kApart - number_width(canvas, kWidestNumber, kWidestUnit);
  if (room > kLeastShrunk * canvas.text_width_mm(TextStyle::Title, panel.title)) {
    heading(room);
    paint_number(canvas, panel.live, right, kFigureTop, width - room - kApart);
    return whole;
  }
  const float half = 0.5F * (width - kApart);
  canvas.shrunk_text({kMargin, 20.0F}, TextStyle::Body, palette::kInk, panel.title, half);
  canvas.shrunk_text({kMargin + half + kApart, 20.0F}, TextStyle::Body, palette::kYellow, panel.stage, half);
  paint_number(canvas, panel.live, right, kFigureTop + kLine, width);
  return whole + kLine;
}

// Draws columns from `top` down: small names with the values below them. Returns the lower end.
float paint_figures(Canvas& canvas, const std::vector<DataRow>& figures, float top) {
  if (figures.empty()) return top;
  constexpr float kApart = 24.0F, kBelow = 18.0F;
  const float name_height = text_height_mm(TextStyle::Small), value_height = text_height_mm(TextStyle::Strong);
  const auto count = static_cast<float>(figures.size());
  const float width = (canvas.size_mm().x - 2.0F * kMargin - (count - 1.0F) * kApart) / count;
  float x = kMargin;
  for (const DataRow& figure : figures) {
    canvas.shrunk_text({x, top}, TextStyle::Small, palette::kMuted, figure.name, width);
    canvas.shrunk_text({x, top + name_height + 2.0F}, TextStyle::Strong, palette::kInk, figure.value, width);
    x += width + kApart;
  }
  return top + name_height + value_height + kBelow;
}

// Draws one entry per curve with a label, smaller if there are many, and the legend of dashed and solid lines.
void paint_legend(Canvas& canvas, const ForcePanel& panel, float y) {
  constexpr float kStroke = 42.0F, kLabel = 54.0F, kApart = 34.0F;
  float whole = -kApart;
  for (const auto& curve : panel.curves) {
    if (curve.label.empty()) continue;
    whole += kLabel + canvas.text_width_mm(TextStyle::Small, curve.label) + kApart;
  }
  const float scale = std::min(1.0F, (canvas.size_mm().x - 2.0F * kMargin) / std::max(whole, 1.0F));
  float x = kMargin;
  const float middle = y + 19.0F;
  for (const auto& curve : panel.curves) {
    if (curve.label.empty()) continue;
    const Color color{curve.color, curve.faded ? 0.65F : 1.0F};
    const std::array<glm::vec2, 2> stroke{glm::vec2(x, middle), glm::vec2(x + scale * kStroke, middle)};
    if (curve.retract.empty() && !curve.approach.empty()) {
      canvas.dashed_polyline(stroke, kApproachWidth, 14.0F, 9.0F, color);
    } else {
      canvas.line(stroke[0], stroke[1], kRetractWidth, color);
    }
    canvas.text({x + scale * kLabel, middle - scale * 17.0F}, TextStyle::Small,
                curve.faded ? palette::kMuted : palette::kInk, curve.label, Align::Left, scale);
    x += scale * (kLabel + canvas.text_width_mm(TextStyle::Small, curve.label) + kApart);
  }
  if (panel.words.approach.empty()) return;
  const float right = canvas.size_mm().x - kMargin;
  const float retract = right - canvas.text_width_mm(TextStyle::Small, panel.words.retract);
  const float approach = retract - 88.0F - canvas.text_width_mm(TextStyle::Small, panel.words.approach);
  if (approach - 64.0F < x) {
    return;
  }
  const std::array<glm::vec2, 2> dashes{glm::vec2(approach - 64.0F, middle), glm::vec2(approach - 12.0F, middle)};
  canvas.dashed_polyline(dashes, kApproachWidth, 14.0F, 9.0F, palette::kMuted);
  canvas.text({approach, y + 2.0F}, TextStyle::Small, palette::kMuted, panel.words.approach);
  canvas.line({retract - 58.0F, middle}, {retract - 12.0F, middle}, kRetractWidth, palette::kMuted);
  canvas.text({retract, y + 2.0F}, TextStyle::Small, palette::kMuted, panel.words.retract);
}

void paint_axes(Canvas& canvas, const Plot& plot, double place_step, double force_step, char mark) {
  const float tick_height = text_height_mm(TextStyle::Body);
  for (double at = std::ceil(plot.place_min / place_step - 1e-9) * place_step; at <= plot.place_max + 1e-9 * place_step;
       at += place_step) {
    const float x = plot.x(at);
    canvas.line({x, plot.top_left.y}, {x, plot.bottom_right.y}, 1.5F, palette::kGrid);
    canvas.line({x, plot.bottom_right.y}, {x, plot.bottom_right.y + 9.0F}, 2.5F, palette::kAxis);
    const std::string number = tick_text(at, place_step, mark);
    const float right = canvas.size_mm().x - 0.5F * canvas.text_width_mm(TextStyle::Body, number);
    canvas.text({std::min(x, right), plot.bottom_right.y + 12.0F}, TextStyle::Body, palette::kMuted, number,
                Align::Center);
  }
  for (double f = std::ceil(plot.force_min / force_step - 1e-9) * force_step; f <= plot.force_max + 1e-9 * force_step;
       f += force_step) {
    const float y = plot.y(f);
    canvas.line({plot.top_left.x, y}, {plot.bottom_right.x, y}, 1.5F, palette::kGrid);
    canvas.line({plot.top_left.x - 9.0F, y}, {plot.top_left.x, y}, 2.5F, palette::kAxis);
    canvas.text({plot.top_left.x - 16.0F, y - 0.5F * tick_height}, TextStyle::Body, palette::kMuted,
                tick_text(f, force_step, mark), Align::Right);
  }
  const std::array<glm::vec2, 3> frame{plot.top_left, glm::vec2(plot.top_left.x, plot.bottom_right.y),
                                       plot.bottom_right};
  canvas.polyline(frame, 2.5F, palette::kAxis);
  if (plot.force_min < 0.0 && plot.force_max > 0.0) {
    canvas.line({plot.top_left.x, plot.y(0.0)}, {plot.bottom_right.x, plot.y(0.0)}, 3.0F, palette::kAxis);
  }
}

// Centre of the cursor, at the edge if it lies outside.
std::optional<glm::vec2> cursor_place(const Plot& plot, const ForcePanel& panel) {
  if (!panel.cursor || !std::isfinite(panel.cursor->place_nm) || !std::isfinite(panel.cursor->force_nn)) return {};
  return glm::clamp(plot.place(*panel.cursor), plot.top_left, plot.bottom_right);
}

// Box of the caption of the force axis, in the corner where the cursor of a pressed tip lies.
LabelBox force_caption(const Canvas& canvas, const Plot& plot, const ForcePanel& panel) {
  const glm::vec2 place = plot.top_left + glm::vec2(8.0F, -2.0F);
  const glm::vec2 size(canvas.text_width_mm(TextStyle::Body, panel.words.force_axis) + 16.0F,
                       text_height_mm(TextStyle::Body) + 6.0F);
  const LabelBox corner{place, place + size};
  const auto cursor = cursor_place(plot, panel);
  return cursor ? moved_right_of({*cursor - kCursorRadius, *cursor + kCursorRadius}, corner) : corner;
}

// Draws the captions of both axes, over the curves.
void paint_captions(Canvas& canvas, const Plot& plot, const LabelBox& force, const PlotWords& words) {
  canvas.rectangle(force.from, force.to, Color{palette::kPlate.srgb, 0.85F}, 6.0F);
  canvas.text(force.from + glm::vec2(8.0F, 1.0F), TextStyle::Body, palette::kInk, words.force_axis);
  // in the middle, since the sample hides the panel's right corner
  canvas.text({0.5F * (plot.top_left.x + plot.bottom_right.x), plot.bottom_right.y + 54.0F}, TextStyle::Body,
              palette::kInk, words.place_axis, Align::Center);
}

// Points on the canvas, as many as it can show; valid until the next call.
std::span<const glm::vec2> placed(Canvas& canvas, const Plot& plot, const std::vector<PlotPoint>& points) {
  std::vector<glm::vec2>& places = canvas.memory().points;
  places.clear();
  for (const auto& point : points) {
    if (std::isfinite(point.place_nm) && std::isfinite(point.force_nn)) {
      places.push_back(plot.place(point));
    }
  }
  thin_out(places, kColumn);
  return places;
}

// Height of a branch at the middle of each column; for a stretch that the hand crossed several times, the last height.
using Heights = std::array<std::optional<float>, 640>;

void take_heights(std::span<const glm::vec2> points, float left, float column, Heights& heights) {
  heights.fill(std::nullopt);
  const auto at = [&](std::size_t i) { return left + (static_cast<float>(i) + 0.5F) * column; };
  for (std::size_t p = 0; p + 1 < points.size(); ++p) {
    const glm::vec2 low = points[p].x < points[p + 1].x ? points[p] : points[p + 1];
    const glm::vec2 high = points[p].x < points[p + 1].x ? points[p + 1] : points[p];
    const auto first = static_cast<std::size_t>(std::max(0.0F, std::ceil((low.x - left) / column - 0.5F)));
    for (std::size_t i = first; i < heights.size() && at(i) <= high.x; ++i) {
      heights[i] = glm::mix(low.y, high.y, (at(i) - low.x) / std::max(high.x - low.x, 1e-6F));
    }
  }
}

// Fills between the branches, in columns: a jump is a step.
void fill_loop(Canvas& canvas, const Plot& plot, const PlotCurve& curve) {
  constexpr float kAlpha = 0.20F;
  Heights approach, retract;
  const float column = (plot.bottom_right.x - plot.top_left.x) / static_cast<float>(approach.size());
  take_heights(placed(canvas, plot, curve.approach), plot.top_left.x, column, approach);
  take_heights(placed(canvas, plot, curve.retract), plot.top_left.x, column, retract);
  for (std::size_t i = 0; i < approach.size(); ++i) {
    if (!approach[i] || !retract[i]) continue;
    const float x = plot.top_left.x + static_cast<float>(i) * column;
    const auto [top, bottom] = std::minmax(*approach[i], *retract[i]);
    canvas.rectangle({x, top}, {x + column, bottom}, Color{curve.color, kAlpha});
  }
}

void paint_curve(Canvas& canvas, const Plot& plot, const PlotCurve& curve) {
  const Color color{curve.color, curve.faded ? kFadedAlpha : 1.0F};
  const float thin = curve.faded ? 0.75F : 1.0F;
  canvas.polyline(placed(canvas, plot, curve.retract), kRetractWidth * thin, color);
  canvas.dashed_polyline(placed(canvas, plot, curve.approach), kApproachWidth * thin, 16.0F, 10.0F, color);
}

bool in_range(const Plot& plot, const PlotMarker& marker) {
  const bool vertical = marker.kind == PlotMarker::Kind::VerticalLine;
  return vertical ? marker.value >= plot.place_min && marker.value <= plot.place_max
                  : marker.value >= plot.force_min && marker.value <= plot.force_max;
}

// Draws all lines first, so that none crosses a label.
void paint_markers(Canvas& canvas, const Plot& plot, const std::vector<PlotMarker>& markers, const LabelBox& caption) {
  const Color line_color{palette::kInk.srgb, 0.60F};
  std::vector<MarkerLabel>& labels = canvas.memory().labels;
  labels.clear();
  for (const PlotMarker& marker : markers) {
    if (!in_range(plot, marker)) {
      continue;
    }
    const bool vertical = marker.kind == PlotMarker::Kind::VerticalLine;
    const float line = vertical ? plot.x(marker.value) : plot.y(marker.value);
    const std::array<glm::vec2, 2> ends{
        vertical ? glm::vec2(line, plot.top_left.y) : glm::vec2(plot.top_left.x, line),
        vertical ? glm::vec2(line, plot.bottom_right.y) : glm::vec2(plot.bottom_right.x, line)};
    canvas.dashed_polyline(ends, 2.2F, 7.0F, 7.0F, line_color);
    if (marker.label.empty()) continue;
    labels.push_back(
        {marker.kind,
         line,
         {canvas.text_width_mm(TextStyle::Small, marker.label) + 12.0F, text_height_mm(TextStyle::Small) + 6.0F}});
  }
  std::vector<LabelBox>& boxes = canvas.memory().boxes;
  boxes.assign(1, caption);
  place_labels(labels, {plot.top_left, plot.bottom_right}, boxes);
  auto box = boxes.begin() + 1;
  for (const PlotMarker& marker : markers) {
    if (!in_range(plot, marker) || marker.label.empty()) {
      continue;
    }
    const LabelBox& place = *box++;
    if (place.empty()) continue;
    canvas.rectangle(place.from, place.to, Color{palette::kPlate.srgb, 0.85F}, 6.0F);
    canvas.text(place.from + glm::vec2(6.0F, 2.0F), TextStyle::Small, palette::kInk, marker.label);
  }
}

void paint_cursor(Canvas& canvas, const glm::vec2& place) {
  canvas.disc(place, kCursorRadius, palette::kPlate);
  canvas.disc(place, 16.0F, palette::kInk);
  canvas.disc(place, 9.5F, palette::kOrange);
}

}  // namespace

void paint(Canvas& canvas, const ForcePanel& panel) {
  canvas.panel_background();
  const float legend_y = paint_figures(canvas, panel.figures, paint_heading(canvas, panel));
  paint_legend(canvas, panel, legend_y);

  const char mark = panel.words.decimal_mark;
  Plot plot;
  std::tie(plot.place_min, plot.place_max) = sane_range(panel.place_min_nm, panel.place_max_nm);
  std::tie(plot.force_min, plot.force_max) = sane_range(panel.force_min_nn, panel.force_max_nn);
  const double place_step = tick_step(plot.place_max - plot.place_min, 6);
  const double force_step = tick_step(plot.force_max - plot.force_min, 6);
  const float widest = std::max(canvas.text_width_mm(TextStyle::Body, tick_text(plot.force_min, force_step, mark)),
                                canvas.text_width_mm(TextStyle::Body, tick_text(plot.force_max, force_step, mark)));
  plot.top_left = {kMargin + widest + 16.0F, legend_y + 56.0F};
  plot.bottom_right = canvas.size_mm() - glm::vec2(kMargin, 112.0F);
  paint_axes(canvas, plot, place_step, force_step, mark);

  // markers before the curves, so that no label hides measured data
  const LabelBox caption = force_caption(canvas, plot, panel);
  paint_markers(canvas, plot, panel.markers, caption);
  canvas.push_clip(plot.top_left, plot.bottom_right);
  for (const auto& curve : panel.curves) {
    if (curve.filled) fill_loop(canvas, plot, curve);
  }
  for (const auto& curve : panel.curves) {
    if (curve.faded) {
      paint_curve(canvas, plot, curve);
    }
  }
  for (const auto& curve : panel.curves) {
    if (!curve.faded) {
      paint_curve(canvas, plot, curve);
    }
  }
  canvas.pop_clip();
  paint_captions(canvas, plot, caption, panel.words);
  if (const auto place = cursor_place(plot, panel)) paint_cursor(canvas, *place);
}

}  // namespace afm::render
