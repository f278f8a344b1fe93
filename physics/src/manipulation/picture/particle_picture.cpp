// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/particle_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "manipulation/outline.h"
#include "physics/manipulation/tip_contact.h"

namespace afm::physics {
namespace {

constexpr double kLookReach = 3.0;  // half size of a look's box, in footprint radii
constexpr double kRoom = 2.0 * kLookReach;
constexpr double kMostPixels = 512.0;  // largest number of pixels per side
constexpr double kHalfLookPixels = 0.5 * static_cast<double>(kLookLines - 1);

Outline outline_at(const ParticlePlace& place, double half_m) {
  return {{place.position.x.si, place.position.y.si}, axis_of(place.turn), half_m};
}

std::size_t pixels_on(double side_m, double pixel_m) {
  return static_cast<std::size_t>(std::ceil(side_m / pixel_m)) + 1;
}

// Pixels of a range along one side, clipped to `count`: first and number.
std::pair<std::size_t, std::size_t> range_of(double from_m, double to_m, double first_m, double pixel_m,
                                             std::size_t count) {
  const double most = static_cast<double>(count);
  const double from = std::floor((from_m - first_m) / pixel_m), end = from + std::ceil((to_m - from_m) / pixel_m) + 1.0;
  const double begins = std::clamp(from, 0.0, most), ends = std::clamp(end, 0.0, most);
  return {static_cast<std::size_t>(begins), static_cast<std::size_t>(ends - begins)};
}

}  // namespace

Length footprint_radius(const SphereCone& tip, Length particle_radius) noexcept {
  return side_contact(tip, particle_radius, Length(0.0)).distance;
}

PictureFrame frame_around(const PushSetup& setup, const std::vector<PlacedParticle>& particles) {
  double reach_m = 0.0, left_m = HUGE_VAL, right_m = -HUGE_VAL, low_m = HUGE_VAL, high_m = -HUGE_VAL;
  for (const PlacedParticle& particle : particles) {
    const ParticleSpecies& species = setup.species[particle.species];
    reach_m = std::max(reach_m, footprint_radius(setup.tip, species.contact.tip_radius).si);
    const double x_m = particle.position.x.si, y_m = particle.position.y.si, half_m = 0.5 * species.length.si;
    left_m = std::min(left_m, x_m - half_m);
    right_m = std::max(right_m, x_m + half_m);
    low_m = std::min(low_m, y_m - half_m);
    high_m = std::max(high_m, y_m + half_m);
  }
  const double room_m = kRoom * reach_m, wide_m = right_m - left_m + 2.0 * room_m,
               tall_m = high_m - low_m + 2.0 * room_m;
  const double pixel_m =
      std::max(kLookReach * reach_m / kHalfLookPixels, std::max(wide_m, tall_m) / (kMostPixels - 2.0));
  return {{Length(left_m - room_m), Length(low_m - room_m)},
          Length(pixel_m),
          pixels_on(wide_m, pixel_m),
          pixels_on(tall_m, pixel_m)};
}

ParticlePicture::ParticlePicture(const PushSetup& setup, const std::vector<PlacedParticle>& particles,
                                 const PictureFrame& frame)
    : tip_(setup.tip) {
  std::vector<ParticlePlace> places;
  places.reserve(particles.size());
  shapes_.reserve(particles.size());
  for (const PlacedParticle& particle : particles) {
    const ParticleSpecies& species = setup.species[particle.species];
    const Length radius = species.contact.tip_radius;
    shapes_.push_back({radius, footprint_radius(tip_, radius), 0.5 * species.length.si});
    places.push_back({particle.position, half_turn(particle.angle_rad)});
  }
  heights_ = {.columns = frame.columns,
              .rows = frame.rows,
              .x_first_m = frame.first.x.si,
              .y_first_m = frame.first.y.si,
              .column_step_m = frame.pixel.si,
              .row_step_m = frame.pixel.si,
              .height_m = std::vector<double>(frame.columns * frame.rows, 0.0)};
  sources_.assign(frame.columns * frame.rows, Source::Measured);
  // all else is the bare sample
  for (std::size_t i = 0; i < places.size(); ++i) measure(clipped(field_of(i, places[i])), places);
}

double ParticlePicture::x_m(std::size_t column) const {
  return heights_.x_first_m + static_cast<double>(column) * heights_.column_step_m;
}

double ParticlePicture::y_m(std::size_t row) const {
  return heights_.y_first_m + static_cast<double>(row) * heights_.row_step_m;
}

ParticlePicture::Field ParticlePicture::field_of(std::size_t particle, const ParticlePlace& place) const {
  const auto& [radius, reach, half_m] = shapes_[particle];
  const Flat axis = axis_of(place.turn);
  const double wide_m = std::abs(half_m * axis.x) + reach.si, tall_m = std::abs(half_m * axis.y) + reach.si;
  const double x_m = place.position.x.si, y_m = place.position.y.si;
  return {x_m - wide_m, x_m + wide_m, y_m - tall_m, y_m + tall_m};
}

PixelBox ParticlePicture::clipped(const Field& field) const {
  const auto [column, columns] =
      range_of(field.left_m, field.right_m, heights_.x_first_m, heights_.column_step_m, heights_.columns);
  const auto [row, rows] = range_of(field.low_m, field.high_m, heights_.y_first_m, heights_.row_step_m, heights_.rows);
  return {column, row, columns, rows};
}

PixelBox ParticlePicture::box_around(std::size_t particle, const ParticlePlace& before,
                                     const ParticlePlace& after) const {
  const Field a = field_of(particle, before), b = field_of(particle, after);
  return {0, 0, pixels_on(std::max(a.right_m, b.right_m) - std::min(a.left_m, b.left_m), heights_.column_step_m),
          pixels_on(std::max(a.high_m, b.high_m) - std::min(a.low_m, b.low_m), heights_.row_step_m)};
}

double ParticlePicture::away_m(std::size_t particle, const ParticlePlace& place, double x_m, double y_m) const {
  const Flat point{x_m, y_m};
  return distance_between(nearest_on(outline_at(place, shapes_[particle].half_m), point), point);
}

bool ParticlePicture::covers(std::size_t particle, const ParticlePlace& place, double x_m, double y_m) const {
  return away_m(particle, place, x_m, y_m) < shapes_[particle].reach.si;
}

// Particles that can be met within the field, with a pixel to spare for the rounding of its border.
std::vector<std::size_t> ParticlePicture::near(const Field& field, std::span<const ParticlePlace> places) const {
  std::vector<std::size_t> found;
  const double spare_m = heights_.column_step_m;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Field other = field_of(i, places[i]);
    const bool beside = other.left_m > field.right_m + spare_m || other.right_m < field.left_m - spare_m;
    const bool above = other.low_m > field.high_m + spare_m || other.high_m < field.low_m - spare_m;
    if (!beside && !above) found.push_back(i);
  }
  return found;
}

double ParticlePicture::height_m(double x_m, double y_m, std::span<const std::size_t> near,
                                 std::span<const ParticlePlace> places) const {
  double highest_m = 0.0;
  for (const std::size_t i : near) {
    if (!covers(i, places[i], x_m, y_m)) continue;
    const Length away(away_m(i, places[i], x_m, y_m));
    highest_m = std::max(highest_m, touching_height(tip_, shapes_[i].radius, away).si);
  }
  return highest_m;
}

PixelBox ParticlePicture::move(std::size_t particle, const ParticlePlace& before, std::span<const ParticlePlace> now) {
  const ParticlePlace& after = now[particle];
  const Field a = field_of(particle, before), b = field_of(particle, after);
  const Field field{std::min(a.left_m, b.left_m), std::max(a.right_m, b.right_m), std::min(a.low_m, b.low_m),
                    std::max(a.high_m, b.high_m)};
  const PixelBox box = clipped(field);
  const std::vector<std::size_t> met = near(field, now);
  for (std::size_t row = box.first_row; row < box.first_row + box.rows; ++row) {
    for (std::size_t column = box.first_column; column < box.first_column + box.columns; ++column) {
      const double x = x_m(column), y = y_m(row);
      if (!covers(particle, before, x, y) && !covers(particle, after, x, y)) continue;
      heights_.at(column, row) = height_m(x, y, met, now);
      sources_[row * heights_.columns + column] = Source::Computed;
    }
  }
  return box;
}

void ParticlePicture::measure(const PixelBox& box, std::span<const ParticlePlace> there) {
  if (box.columns == 0 || box.rows == 0) return;
  const std::size_t last_column = box.first_column + box.columns - 1, last_row = box.first_row + box.rows - 1;
  const Field field{x_m(box.first_column), x_m(last_column), y_m(box.first_row), y_m(last_row)};
  const std::vector<std::size_t> met = near(field, there);
  for (std::size_t row = box.first_row; row <= last_row; ++row) {
    for (std::size_t column = box.first_column; column <= last_column; ++column) {
      heights_.at(column, row) = height_m(x_m(column), y_m(row), met, there);
      sources_[row * heights_.columns + column] = Source::Measured;
    }
  }
}

std::size_t ParticlePicture::computed() const {
  return static_cast<std::size_t>(std::count(sources_.begin(), sources_.end(), Source::Computed));
}

}  // namespace afm::physics
