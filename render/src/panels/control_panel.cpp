// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>

#include "panels/panel_painting.h"
#include "render/control_layout.h"

namespace afm::render {
namespace {

constexpr double kControlMargin = 28.0;
constexpr double kTop = 124.0;  // top of the rows, below the title and the buttons beside it
constexpr double kTallestRow = 104.0;
constexpr double kTargetWidth = 88.0;
constexpr double kButtonWidth = 165.0;
constexpr double kGap = 10.0;
constexpr double kNoteHeight = 41.0;
constexpr double kBelowNotes = 16.0;  // distance from the notes to the rounded edge
constexpr float kValueScale = 0.8F;
constexpr double kTwoLines = 80.0;  // lowest row with its value below its name
constexpr float kShareOfName = 0.55F;
constexpr float kNextToName = 12.0F;
constexpr double kBesidePicture = 190.0;  // room for the bar with its values
constexpr double kBarWidth = 30.0;
constexpr double kSmallestPicture = 1.0;

// Distance between rows in the height that the notes leave.
double row_pitch(const ControlPanel& panel, double height_mm) {
  const double notes = kNoteHeight * static_cast<double>(panel.notes.size() + 1) + kGap + kBelowNotes;
  const double rows = static_cast<double>(std::max<std::size_t>(panel.rows.size(), 1));
  return std::clamp((height_mm - kTop - notes) / rows, 1.0, kTallestRow);
}

double end_of_notes(const ControlPanel& panel, const glm::dvec2& size_mm) {
  const double rows = row_pitch(panel, size_mm.y) * static_cast<double>(panel.rows.size());
  return kTop + rows + kGap + kNoteHeight * static_cast<double>(panel.notes.size() + 1);
}

bool holds(const ControlBox& box, const glm::dvec2& point_mm) {
  return point_mm.x >= box.from_mm.x && point_mm.x < box.to_mm.x && point_mm.y >= box.from_mm.y &&
         point_mm.y < box.to_mm.y;
}

glm::vec2 f(const glm::dvec2& v) { return glm::vec2(v); }

// Draws a target, bright while pointed at, with a sign or a word in its centre.
void paint_target(Canvas& canvas, const ControlBox& box, std::string_view text, bool pointed) {
  const Color panel_background = pointed ? palette::kOrange : Color{palette::kSkyBlue.srgb, 0.22F};
  canvas.rectangle(f(box.from_mm), f(box.to_mm), panel_background, 12.0F);
  canvas.outline(f(box.from_mm), f(box.to_mm), 2.5F, palette::kSkyBlue, 12.0F);
  const glm::vec2 middle = f(0.5 * (box.from_mm + box.to_mm));
  const float height = text_height_mm(TextStyle::Title);
  const float width = static_cast<float>(box.to_mm.x - box.from_mm.x) - 16.0F;
  const float scale = std::min(1.0F, width / std::max(canvas.text_width_mm(TextStyle::Title, text), 1.0F));
  canvas.text({middle.x, middle.y - 0.5F * scale * height}, TextStyle::Title, pointed ? palette::kPlate : palette::kInk,
              text, Align::Center, scale);
}

void paint_row(Canvas& canvas, const ControlPanel& panel, std::size_t row, double top, double pitch) {
  const ControlRow& content = panel.rows[row];
  const glm::dvec2 size(canvas.size_mm());
  const auto room = static_cast<float>(size.x - 2.0 * kControlMargin - 2.0 * kTargetWidth - 2.0 * kGap);
  const auto y = static_cast<float>(top + 0.5 * (pitch - 84.0));
  if (panel.marked == row) {
    const glm::vec2 corner(0.5F * static_cast<float>(kControlMargin), static_cast<float>(top + 0.25 * kGap));
    const glm::vec2 extent(static_cast<float>(size.x) - 2.0F * corner.x, static_cast<float>(pitch - 0.5 * kGap));
    canvas.rectangle(corner, corner + extent, Color{palette::kYellow.srgb, 0.10F}, 12.0F);
    canvas.outline(corner, corner + extent, 3.0F, palette::kYellow, 12.0F);
  }
  const bool beside = pitch < kTwoLines;
  const float for_name = beside ? kShareOfName * room : room, for_value = beside ? room - for_name : room;
  const float scale =
      std::min(kValueScale, for_value / std::max(canvas.text_width_mm(TextStyle::Title, content.value), 1.0F));
  const Color color = content.changed ? palette::kOrange : palette::kInk;
  const auto middle = static_cast<float>(top + 0.5 * pitch);
  const auto left = static_cast<float>(kControlMargin);
  if (beside) {
    const float name_top = middle - 0.5F * text_height_mm(TextStyle::Body);
    canvas.shrunk_text({left, name_top}, TextStyle::Body, palette::kMuted, content.name, for_name - kNextToName);
    const float value_top = middle - 0.5F * scale * text_height_mm(TextStyle::Title);
    canvas.text({left + room, value_top}, TextStyle::Title, color, content.value, Align::Right, scale);
  } else {
    canvas.shrunk_text({left, y}, TextStyle::Body, palette::kMuted, content.name, room);
    canvas.text({left, y + 36.0F}, TextStyle::Title, color, content.value, Align::Left, scale);
  }
  for (const auto kind : {ControlTarget::Kind::Less, ControlTarget::Kind::More}) {
    const ControlTarget target{kind, row};
    paint_target(canvas, control_box(panel, size, target), kind == ControlTarget::Kind::Less ? "\u2212" : "+",
                 panel.pointed == target);
  }
}

}  // namespace

ControlBox picture_box(const ControlPanel& panel, const glm::dvec2& size_mm) {
  const glm::dvec2 from(kControlMargin, end_of_notes(panel, size_mm) + kNoteHeight);  // place below the picture's title
  const glm::dvec2 room = glm::max(size_mm - from - glm::dvec2(kControlMargin + kBesidePicture, kControlMargin),
                                   glm::dvec2(kSmallestPicture));
  const double width = std::min(room.x, room.y * panel.picture->aspect);
  return {from, from + glm::dvec2(width, width / panel.picture->aspect)};
}

ControlBox control_box(const ControlPanel& panel, const glm::dvec2& size_mm, const ControlTarget& target) {
  if (target.kind == ControlTarget::Kind::Pixel) {
    const MapPicture& picture = *panel.picture;
    const ControlBox box = picture_box(panel, size_mm);
    const glm::dvec2 pixel = (box.to_mm - box.from_mm) / glm::dvec2(picture.columns, picture.rows);
    const glm::dvec2 at(target.index % picture.columns, target.index / picture.columns);
    return {box.from_mm + at * pixel, box.from_mm + (at + 1.0) * pixel};
  }
  if (target.kind == ControlTarget::Kind::Button) {
    const auto from_right = static_cast<double>(panel.buttons.size() - target.index);
    const double left = size_mm.x - kControlMargin + kGap - from_right * (kButtonWidth + kGap);
    return {{left, 2.0 * kGap}, {left + kButtonWidth, kTop - kGap}};
  }
  const double pitch = row_pitch(panel, size_mm.y);
  const double top = kTop + pitch * static_cast<double>(target.index) + 0.5 * kGap;
  const double right =
      size_mm.x - kControlMargin - (target.kind == ControlTarget::Kind::Less ? kTargetWidth + kGap : 0.0);
  return {{right - kTargetWidth, top}, {right, top + pitch - kGap}};
}

std::optional<ControlTarget> control_at(const ControlPanel& panel, const glm::dvec2& size_mm,
                                        const glm::dvec2& point_mm) {
  const auto hit = [&](const ControlTarget& target) { return holds(control_box(panel, size_mm, target), point_mm); };
  for (std::size_t row = 0; row < panel.rows.size(); ++row) {
    for (const auto kind : {ControlTarget::Kind::Less, ControlTarget::Kind::More}) {
      if (hit({kind, row})) return ControlTarget{kind, row};
    }
  }
  for (std::size_t button = 0; button < panel.buttons.size(); ++button) {
    const ControlTarget target{ControlTarget::Kind::Button, button};
    if (hit(target)) return target;
  }
  if (!panel.picture) return std::nullopt;
  const ControlBox box = picture_box(panel, size_mm);
  if (!holds(box, point_mm)) return std::nullopt;
  const std::size_t columns = panel.picture->columns, rows = panel.picture->rows;
  const glm::dvec2 share = (point_mm - box.from_mm) / (box.to_mm - box.from_mm);
  const auto at = [](double part, std::size_t count) {
    return std::min(static_cast<std::size_t>(part * static_cast<double>(count)), count - 1);
  };
  return ControlTarget{ControlTarget::Kind::Pixel, at(share.y, rows) * columns + at(share.x, columns)};
}

namespace {

// Draws a frame around a pixel, visible however small the pixel is.
void frame_pixel(Canvas& canvas, const ControlPanel& panel, std::size_t index, Color color) {
  constexpr double kSmallestFrame = 9.0;
  const ControlBox box = control_box(panel, glm::dvec2(canvas.size_mm()), {ControlTarget::Kind::Pixel, index});
  const glm::dvec2 middle = 0.5 * (box.from_mm + box.to_mm);
  const glm::dvec2 half = glm::max(0.5 * (box.to_mm - box.from_mm), glm::dvec2(kSmallestFrame));
  canvas.outline(f(middle - half), f(middle + half), 4.0F, color);
}

// Draws the bar of colours, from the highest value at the top to the lowest.
void paint_bar(Canvas& canvas, const MapPicture& picture, const glm::dvec2& from, double height) {
  if (picture.bar.size() < 2) return;
  ColorGrid grid{.columns = 2, .rows = static_cast<std::uint32_t>(picture.bar.size()), .colors = {}};
  const auto byte = [](float share) { return static_cast<std::uint8_t>(std::lround(255.0F * share)); };
  for (auto c = picture.bar.rbegin(); c != picture.bar.rend(); ++c) {
    grid.colors.insert(grid.colors.end(), 2, {byte(c->r), byte(c->g), byte(c->b), 255});
  }
  const glm::dvec2 to = from + glm::dvec2(kBarWidth, height);
  canvas.grid(f(from), f(to), grid);
  canvas.outline(f(from), f(to), 2.0F, palette::kAxis);
  const auto left = static_cast<float>(to.x + kGap), bottom = static_cast<float>(to.y);
  const auto width = static_cast<float>(kBesidePicture - kBarWidth - 2.0 * kGap);
  const float em = text_height_mm(TextStyle::Small);
  canvas.shrunk_text({left, static_cast<float>(from.y)}, TextStyle::Small, palette::kMuted, picture.highest, width);
  canvas.shrunk_text({left, bottom - em}, TextStyle::Small, palette::kMuted, picture.lowest, width);
}

void paint_picture(Canvas& canvas, const ControlPanel& panel) {
  const MapPicture& picture = *panel.picture;
  const glm::dvec2 size(canvas.size_mm());
  const ControlBox box = picture_box(panel, size);
  const auto width = static_cast<float>(size.x - 2.0 * kControlMargin);
  canvas.shrunk_text(f(box.from_mm - glm::dvec2(0.0, kNoteHeight)), TextStyle::Small, palette::kMuted, picture.title,
                     width);
  canvas.push_clip(f(box.from_mm), f(box.to_mm));
  canvas.grid(f(box.from_mm), f(box.to_mm), picture.grid);
  canvas.pop_clip();
  canvas.outline(f(box.from_mm), f(box.to_mm), 2.0F, palette::kAxis);
  frame_pixel(canvas, panel, picture.marked, palette::kSkyBlue);
  if (panel.pointed && panel.pointed->kind == ControlTarget::Kind::Pixel) {
    frame_pixel(canvas, panel, panel.pointed->index, palette::kInk);
  }
  paint_bar(canvas, picture, {box.to_mm.x + kGap, box.from_mm.y}, box.to_mm.y - box.from_mm.y);
}

}  // namespace

void paint(Canvas& canvas, const ControlPanel& panel) {
  canvas.panel_background();
  const glm::dvec2 size(canvas.size_mm());
  const auto width = static_cast<float>(size.x - 2.0 * kControlMargin);
  const float beside = static_cast<float>(static_cast<double>(panel.buttons.size()) * (kButtonWidth + kGap));
  canvas.shrunk_text({kControlMargin, 34.0F}, TextStyle::Title, palette::kInk, panel.title, width - beside);
  const double pitch = row_pitch(panel, size.y);
  for (std::size_t row = 0; row < panel.rows.size(); ++row) {
    paint_row(canvas, panel, row, kTop + pitch * static_cast<double>(row), pitch);
  }
  double y = kTop + pitch * static_cast<double>(panel.rows.size()) + kGap;
  canvas.shrunk_text({kControlMargin, static_cast<float>(y)}, TextStyle::Body, palette::kYellow, panel.status, width);
  for (const std::string& note : panel.notes) {
    y += kNoteHeight;
    canvas.shrunk_text({kControlMargin, static_cast<float>(y)}, TextStyle::Body, palette::kInk, note, width);
  }
  for (std::size_t button = 0; button < panel.buttons.size(); ++button) {
    const ControlTarget target{ControlTarget::Kind::Button, button};
    paint_target(canvas, control_box(panel, size, target), panel.buttons[button], panel.pointed == target);
  }
  if (panel.picture) paint_picture(canvas, panel);
}

}  // namespace afm::render
