// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "panels/panel_painting.h"

namespace afm::render {
namespace {

constexpr float kHeadMm = 120.0F;
constexpr float kLineShare = 1.3F;     // distance of two rows, in heights of their letters
constexpr float kNameGapMm = 40.0F;    // between name and value
constexpr float kColumnGapMm = 80.0F;  // between two columns
constexpr std::size_t kMostColumns = 3;
constexpr float kLeastShare = 0.75F;  // smallest size of a long row, relative to the others

struct Columns {
  std::size_t count = 1;
  std::size_t rows = 0;  // rows of the longest column
  float width_mm = 0.0F;
  float scale = 0.0F;  // size of the letters
};

float row_width_mm(const Canvas& canvas, const DataRow& row) {
  return canvas.text_width_mm(TextStyle::Guidance, row.name) + kNameGapMm +
         canvas.text_width_mm(TextStyle::Guidance, row.value);
}

// Columns with the largest possible letters, up to the size of the guidance.
Columns columns_of(const Canvas& canvas, const DataPanel& list) {
  float widest = 1.0F;
  for (const DataRow& row : list.rows) widest = std::max(widest, row_width_mm(canvas, row));
  const float width = canvas.size_mm().x - 2.0F * kMargin, height = canvas.size_mm().y - kHeadMm - kMargin;
  Columns best;
  for (std::size_t count = 1; count <= kMostColumns; ++count) {
    Columns columns{.count = count, .rows = (list.rows.size() + count - 1) / count};
    columns.width_mm = (width - static_cast<float>(count - 1) * kColumnGapMm) / static_cast<float>(count);
    const float by_height =
        height / (static_cast<float>(columns.rows) * kLineShare * text_height_mm(TextStyle::Guidance));
    columns.scale = std::min({1.0F, by_height, columns.width_mm / (kLeastShare * widest)});
    if (columns.scale > best.scale) best = columns;
  }
  return best;
}

void paint_list_row(Canvas& canvas, const DataRow& row, glm::vec2 at, const Columns& columns, float pitch) {
  const float scale = std::min(columns.scale, columns.width_mm / row_width_mm(canvas, row));
  const float top = at.y + 0.5F * (pitch - scale * text_height_mm(TextStyle::Guidance));
  canvas.text({at.x, top}, TextStyle::Guidance, palette::kMuted, row.name, Align::Left, scale);
  canvas.text({at.x + columns.width_mm, top}, TextStyle::Guidance, palette::kInk, row.value, Align::Right, scale);
  canvas.line({at.x, at.y + pitch}, {at.x + columns.width_mm, at.y + pitch}, 1.5F, palette::kGrid);
}

}  // namespace

void paint(Canvas& canvas, const ListPanel& panel) {
  const DataPanel& list = panel.list;
  // two plates, so that the scene behind does not disturb the letters
  canvas.panel_background();
  canvas.panel_background();
  const float width = canvas.size_mm().x - 2.0F * kMargin;
  const float subtitle = canvas.text_width_mm(TextStyle::Body, list.subtitle);
  canvas.shrunk_text({kMargin, 26.0F}, TextStyle::Title, palette::kInk, list.title,
                     std::max(1.0F, width - subtitle - kNameGapMm));
  canvas.text({kMargin + width, 40.0F}, TextStyle::Body, palette::kYellow, list.subtitle, Align::Right);
  canvas.line({kMargin, kHeadMm - 10.0F}, {kMargin + width, kHeadMm - 10.0F}, 2.0F, palette::kEdge);
  if (list.rows.empty()) return;
  const Columns columns = columns_of(canvas, list);
  const float pitch = std::min((canvas.size_mm().y - kHeadMm - kMargin) / static_cast<float>(columns.rows),
                               1.6F * columns.scale * text_height_mm(TextStyle::Guidance));
  for (std::size_t i = 0; i < list.rows.size(); ++i) {
    const std::size_t column = i / columns.rows, row = i % columns.rows;
    paint_list_row(canvas, list.rows[i],
                   {kMargin + static_cast<float>(column) * (columns.width_mm + kColumnGapMm),
                    kHeadMm + static_cast<float>(row) * pitch},
                   columns, pitch);
  }
}

}  // namespace afm::render
