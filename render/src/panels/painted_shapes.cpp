// SPDX-License-Identifier: Apache-2.0
#include "panels/painted_shapes.h"

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>

namespace afm::render {
namespace {

bool same(const ImVec4& a, const ImVec4& b) { return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w; }

bool same(const ImDrawVert& a, const ImDrawVert& b) {
  return a.pos.x == b.pos.x && a.pos.y == b.pos.y && a.uv.x == b.uv.x && a.uv.y == b.uv.y && a.col == b.col;
}

// Number of corners at the beginning that belong to equal triangles.
template <class It>
std::ptrdiff_t equal_from(const It& a, const It& a_end, const It& b, const It& b_end) {
  const std::ptrdiff_t equal =
      std::mismatch(a, a_end, b, b_end, [](const ImDrawVert& v, const ImDrawVert& w) { return same(v, w); }).first - a;
  return equal / 3 * 3;
}

void widen(CanvasBox& box, std::span<const ImDrawVert> corners, const ImVec4& clip) {
  const glm::vec2 least(clip.x, clip.y), largest(clip.z, clip.w);
  for (const ImDrawVert& corner : corners) {
    const glm::vec2 place = glm::clamp(glm::vec2(corner.pos.x, corner.pos.y), least, largest);
    const bool first = box.high.x <= box.low.x && box.high.y <= box.low.y;
    box.low = first ? place : glm::min(box.low, place);
    box.high = first ? place + 1e-3F : glm::max(box.high, place);
  }
}

}  // namespace

void PaintedShapes::clear() {
  corners_.clear();
  groups_.clear();
}

void PaintedShapes::add(const ImDrawList& list) {
  for (const ImDrawCmd& command : list.CmdBuffer) {
    for (unsigned int i = 0; i < command.ElemCount; ++i) {
      const auto index = static_cast<unsigned int>(list.IdxBuffer[static_cast<int>(command.IdxOffset + i)]);
      corners_.push_back(list.VtxBuffer[static_cast<int>(command.VtxOffset + index)]);
    }
    groups_.push_back({command.ClipRect, corners_.size()});
  }
}

std::span<const ImDrawVert> PaintedShapes::corners_of(std::size_t group) const {
  const std::size_t begin = group == 0 ? 0 : groups_[group - 1].end;
  return std::span(corners_).subspan(begin, groups_[group].end - begin);
}

std::optional<CanvasBox> PaintedShapes::difference(const PaintedShapes& other) const {
  if (groups_.size() != other.groups_.size()) return std::nullopt;
  CanvasBox box;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const ImVec4& clip = groups_[i].clip;
    if (!same(clip, other.groups_[i].clip)) return std::nullopt;
    std::span<const ImDrawVert> a = corners_of(i), b = other.corners_of(i);
    const auto before = static_cast<std::size_t>(equal_from(a.begin(), a.end(), b.begin(), b.end()));
    a = a.subspan(before);
    b = b.subspan(before);
    const auto behind = static_cast<std::size_t>(equal_from(a.rbegin(), a.rend(), b.rbegin(), b.rend()));
    widen(box, a.first(a.size() - behind), clip);
    widen(box, b.first(b.size() - behind), clip);
  }
  return box;
}

}  // namespace afm::render
