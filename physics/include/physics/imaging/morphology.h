// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/imaging/height_grid.h"
#include "physics/imaging/tip_shape.h"

// Image of a surface by a tip, and estimates of both from an image: Villarrubia, J. Res. NIST 102, 425 (1997). With
// T(u) the height of the tip's surface above its apex at the lateral position u:
//
//   image           I(x) = max_u [s(x + u) - T(u)]          the height at which the descending tip touches
//   reconstruction  r(x) = min_u [I(x - u) + T(u)] >= s(x)  the highest surface with this image
//
// Villarrubia's P is the reflected tip, P(d) = -T(-d): the image of an ideal spike.
//
// - Nothing exists outside of the grid: it neither touches nor is touched.
// - dilate() and erode() are adjoint: dilate(s) <= I exactly where s <= erode(I). So erode(dilate(s)) >= s, and
//   repeating it changes nothing. On integers they are exact.
// - Grids and tips must have the same steps.
namespace afm::physics {

HeightGrid dilate(const HeightGrid& surface, const TipGrid& tip);
HeightGrid erode(const HeightGrid& image, const TipGrid& tip);

// Dilation and erosion by a paraboloid of unlimited size, in two passes along lines, each by the envelope of
// parabolas (Felzenszwalb & Huttenlocher, Theory Comput. 8, 415 (2012)): O(points) for any radius.
void dilate_by_paraboloid(HeightGrid& surface, Length radius);
void erode_by_paraboloid(HeightGrid& image, Length radius);

// Uses the method that suits the tip.
HeightGrid image_of(const HeightGrid& surface, const TipShape& tip);
HeightGrid reconstruction_of(const HeightGrid& image, const TipShape& tip);

// 1 where the reconstruction is certainly the surface: where, for some position of the tip, it touches there and
// nowhere else, to within `tolerance_m`. 0 elsewhere. Ignores positions of the tip whose part outside the image might
// touch a surface as high as the highest of the image.
std::vector<std::uint8_t> certainty_map(const HeightGrid& image, const HeightGrid& reconstruction, const TipGrid& tip,
                                        double tolerance_m);

// The bluntest tip of that reach that could have taken the image: nowhere below the true one. `threshold_m`: allowance
// for the image's noise; 0 for none. The image contains no information beyond the sample's relief, so the tip is at
// most as high as the relief. Ignores positions closer to the border than twice the reach. Time: pixels times the
// window's size, or little more; allocates.
TipGrid tip_of_image(const HeightGrid& image, std::size_t reach_columns, std::size_t reach_rows, double threshold_m);

}  // namespace afm::physics
