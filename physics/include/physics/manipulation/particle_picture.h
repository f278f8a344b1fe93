// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/imaging/height_grid.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/units.h"

// The picture of particles by the tip that pushes them: the height of the apex where a descending tip touches sample or
// particle (docs/manipulation.md). One thread; everything allocates.
namespace afm::physics {

// Pixels of a picture in the sample's frame, row by row from the first one.
struct PictureFrame {
  Sideways<Length> first;  // place of the first pixel
  Length pixel;
  std::size_t columns = 0, rows = 0;
};

// Pixels [first_column, first_column + columns) of the rows [first_row, first_row + rows).
struct PixelBox {
  std::size_t first_column = 0, first_row = 0, columns = 0, rows = 0;

  bool operator==(const PixelBox&) const = default;
};

// Number of lines of a second look at a place: those of a box of three times rho(0) to each side.
inline constexpr std::size_t kLookLines = 33;

// Distance of the axes at which a tip on the sample touches the particle: rho(0), by (M1) or (M2).
Length footprint_radius(const SphereCone& tip, Length particle_radius) noexcept;

// Pixels so small that a second look at the widest of these particles takes kLookLines, around all of them with room
// for two looks beside; at most 512 on a side, larger instead. There is at least one particle, at valid places.
PictureFrame frame_around(const PushSetup& setup, const std::vector<PlacedParticle>& particles);

// A picture is measured once; after pushes, the places of the particles that a model has moved are computed: only the
// pixels in their old and new footprints change, to the bits that a computation of the whole picture would give. Other
// pixels keep their bits.
class ParticlePicture {
 public:
  enum class Source : std::uint8_t { Measured, Computed };

  // Measures all particles at their start. The frame has at least one pixel.
  ParticlePicture(const PushSetup& setup, const std::vector<PlacedParticle>& particles, const PictureFrame& frame);

  // One particle was at `before` and is at its place of `now`, which has the places of all. Computes the pixels in its
  // old and new footprint; returns the box in which these are, clipped to the picture.
  PixelBox move(std::size_t particle, const ParticlePlace& before, std::span<const ParticlePlace> now);

  // The box of move() in a picture without borders: columns and rows.
  PixelBox box_around(std::size_t particle, const ParticlePlace& before, const ParticlePlace& after) const;

  // Measures the pixels of a box within the picture, with all particles at these places.
  void measure(const PixelBox& box, std::span<const ParticlePlace> there);

  const HeightGrid& heights() const { return heights_; }
  Source source(std::size_t column, std::size_t row) const { return sources_[row * heights_.columns + column]; }
  std::size_t computed() const;  // number of computed pixels in the picture

 private:
  struct Shape {
    Length radius, reach;  // reach: footprint_radius() of the particle
    double half_m = 0.0;   // half length of a rod
  };
  struct Field {
    double left_m = 0.0, right_m = 0.0, low_m = 0.0, high_m = 0.0;
  };

  Field field_of(std::size_t particle, const ParticlePlace& place) const;
  PixelBox clipped(const Field& field) const;
  bool covers(std::size_t particle, const ParticlePlace& place, double x_m, double y_m) const;
  double away_m(std::size_t particle, const ParticlePlace& place, double x_m, double y_m) const;
  std::vector<std::size_t> near(const Field& field, std::span<const ParticlePlace> places) const;
  double height_m(double x_m, double y_m, std::span<const std::size_t> near,
                  std::span<const ParticlePlace> places) const;
  double x_m(std::size_t column) const;
  double y_m(std::size_t row) const;

  SphereCone tip_;
  std::vector<Shape> shapes_;  // shapes in the order of the particles
  HeightGrid heights_;
  std::vector<Source> sources_;
};

}  // namespace afm::physics
