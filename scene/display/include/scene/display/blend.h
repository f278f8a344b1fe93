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
inline constexpr std::array<std::string_view, 4> kScreenEdgeNames{"left", "top", "right", "bottom"};  // by ScreenEdge

// Part of a screen in which its picture fades out towards an edge: a smooth ramp, dark from the edge to `begin_m`. Zero
// width means no ramp.
struct EdgeRamp {
  double begin_m = 0;  // distance from the edge to the ramp, in metres
  double width_m = 0;

  bool operator==(const EdgeRamp&) const = default;
};

// Overlap of a screen with others in its plane.
struct ScreenBlend {
  std::array<EdgeRamp, kScreenEdgeNames.size()> ramps{};  // indexed by ScreenEdge
  std::vector<std::size_t> neighbours{};                  // indices into Wall::screens of the overlapping screens
  glm::dvec3 origin{0.0};                                 // reference point shared by all screens of the overlap

  const EdgeRamp& ramp(ScreenEdge edge) const { return ramps[static_cast<std::size_t>(edge)]; }
};

// Blending of an output's picture, so that it and its neighbours together look like the picture of one projector, with
// black as bright everywhere as where most of them overlap. Immutable, in unit coordinates of the picture from its
// upper left corner. compose.frag has the same arithmetic, and a test compares the two.
struct Blend {
  static constexpr std::size_t kMostScreens = 9;

  // Screen whose picture fades out in the ramps and ends at the box.
  struct Field {
    glm::dvec2 low{0.0}, high{1.0};
    std::array<double, kScreenEdgeNames.size()> begin{};  // ramp starts, inwards from the edges; indexed by ScreenEdge
    std::array<double, kScreenEdgeNames.size()> width{};  // widths of the ramps; 0: no ramp
    double black = 0;                                     // luminance of the projector's black, relative to its white
  };
  std::vector<Field> fields{};    // the output's own screen first; at most kMostScreens
  std::optional<double> gamma{};  // exponent from encoded value to light; none: sRGB curve
  double brightest_black = 0;     // largest sum of the projectors' blacks at any point of the overlap
  double darkest_black = 0;       // smallest sum of the projectors' blacks at any point of the overlap

  // Values at a point of the picture.
  struct Place {
    double own = 0;    // weight of this output
    double all = 0;    // total weight of all outputs that reach the point
    double black = 0;  // luminance of their combined black
  };
  Place at(const glm::dvec2& picture) const;
};

}  // namespace afm::scene
