// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/imaging/height_grid.h"
#include "physics/imaging/tip_shape.h"

// What a tip makes of a surface, and what an image reveals of both: Villarrubia, J. Res. NIST 102, 425 (1997). With
// T(u) the height of the tip's material above its apex at u beside it:
//
//   image           I(x) = max_u [s(x + u) - T(u)]          the height at which the tip, coming down, touches
//   reconstruction  r(x) = min_u [I(x - u) + T(u)] >= s(x)  the highest surface with this image
//
// Villarrubia's P is the reflected tip, P(d) = -T(-d): the image of an ideal spike.
//
// - What lies outside of the grid does not exist: it neither touches nor is touched.
// - dilate() and erode() are adjoint: dilate(s) <= I exactly where s <= erode(I). So erode(dilate(s)) >= s, and doing
//   it again changes nothing. On whole numbers they are exact.
// - Grids and tips must have the same steps.
namespace afm::physics {

HeightGrid dilate(const HeightGrid& surface, const TipGrid& tip);
HeightGrid erode(const HeightGrid& image, const TipGrid& tip);

// The same by a paraboloid of that radius and without limits of its size, in two passes along lines, each by the
// envelope of parabolas (Felzenszwalb & Huttenlocher, Theory Comput. 8, 415 (2012)): O(points), whatever the radius.
void dilate_by_paraboloid(HeightGrid& surface, Length radius);
void erode_by_paraboloid(HeightGrid& image, Length radius);

// By the method that suits the tip.
HeightGrid image_of(const HeightGrid& surface, const TipShape& tip);
HeightGrid reconstruction_of(const HeightGrid& image, const TipShape& tip);

// 1 where the reconstruction is the surface for certain: where, for some place of the tip, it touches there and nowhere
// else, to within `tolerance_m`. 0 elsewhere. Places of the tip are left out whose material beyond the border, as far
// up as the highest of the surface, might touch what is not in the image.
std::vector<std::uint8_t> certainty_map(const HeightGrid& image, const HeightGrid& reconstruction, const TipGrid& tip,
                                        double tolerance_m);

// The bluntest tip of that reach which could have taken the image: nowhere below the true one. `threshold_m`: what the
// image's noise may add; 0 for none. Beyond the sample's relief the image reveals nothing: there the tip is as high as
// the relief at most. Places nearer than twice the reach to the border are not looked at.
// Time: pixels times the window's size, or little more; allocates.
TipGrid tip_of_image(const HeightGrid& image, std::size_t reach_columns, std::size_t reach_rows, double threshold_m);

}  // namespace afm::physics
