// SPDX-License-Identifier: Apache-2.0
#include "curves/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/printable.h"
#include "core/written_by.h"

namespace afm::curves {
namespace {

constexpr double kLeft = 92;
constexpr double kRight = 28;
constexpr double kTitle = 48;  // height of the title above the legend
constexpr double kLegendRow = 26;
constexpr double kBottom = 68;
constexpr double kTolerancePx = 0.1;
constexpr int kTicks = 8;  // approximate number of ticks on an axis

bool finite(SvgPoint p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : core::printable(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// Tick interval: 1, 2 or 5 times a power of ten, about `range`/kTicks.
double tick_step(double range) {
  const double rough = range / kTicks;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double mantissa = rough / power;
  return power * (mantissa < 1.5 ? 1.0 : mantissa < 3.5 ? 2.0 : mantissa < 7.5 ? 5.0 : 10.0);
}

// Text of an integer power of ten.
std::string power_text(double exponent) {
  constexpr std::array<const char*, 10> kSuperscripts{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                      "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = "10";
  if (exponent < 0) text += "\u207b";
  for (const char digit : fmt::format("{}", std::abs(std::lround(exponent)))) {
    text += kSuperscripts[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

// A number on an axis with ticks at intervals of `step`: no unnecessary decimals, and a typographic minus sign.
std::string tick_text(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  return value < -0.5 * step ? "\u2212" + text : text;
}

struct Axis {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double step = 1;
  AxisScale scale = AxisScale::Linear;
  char decimal_mark = '.';

  // position of a number on the axis; NaN if it has none
  double place(double value) const {
    if (scale == AxisScale::Linear) return value;
    return value > 0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
  }

  std::string text(double tick) const {
    if (scale == AxisScale::Logarithmic) return power_text(tick);
    std::string digits = tick_text(tick, step);
    std::replace(digits.begin(), digits.end(), '.', decimal_mark);
    return digits;
  }

  bool is_zero(double tick) const { return scale == AxisScale::Linear && tick == 0; }

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }

  // adds a margin around the data, and a range for no data or a single value
  void settle() {
    if (low > high) {
      low = 0;
      high = 1;
    }
    if (low == high) {
      const double half = 0.5 * std::max(1e-12, std::abs(low));
      low -= half;
      high += half;
    }
    const double margin = 0.04 * (high - low);
    low -= margin;
    high += margin;
    step = tick_step(high - low);
    if (scale == AxisScale::Logarithmic) step = std::max(1.0, std::round(step));
  }

  double first_tick() const { return std::ceil(low / step); }
  double last_tick() const { return std::floor(high / step); }
};

// Legend entry: a line's sample and its label; `x` is the distance from the plot's left edge.
struct LegendEntry {
  const SvgLine* line;
  double x;
  int row;
};

constexpr double kLegendSample = 34;
constexpr double kCharacter = 8.3;  // width of a character, slightly more than the font's mean advance

// Entries in rows up to the plot's width, at least one per row.
std::vector<LegendEntry> legend_entries(const SvgPlot& plot) {
  const double width = plot.width - kLeft - kRight;
  std::vector<LegendEntry> entries;
  double x = 0;
  int row = 0;
  for (const SvgLine& line : plot.lines) {
    if (line.label.empty()) continue;
    const double advance = kLegendSample + 30 + kCharacter * static_cast<double>(line.label.size());
    if (x > 0 && x + advance > width) {
      x = 0;
      ++row;
    }
    entries.push_back({&line, x, row});
    x += advance;
  }
  return entries;
}

double legend_height(const SvgPlot& plot) {
  const auto entries = legend_entries(plot);
  return kLegendRow * (entries.empty() ? 0 : entries.back().row + 1);
}

// Converts the plot's numbers to pixels.
class Frame {
 public:
  explicit Frame(const SvgPlot& plot)
      : left_(kLeft),
        right_(plot.width - kRight),
        top_(kTitle + legend_height(plot) + 10),
        bottom_(plot.height - kBottom) {
    x_.scale = plot.x_scale;
    y_.scale = plot.y_scale;
    x_.decimal_mark = y_.decimal_mark = plot.decimal_mark;
    for (const SvgLine& line : plot.lines) {
      for (const SvgPoint& point : line.points) include(placed(point));
    }
    for (const SvgMark& mark : plot.marks) include(placed(mark.at));
    x_.settle();
    y_.settle();
  }

  const Axis& x() const { return x_; }
  const Axis& y() const { return y_; }
  double left() const { return left_; }
  double right() const { return right_; }
  double top() const { return top_; }
  double bottom() const { return bottom_; }
  // takes positions on the axes
  double x_px(double x) const { return left_ + (x - x_.low) / (x_.high - x_.low) * (right_ - left_); }
  double y_px(double y) const { return bottom_ - (y - y_.low) / (y_.high - y_.low) * (bottom_ - top_); }
  SvgPoint placed(SvgPoint point) const { return {x_.place(point.x), y_.place(point.y)}; }

 private:
  void include(SvgPoint point) {
    if (!finite(point)) return;
    x_.include(point.x);
    y_.include(point.y);
  }

  double left_, right_, top_, bottom_;
  Axis x_, y_;
};

double distance_to_segment(SvgPoint p, SvgPoint a, SvgPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

void draw_axes(std::string& out, const SvgPlot& plot, const Frame& frame) {
  out += fmt::format("<g stroke=\"#dde1e6\">\n");
  std::string labels;
  for (double i = frame.x().first_tick(); i <= frame.x().last_tick(); ++i) {
    const double x = frame.x_px(i * frame.x().step);
    out += fmt::format("<path d=\"M{0:.2f} {1:.2f}V{2:.2f}\"{3}/>\n", x, frame.top(), frame.bottom(),
                       frame.x().is_zero(i) ? " stroke=\"#7a828c\"" : "");
    labels += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n", x, frame.bottom() + 22,
                          frame.x().text(i * frame.x().step));
  }
  for (double i = frame.y().first_tick(); i <= frame.y().last_tick(); ++i) {
    const double y = frame.y_px(i * frame.y().step);
    out += fmt::format("<path d=\"M{0:.2f} {1:.2f}H{2:.2f}\"{3}/>\n", frame.left(), y, frame.right(),
                       frame.y().is_zero(i) ? " stroke=\"#7a828c\"" : "");
    labels += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", frame.left() - 10, y + 5,
                          frame.y().text(i * frame.y().step));
  }
  out += fmt::format(
      "</g>\n<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"none\" stroke=\"#3c434b\"/>\n",
      frame.left(), frame.top(), frame.right() - frame.left(), frame.bottom() - frame.top());
  out += labels;
  const double middle_y = 0.5 * (frame.top() + frame.bottom());
  out += fmt::format("<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (frame.left() + frame.right()), plot.height - 18, escaped(plot.x_label));
  out += fmt::format("<text transform=\"translate(26 {:.2f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     middle_y, escaped(plot.y_label));
}

constexpr double kMarkGap = 10;  // gap between a dot and its text

const char* dashes(LineStyle style) { return style == LineStyle::Dashed ? " stroke-dasharray=\"7 5\"" : ""; }

double stroke_width(LineStyle style) { return style == LineStyle::Dashed ? 1.8 : 2.4; }

void draw_line(std::string& out, const SvgLine& line, const Frame& frame) {
  std::string path;
  std::vector<SvgPoint> run;
  const auto end_run = [&] {
    const auto kept = simplified(run, kTolerancePx);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      path += fmt::format("{}{:.2f} {:.2f}", i == 0 ? 'M' : 'L', kept[i].x, kept[i].y);
    }
    run.clear();
  };
  for (const SvgPoint& point : line.points) {
    if (const SvgPoint place = frame.placed(point); finite(place)) {
      run.push_back({frame.x_px(place.x), frame.y_px(place.y)});
    } else {
      end_run();
    }
  }
  end_run();
  if (path.empty()) return;
  out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n",
                     path, escaped(line.color), stroke_width(line.style), dashes(line.style));
}

// The side of a mark at `x` on which its text stays within the axes, whose numbers it would cover; the wanted one where
// neither does.
SvgMark::Side side_within(const SvgMark& mark, double x, const Frame& frame) {
  using Side = SvgMark::Side;
  const double reach = kMarkGap + kCharacter * static_cast<double>(core::count_characters(mark.text));
  const bool fits_left = x - reach >= frame.left(), fits_right = x + reach <= frame.right();
  if (mark.side == Side::Left && !fits_left && fits_right) return Side::Right;
  if (mark.side == Side::Right && !fits_right && fits_left) return Side::Left;
  return mark.side;
}

void draw_mark(std::string& out, const SvgMark& mark, const Frame& frame) {
  using Side = SvgMark::Side;
  const SvgPoint place = frame.placed(mark.at);
  if (!finite(place)) return;
  const double x = frame.x_px(place.x), y = frame.y_px(place.y);
  if (mark.side != Side::Centre) {
    out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4.5\" fill=\"{}\" stroke=\"#fff\"/>\n", x, y,
                       escaped(mark.color));
  }
  if (mark.text.empty()) return;
  const Side side = side_within(mark, x, frame);
  const double dx = side == Side::Left ? -kMarkGap : side == Side::Right ? kMarkGap : 0;
  const double dy = side == Side::Above ? -11 : side == Side::Below ? 21 : 5;
  const char* anchor = side == Side::Left ? "end" : side == Side::Right ? "start" : "middle";
  // a white outline keeps the text readable where it crosses a line
  out += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\" font-weight=\"600\" stroke=\"#fff\" "
      "stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>\n",
      x + dx, y + dy, anchor, escaped(mark.color), escaped(mark.text));
}

void draw_legend(std::string& out, const SvgPlot& plot) {
  for (const auto& [line, offset, row] : legend_entries(plot)) {
    const double x = kLeft + offset;
    const double y = kTitle + kLegendRow * (row + 0.5);
    out += fmt::format("<path d=\"M{:.2f} {:.2f}H{:.2f}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", x, y,
                       x + kLegendSample, escaped(line->color), stroke_width(line->style), dashes(line->style));
    out +=
        fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", x + kLegendSample + 8, y + 5, escaped(line->label));
  }
}

}  // namespace

std::string_view distinct_color(std::size_t index) {
  // blue, vermillion, bluish green, reddish purple, and orange darkened for a white background
  constexpr std::array<std::string_view, 5> kColors{"#0072b2", "#d55e00", "#009e73", "#b0578f", "#a97500"};
  return kColors[index % kColors.size()];
}

std::vector<SvgPoint> simplified(std::span<const SvgPoint> points, double tolerance) {
  if (points.size() < 3) return {points.begin(), points.end()};
  const auto by_x = [](SvgPoint a, SvgPoint b) { return a.x < b.x; };
  const auto by_y = [](SvgPoint a, SvgPoint b) { return a.y < b.y; };
  const auto [left, right] = std::minmax_element(points.begin(), points.end(), by_x);
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end(), by_y);

  std::vector<bool> keep(points.size(), false);
  std::vector<std::size_t> anchors{0, points.size() - 1};
  for (const auto extreme : {left, right, lowest, highest}) {
    anchors.push_back(static_cast<std::size_t>(extreme - points.begin()));
  }
  std::sort(anchors.begin(), anchors.end());

  // splits each span at its farthest point until none is farther than the tolerance
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    keep[anchors[i]] = true;
    if (i > 0) spans.emplace_back(anchors[i - 1], anchors[i]);
  }
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double farthest = tolerance;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance = distance_to_segment(points[i], points[first], points[last]);
      if (distance > farthest) {
        farthest = distance;
        at = i;
      }
    }
    if (at == first) continue;
    keep[at] = true;
    spans.emplace_back(first, at);
    spans.emplace_back(at, last);
  }

  std::vector<SvgPoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) kept.push_back(points[i]);
  }
  return kept;
}

std::string svg(const SvgPlot& plot) { return svg(std::span(&plot, 1)); }

std::string svg(std::span<const SvgPlot> column) {
  int width = 0;
  int height = 0;
  std::string about = core::written_by();
  for (const SvgPlot& plot : column) {
    width = std::max(width, plot.width);
    height += plot.height;
    if (!plot.about.empty()) about += "\n" + plot.about;
  }
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "font-family=\"Inter, 'DejaVu Sans', sans-serif\" font-size=\"16\" fill=\"#1d2329\">\n"
      "<metadata>{2}</metadata>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      width, height, escaped(about));
  int top = 0;
  for (const SvgPlot& plot : column) {
    const Frame frame(plot);
    out += fmt::format(
        "<g transform=\"translate(0 {0})\">\n<title>{1}</title>\n"
        "<text x=\"{2}\" y=\"34\" font-size=\"20\" font-weight=\"600\">{1}</text>\n",
        top, escaped(plot.title), kLeft);
    draw_axes(out, plot, frame);
    for (const SvgLine& line : plot.lines) draw_line(out, line, frame);
    for (const SvgMark& mark : plot.marks) draw_mark(out, mark, frame);
    draw_legend(out, plot);
    out += "</g>\n";
    top += plot.height;
  }
  return out + "</svg>\n";
}

}  // namespace afm::curves
