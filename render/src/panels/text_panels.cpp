// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "panels/panel_painting.h"
#include "panels/title_text.h"

namespace afm::render {
namespace {

void paint_shape(Canvas& canvas, StateShape shape, glm::vec2 c, float r, Color color) {
  switch (shape) {
    case StateShape::Circle:
      canvas.disc(c, r, color);
      break;
    case StateShape::Triangle: {
      const std::array<glm::vec2, 3> corners{c + glm::vec2(0.0F, -r), c + glm::vec2(0.95F * r, 0.75F * r),
                                             c + glm::vec2(-0.95F * r, 0.75F * r)};
      canvas.polygon(corners, color);
      break;
    }
    case StateShape::Square:
      canvas.rectangle(c - glm::vec2(0.85F * r), c + glm::vec2(0.85F * r), color, 3.0F);
      break;
    case StateShape::Diamond: {
      const std::array<glm::vec2, 4> corners{c + glm::vec2(0.0F, -r), c + glm::vec2(r, 0.0F), c + glm::vec2(0.0F, r),
                                             c + glm::vec2(-r, 0.0F)};
      canvas.polygon(corners, color);
      break;
    }
    case StateShape::Cross:
      canvas.line(c - glm::vec2(0.8F * r), c + glm::vec2(0.8F * r), 0.5F * r, color);
      canvas.line(c + glm::vec2(-0.8F, 0.8F) * r, c + glm::vec2(0.8F, -0.8F) * r, 0.5F * r, color);
      break;
  }
}

struct Plate {
  glm::vec2 from, to;
};

// Draws the state as a word and a shape that end at `right`. It must be readable in the smallest picture, so its size
// in pixels has a lower limit.
Plate paint_state(Canvas& canvas, const Banner& banner, float right, float top) {
  constexpr float kReadablePx = 14.0F;  // height of the em square, in pixels of an eye
  constexpr float kMostEnlarged = 2.4F, kEdge = 12.0F;
  const float em = text_height_mm(TextStyle::Strong);
  const float room = (canvas.size_mm().y - 2.0F * kEdge) / (em + 24.0F);
  const float scale =
      std::clamp(kReadablePx / (em * canvas.pixels_per_mm()), 1.0F, std::clamp(room, 1.0F, kMostEnlarged));
  const float height = scale * (em + 24.0F);
  top = std::min(top, std::max(kEdge, canvas.size_mm().y - kEdge - height));
  const float width = canvas.text_width_mm(TextStyle::Strong, banner.state_word, scale) + scale * 96.0F;
  const glm::vec2 from(right - width, top);
  const Color color{banner.state_color, 1.0F};
  canvas.rectangle(from, {right, top + height}, Color{banner.state_color, 0.16F}, 0.5F * height);
  canvas.outline(from, {right, top + height}, 2.5F * scale, Color{banner.state_color, 0.8F}, 0.5F * height);
  paint_shape(canvas, banner.state_shape, from + glm::vec2(scale * 40.0F, 0.5F * height), scale * 17.0F, color);
  canvas.text(from + scale * glm::vec2(70.0F, 11.0F), TextStyle::Strong, palette::kInk, banner.state_word, Align::Left,
              scale);
  return {from, {right, top + height}};
}

bool is_words(const DataRow& row) { return row.value.empty() && row.source.empty(); }

// Height of a line of words with the gap above it.
float words_line_mm() { return text_height_mm(TextStyle::Strong) + 8.0F; }

// Removes from `words` the first line that fits this width, with the space after it, and returns it; at least one word.
std::string_view take_line(const Canvas& canvas, std::string_view& words, float width_mm, float scale) {
  std::size_t end = words.find(' ');
  while (end != std::string_view::npos) {
    const std::size_t next = words.find(' ', end + 1);
    if (canvas.text_width_mm(TextStyle::Strong, words.substr(0, next), scale) > width_mm) break;
    end = next;
  }
  const std::string_view line = words.substr(0, end);
  words.remove_prefix(std::min(line.size() + 1, words.size()));
  return line;
}

// Calls `draw` for each line of the rows, with a flag for the beginning of a row; false if one is too wide.
template <class Draw>
bool for_each_line(const Canvas& canvas, const DataPanel& panel, float scale, const Draw& draw) {
  const float width = canvas.size_mm().x - 2.0F * kMargin;
  bool fits = true;
  for (const DataRow& row : panel.rows) {
    bool begins = true;
    for (std::string_view rest = row.name; !rest.empty();) {
      const std::string_view line = take_line(canvas, rest, width, scale);
      fits = fits && canvas.text_width_mm(TextStyle::Strong, line, scale) <= width;
      draw(line, std::exchange(begins, false));
    }
  }
  return fits;
}

constexpr float kHeader = 150.0F, kBelowRows = 18.0F;  // heights in a data panel
constexpr float kMostPitch = 84.0F;
constexpr float kTextPitch = 62.0F;      // distance of two lines of a text
constexpr float kParagraphShare = 0.5F;  // gap between two paragraphs, in lines

// Scale of the header, which is not larger than above a table.
float header_scale(float scale) { return std::min(1.0F, scale); }

// Number of lines of a text, with the gaps between its paragraphs; true if no line is too wide.
std::pair<float, bool> lines_of(const Canvas& canvas, const DataPanel& panel, float scale) {
  float lines = kParagraphShare * static_cast<float>(panel.rows.size() - 1);
  const bool fits = for_each_line(canvas, panel, scale, [&](std::string_view, bool) { lines += 1.0F; });
  return {lines, fits};
}

// Scale at which the text fills its panel, up to the size of the guidance.
float text_scale(const Canvas& canvas, const DataPanel& panel) {
  constexpr float kSmaller = 0.99F, kLeast = 0.2F;
  float scale = text_height_mm(TextStyle::Guidance) / text_height_mm(TextStyle::Strong);
  for (; scale > kLeast; scale *= kSmaller) {
    const auto [lines, fits] = lines_of(canvas, panel, scale);
    const float text = scale * (kBelowRows + lines * words_line_mm());
    if (fits && header_scale(scale) * kHeader + text <= canvas.size_mm().y) break;
  }
  return scale;
}

void paint_text(Canvas& canvas, const DataPanel& panel, float top, float room, float scale) {
  const float pitch = std::min(kTextPitch * scale, room / lines_of(canvas, panel, scale).first);
  bool first = true;
  for_each_line(canvas, panel, scale, [&](std::string_view line, bool begins) {
    if (begins && !std::exchange(first, false)) top += kParagraphShare * pitch;
    canvas.text({kMargin, top + 14.0F * scale}, TextStyle::Strong, palette::kInk, line, Align::Left, scale);
    top += pitch;
  });
}

// Draws a row that has only a name, as a line of words.
void paint_words(Canvas& canvas, std::string_view words, float top, float pitch) {
  const float room = canvas.size_mm().x - 2.0F * kMargin;
  const float by_height = std::min(1.0F, pitch / words_line_mm());
  const float by_width = room / std::max(canvas.text_width_mm(TextStyle::Strong, words), 1.0F);
  canvas.text({kMargin, top + 14.0F * by_height}, TextStyle::Strong, palette::kInk, words, Align::Left,
              std::min(by_height, by_width));
}

constexpr float kLargestRow = 1.4F;  // scale of a row with only a name and a value
constexpr float kLeastName = 0.75F;  // smallest size of a name, relative to its value
constexpr float kNameGap = 20.0F;
constexpr float kLeastSource = 0.275F;  // smallest size of a source, relative to its style

// Source shown below a row.
std::string_view shown_source(const DataPanel& panel, const DataRow& row) {
  return row.detail && !panel.details ? std::string_view() : std::string_view(row.source);
}

// Height of a row: name and value, and the source, if any, below them.
float row_block_mm(std::string_view source) { return source.empty() ? 46.0F : 78.0F; }

float row_block_mm(const DataPanel& panel, const DataRow& row) {
  return is_words(row) ? words_line_mm() : row_block_mm(shown_source(panel, row));
}

// Heights of the rows at text scale 1.
struct TableBlocks {
  float tallest_mm = 0.0F;
  float sum_mm = 0.0F;
};
TableBlocks blocks_of(const DataPanel& panel) {
  TableBlocks blocks;
  for (const DataRow& row : panel.rows) {
    const float block = row_block_mm(panel, row);
    blocks.tallest_mm = std::max(blocks.tallest_mm, block);
    blocks.sum_mm += block;
  }
  return blocks;
}

// Height of a row in a table of this height: the same for all if the tallest row fits, otherwise in proportion to their
// contents, so that their letters have one size.
float row_height_mm(const DataPanel& panel, const DataRow& row, float room) {
  const TableBlocks blocks = blocks_of(panel);
  const auto count = static_cast<float>(panel.rows.size());
  const float pitch = std::min(kMostPitch, room / count);
  if (pitch >= blocks.tallest_mm) return pitch;
  const float spare = std::max(0.0F, room - blocks.sum_mm) / count;
  return std::min(1.0F, room / blocks.sum_mm) * row_block_mm(panel, row) + spare;
}

// Text scale of a table. The header shrinks as much as the rows, if there are so many that they must shrink.
float table_scale(const Canvas& canvas, const DataPanel& panel) {
  return std::min(1.0F, (canvas.size_mm().y - kBelowRows) / (kHeader + blocks_of(panel).sum_mm));
}

// Largest text scale of rows that have only a name and a value: all values have one size, and a long name may be
// smaller.
float largest_row(const Canvas& canvas, const DataPanel& panel) {
  float largest = panel.details || blocks_of(panel).tallest_mm > words_line_mm() ? 1.0F : kLargestRow;
  for (const DataRow& row : panel.rows) {
    const float name = canvas.text_width_mm(TextStyle::Body, row.name);
    const float value = canvas.text_width_mm(TextStyle::Strong, row.value);
    const float room = canvas.size_mm().x - 2.0F * kMargin - kNameGap;
    largest = std::min(largest, room / std::max(value + kLeastName * name, 1.0F));
  }
  return std::max(1.0F, largest);
}

// Draws name and value on one line and the source below; smaller if the rows are close together or the line is long.
void paint_row(Canvas& canvas, const DataRow& row, std::string_view source, float top, float pitch, float largest) {
  const float right = canvas.size_mm().x - kMargin, room = right - kMargin;
  const float block = row_block_mm(source);
  const float name = canvas.text_width_mm(TextStyle::Body, row.name);
  const float value = canvas.text_width_mm(TextStyle::Strong, row.value);
  const float by_height = std::min(largest, pitch / block);
  float value_scale = std::min(by_height, room / (name + value + kNameGap)), name_scale = value_scale;
  if (largest > 1.0F) {
    value_scale = by_height;
    name_scale = std::min(by_height, (room - value_scale * value - kNameGap) / std::max(name, 1.0F));
  }
  const float y = top + std::max(0.0F, 0.5F * (pitch - by_height * block));
  const auto lift = [&](float scale) { return 0.5F * (by_height - scale) * text_height_mm(TextStyle::Strong); };
  canvas.text({kMargin, y + lift(name_scale) + 2.0F}, TextStyle::Body, palette::kMuted, row.name, Align::Left,
              name_scale);
  canvas.text({right, y + lift(value_scale)}, TextStyle::Strong, palette::kInk, row.value, Align::Right, value_scale);
  shrunk_text(canvas, {kMargin, y + 46.0F * by_height},
              {TextStyle::Small, Color{palette::kMuted.srgb, 0.85F}, std::min(0.55F, kLeastSource / by_height)}, source,
              room, by_height);
  canvas.line({kMargin, top + pitch}, {right, top + pitch}, 1.5F, palette::kGrid);
}

constexpr Ink kNoteInk{TextStyle::Body, palette::kMuted, 0.0F};

// Facts on the two lower lines of a banner: separated by a line break or by two spaces or more.
class Notes {
 public:
  Notes(const Canvas& canvas, std::string_view text, float scale)
      : canvas_(&canvas), scale_(scale), gap_mm_(canvas.text_width_mm(kNoteInk.style, "     ", scale)) {
    while (!text.empty() && count_ < notes_.size()) {
      const std::size_t end = std::min({text.find('\n'), text.find("  "), text.size()});
      if (end > 0) notes_[count_++] = text.substr(0, end);
      first_line_ = end < text.size() && text[end] == '\n' ? count_ : first_line_;
      text.remove_prefix(std::min(end + 1, text.size()));
      text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    }
    if (first_line_ == 0) first_line_ = count_;
    broken_ = first_line_;
  }

  // Moves facts of the second line to the end of the first while that enlarges the smaller letters.
  void balance(float first_room_mm, float second_room_mm) {
    const auto smaller = [&] {
      return std::min(fit(0, first_line_, first_room_mm), fit(first_line_, count_, second_room_mm));
    };
    for (float best = smaller(); first_line_ < count_; best = smaller()) {
      ++first_line_;
      if (smaller() > best) continue;
      --first_line_;
      return;
    }
  }

  std::size_t first_line() const { return first_line_; }
  std::size_t count() const { return count_; }

  void paint(Canvas& canvas, glm::vec2 position, std::size_t from, std::size_t to, float room_mm) const {
    const float fitted = fit(from, to, room_mm);
    position.y += 0.5F * scale_ * (1.0F - fitted) * text_height_mm(kNoteInk.style);
    for_each_run(from, to, [&](std::string_view run) {
      canvas.text(position, kNoteInk.style, kNoteInk.color, run, Align::Left, fitted * scale_);
      position.x += fitted * (width_mm(run) + gap_mm_);
    });
  }

 private:
  float width_mm(std::string_view run) const { return canvas_->text_width_mm(kNoteInk.style, run, scale_); }

  // Calls `use` with the facts before the text's line break, and with those after it.
  template <class Use>
  void for_each_run(std::size_t from, std::size_t to, const Use& use) const {
    while (from < to) {
      const std::size_t end = from < broken_ ? std::min(broken_, to) : to;
      use(std::string_view(notes_[from].begin(), notes_[end - 1].end()));
      from = end;
    }
  }

  // Reduction of a line, so that no word is cut.
  float fit(std::size_t from, std::size_t to, float room_mm) const {
    float width = from < to ? -gap_mm_ : 0.0F;
    for_each_run(from, to, [&](std::string_view run) { width += width_mm(run) + gap_mm_; });
    return std::min(1.0F, room_mm / std::max(width, 1.0F));
  }

  const Canvas* canvas_;
  float scale_, gap_mm_;
  std::array<std::string_view, 16> notes_;
  std::size_t count_ = 0, first_line_ = 0, broken_ = 0;
};

}  // namespace

void paint(Canvas& canvas, const DataPanel& panel) {
  canvas.panel_background();
  const float width = canvas.size_mm().x - 2.0F * kMargin;
  const bool text = !panel.rows.empty() && std::all_of(panel.rows.begin(), panel.rows.end(), is_words);
  const float text_size = text ? text_scale(canvas, panel) : 1.0F;
  const float scale = text ? header_scale(text_size) : table_scale(canvas, panel);
  paint_title(canvas, {kMargin, scale * 24.0F}, panel.title, width, scale);
  shrunk_text(canvas, {kMargin, scale * 92.0F}, {TextStyle::Body, palette::kYellow}, panel.subtitle, width, scale);
  const float top = scale * kHeader;
  canvas.line({kMargin, top}, {kMargin + width, top}, 2.0F, palette::kEdge);
  if (panel.rows.empty()) {
    return;
  }
  const float room = canvas.size_mm().y - top - (text ? text_size : 1.0F) * kBelowRows;
  if (text) return paint_text(canvas, panel, top, room, text_size);
  const float largest = largest_row(canvas, panel);
  float at = top;
  for (const DataRow& row : panel.rows) {
    const float height = row_height_mm(panel, row, room);
    is_words(row) ? paint_words(canvas, row.name, at, height)
                  : paint_row(canvas, row, shown_source(panel, row), at, height, largest);
    at += height;
  }
}

void paint(Canvas& canvas, const Banner& banner) {
  canvas.panel_background();
  // an optional second line of the scale
  const bool two_lines = banner.scale.find('\n') != std::string::npos;
  const float third = two_lines ? text_height_mm(TextStyle::Body) + 8.0F : 0.0F;
  constexpr float kGap = 16.0F, kLeast = 8.0F;  // gap between the lines; smallest gap there and to the edges
  const float content = text_height_mm(TextStyle::Guidance) + kGap + text_height_mm(TextStyle::Body) + third;
  const float spare = canvas.size_mm().y - content;
  const float top = std::max(kLeast, 0.5F * spare);
  const float right = canvas.size_mm().x - kMargin;
  const Plate state =
      banner.state_word.empty() ? Plate{{right, top}, {right, top}} : paint_state(canvas, banner, right, top + 2.0F);
  const float room = state.from.x - kMargin - 24.0F;
  const float scale = std::min(1.0F, room / std::max(canvas.text_width_mm(TextStyle::Guidance, banner.guidance), 1.0F));
  const float lift = 0.5F * (1.0F - scale) * text_height_mm(TextStyle::Guidance);
  canvas.text({kMargin, top + lift}, TextStyle::Guidance, palette::kInk, banner.guidance, Align::Left, scale);

  const float second = top + text_height_mm(TextStyle::Guidance) + std::clamp(kGap + spare, kLeast, kGap);
  // the lines below shrink to make room for the guidance
  const float left = canvas.size_mm().y - kLeast - second;
  const float lower = std::clamp(left / (text_height_mm(TextStyle::Body) + third), 0.1F, 1.0F);
  const bool beside_state = state.to.y > second;  // true: the enlarged state reaches down to these lines
  const float end_mm = beside_state ? state.from.x - 24.0F : right;
  const float whole = end_mm - kMargin;
  // a warning comes before the scales, and is complete on the narrowest banner
  constexpr float kTriangleMm = 60.0F, kLeastForScales = 0.3F;  // share of the line
  float warned = 0.0F;
  if (!banner.warning.empty()) {
    const float full = canvas.text_width_mm(TextStyle::Body, banner.warning, lower);
    const float fit = std::min(1.0F, std::max(1.0F, whole - kTriangleMm) / full);
    const float width = fit * full, sink = 0.5F * lower * (1.0F - fit) * text_height_mm(TextStyle::Body);
    paint_shape(canvas, StateShape::Triangle, {end_mm - width - 30.0F, second + 21.0F * lower}, 17.0F * lower,
                palette::kOrange);
    canvas.text({end_mm, second + sink}, TextStyle::Body, palette::kOrange, banner.warning, Align::Right, fit * lower);
    warned = width + 70.0F;
  }
  Notes notes(canvas, banner.scale, lower);
  if (whole - warned > kLeastForScales * whole) {
    notes.balance(whole - warned, two_lines ? whole : 0.0F);
    notes.paint(canvas, {kMargin, second}, 0, notes.first_line(), whole - warned);
  }
  notes.paint(canvas, {kMargin, second + lower * third}, notes.first_line(), notes.count(), whole);
}

void paint(Canvas& canvas, const Label& label) {
  canvas.panel_background(label.highlighted ? palette::kOrange : palette::kEdge, label.highlighted ? 5.0F : 2.0F);
  const glm::vec2 size = canvas.size_mm();
  const float margin = std::clamp(0.03F * size.x, 12.0F, 24.0F);  // margin beside the text
  const float by_height = 0.66F * size.y / text_height_mm(TextStyle::Guidance);
  const float by_width =
      (size.x - 2.0F * margin) / std::max(canvas.text_width_mm(TextStyle::Guidance, label.text), 1.0F);
  const float scale = std::min({by_height, by_width, 1.0F});
  const float height = scale * text_height_mm(TextStyle::Guidance);
  canvas.text({0.5F * size.x, 0.5F * (size.y - height)}, TextStyle::Guidance,
              label.highlighted ? palette::kYellow : palette::kInk, label.text, Align::Center, scale);
}

}  // namespace afm::render
