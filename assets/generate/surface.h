// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "exact_math.h"

// Building closed, outward-wound triangle surfaces with the normals that bevels and round parts need.
namespace afm::generate {

struct SurfaceVertex {
  V3 position;
  V3 normal;
  V3 color{1, 1, 1};  // linear, multiplied by the material's colour
  double alpha = 1;   // coverage, multiplied by the material's
};

// Diagonals of quads: all alike, or the more level one of each, so that the edge of a step runs smoothly across them.
enum class Cut { Alike, Level };

struct Surface {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;

  std::uint32_t add(const SurfaceVertex& vertex);
  // Adds a triangle, counter-clockwise as seen from outside; omits one without area.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  // Quads between rows x columns vertices; the outside is where (next column - here) x (next row - here) points.
  void add_grid(std::size_t rows, std::size_t columns,
                const std::function<SurfaceVertex(std::size_t row, std::size_t column)>& at, Cut cut = Cut::Alike);
  void paint(V3 color);
};

// A closed curve in a plane, counter-clockwise, with its outward unit normals.
struct OutlinePoint {
  V2 position;
  V2 normal;
};
using Outline = std::vector<OutlinePoint>;

// A circle of 4 x 2^halvings points.
Outline circle(double radius, int halvings);

// A convex counter-clockwise polygon whose corners become arcs of `radius` in 2^halvings pieces.
Outline rounded_polygon(const std::vector<V2>& corners, double radius, int halvings);
Outline rounded_rectangle(V2 low, V2 high, double radius, int halvings);

// A curve parallel to the outline, `distance` nearer to its middle; no arc may be smaller than that.
Outline inset(const Outline& outline, double distance);

// One level of a loft: an outline at height z; the surface's normal there leans `out` outwards and `up` upwards.
struct Section {
  Outline outline;
  double height = 0;
  double out = 1;
  double up = 0;
};

// The skin through sections of equally many points, in the order of growing distance along the skin from the bottom to
// the top. Two sections at one place with different normals make a hard edge.
void add_loft(Surface& surface, const std::vector<Section>& sections);

enum class Facing { Up, Down };
// Adds the area inside a convex outline.
void add_cap(Surface& surface, const Outline& outline, double height, Facing facing);

// A solid of revolution about z: the profile's outlines are circles of these radii.
struct ProfilePoint {
  double radius = 0;
  double height = 0;
  double out = 1;
  double up = 0;
};
void add_lathe(Surface& surface, const std::vector<ProfilePoint>& profile, int halvings);

// A closed prism from z = low to high whose edges are bevelled by `bevel`, with normals that make the bevel look round.
void add_prism(Surface& surface, const Outline& outline, double low, double high, double bevel);

// A shell around a solid between two outlines of equally many points, `width` off it, without a top and wound inwards:
// seen from above, or along z, only a rim around the solid shows. Its outlines may be coarser than the solid's.
Surface outline_of(const Outline& foot, double low, const Outline& rim, double high, double width);

// Pose of a part: its axes (orthonormal, right-handed) and origin in the frame that it is put into.
struct Placement {
  V3 origin;
  V3 x{1, 0, 0};
  V3 y{0, 1, 0};
  V3 z{0, 0, 1};

  V3 direction(V3 v) const { return x * v.x + y * v.y + z * v.z; }
};
void add_placed(Surface& surface, const Surface& part, const Placement& placement);

// Placement of a frame with z upwards in one with y upwards.
inline constexpr Placement kYUpFromZUp{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};

}  // namespace afm::generate
