// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

// Blending of screens that overlap in one plane: pure arithmetic.
namespace afm::scene {

enum class ScreenEdge { Left, Top, Right, Bottom };
inline constexpr std::array<std::string_view, 4> kScreenEdgeNames{"left", "top", "right", "bottom"};  // in that order

// Part of a screen in which its picture fades out towards an edge: a smooth ramp, dark from the edge to where it
// begins. Without width there is none.
struct EdgeRamp {
  double begin_m = 0;  // from the edge
  double width_m = 0;

  bool operator==(const EdgeRamp&) const = default;
};

// Overlap of a screen with others of its plane.
struct ScreenBlend {
  std::array<EdgeRamp, kScreenEdgeNames.size()> ramps{};  // by ScreenEdge
  std::vector<std::size_t> neighbours{};                  // of Wall::screens, that overlap it
  glm::dvec3 origin{0.0};                                 // a place that all screens of the overlap have in common

  const EdgeRamp& ramp(ScreenEdge edge) const { return ramps[static_cast<std::size_t>(edge)]; }
};

// Blending of an output's picture: what it shows so that it and its neighbours together show what one projector would,
// black everywhere as bright as where most of them overlap. Immutable, in unit coordinates of the picture from its
// upper left corner. compose.frag has the same arithmetic, and a test compares the two.
struct Blend {
  static constexpr std::size_t kMostScreens = 9;

  // A screen. Its picture fades out in the ramps and ends at the box.
  struct Field {
    glm::dvec2 low{0.0}, high{1.0};
    std::array<double, kScreenEdgeNames.size()> begin{};  // of the ramps, inwards from the edges; by ScreenEdge
    std::array<double, kScreenEdgeNames.size()> width{};  // 0: no ramp
    double black = 0;                                     // light of the projector's black, 1 for its white
  };
  std::vector<Field> fields{};    // the output's own first; at most kMostScreens
  std::optional<double> gamma{};  // light of an encoded value: its power; nothing: sRGB's curve
  double brightest_black = 0;     // of the whole overlap, of all projectors of a place together
  double darkest_black = 0;       // likewise

  // At a place within the picture.
  struct Place {
    double own = 0;    // weight of this output
    double all = 0;    // of all that reach the place
    double black = 0;  // light that their black leaves
  };
  Place at(const glm::dvec2& picture) const;
};

}  // namespace afm::scene
