// SPDX-License-Identifier: Apache-2.0
#include "session_particles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/shared/shared_segment.h"
#include "scene/shared/soft_blocks.h"
#include "session_records.h"

namespace afm::servo {

namespace {

bool has_places(const RecordedParticles& particles) { return !scene::has_marks(particles.set); }
bool has_rods(const RecordedParticles& particles) { return scene::has_rods(particles.set); }
bool has_pads(const RecordedParticles& particles) { return scene::has_pads(particles.set); }
bool has_islands(const RecordedParticles& particles) { return scene::has_islands(particles.set); }

std::string places_of(const RecordedParticles& particles) {
  const scene::SharedParticles& set = particles.set;
  std::string bytes;
  put(bytes, set.pusher);
  put_all(bytes, std::span(set.species).first(set.species_count));
  put_all(bytes, std::span(set.particles).first(set.count));
  put_all(bytes, std::span(particles.pages));
  return bytes;
}

std::string rods_of(const RecordedParticles& particles) {
  const scene::SharedParticles& set = particles.set;
  std::string bytes;
  put_all(bytes, std::span(set.length_m).first(set.species_count));
  put_all(bytes, std::span(set.angle_rad).first(set.count));
  return bytes;
}

std::string pads_of(const RecordedParticles& particles) {
  const scene::SharedParticles& set = particles.set;
  std::string bytes;
  put_all(bytes, std::span<const scene::SharedPad>(set.pads));
  return bytes;
}

std::string islands_of(const RecordedParticles& particles) {
  const scene::SharedParticles& set = particles.set;
  std::string bytes;
  put_all(bytes, std::span(set.island_radius_m).first(set.species_count));
  return bytes;
}

std::string level_of(const RecordedParticles& particles) {
  std::string bytes;
  put(bytes, particles.set.level);
  put_all(bytes, std::span(particles.picture.shown));
  put_all(bytes, std::span(particles.picture.measured));
  put_all(bytes, std::span(particles.picture.seen_ns));
  return bytes;
}

// A tile with marks, and its number.
struct NumberedTile {
  std::uint64_t number = 0;
  scene::MarkTile tile;
};

// Bytes of a soft sample or ink, `sample`, with its marks.
template <class Sample>
std::string marks_of(const Sample& sample, const RecordedParticles& particles) {
  std::string bytes;
  put(bytes, sample);
  put(bytes, particles.set.pusher);
  std::vector<NumberedTile> marked;
  for (std::size_t i = 0; i < particles.tiles.size(); ++i) {
    if (scene::tile_mark(i, particles.tiles[i]) != 0) marked.push_back({i, particles.tiles[i]});
  }
  put_all(bytes, std::span<const NumberedTile>(marked));
  return bytes;
}

std::string soft_of(const RecordedParticles& particles) { return marks_of(particles.set.soft, particles); }
std::string ink_of(const RecordedParticles& particles) { return marks_of(particles.set.ink, particles); }

template <class Sample>
bool read_marks(std::string_view payload, Sample& sample, RecordedParticles& particles) {
  std::vector<NumberedTile> marked;
  if (!take(payload, sample) || !take(payload, particles.set.pusher) || !take_all(payload, marked) ||
      !payload.empty()) {
    return false;
  }
  particles.tiles.assign(scene::kMarkTiles, {});
  for (const NumberedTile& tile : marked) {
    if (tile.number >= particles.tiles.size() || !scene::is_valid(tile.tile)) return false;
    particles.tiles[tile.number] = tile.tile;
  }
  return true;
}

bool read_places(std::string_view payload, RecordedParticles& particles) {
  std::vector<scene::SharedSpecies> species;
  std::vector<scene::SharedParticle> places;
  scene::SharedParticles& set = particles.set;
  if (!take(payload, set.pusher) || !take_all(payload, species) || !take_all(payload, places) ||
      !take_all(payload, particles.pages) || !payload.empty() || species.size() > set.species.size() ||
      places.size() > set.particles.size() || places.empty()) {
    return false;
  }
  set.species_count = static_cast<std::uint32_t>(species.size());
  set.count = static_cast<std::uint32_t>(places.size());
  std::copy(species.begin(), species.end(), set.species.begin());
  std::copy(places.begin(), places.end(), set.particles.begin());
  return particles.pages.size() == scene::pages_of(set.count) &&
         std::all_of(particles.pages.begin(), particles.pages.end(),
                     [](const scene::ParticlePage& page) { return scene::is_valid(page); });
}

bool read_rods(std::string_view payload, RecordedParticles& particles) {
  std::vector<double> lengths_m, angles_rad;
  scene::SharedParticles& set = particles.set;
  if (!take_all(payload, lengths_m) || !take_all(payload, angles_rad) || !payload.empty() ||
      lengths_m.size() != set.species_count || angles_rad.size() != set.count) {
    return false;
  }
  std::copy(lengths_m.begin(), lengths_m.end(), set.length_m.begin());
  std::copy(angles_rad.begin(), angles_rad.end(), set.angle_rad.begin());
  return scene::has_rods(set);
}

bool read_pads(std::string_view payload, RecordedParticles& particles) {
  std::vector<scene::SharedPad> pads;
  scene::SharedParticles& set = particles.set;
  if (!take_all(payload, pads) || !payload.empty() || pads.size() != set.pads.size()) return false;
  std::copy(pads.begin(), pads.end(), set.pads.begin());
  return scene::has_pads(set);
}

bool read_islands(std::string_view payload, RecordedParticles& particles) {
  std::vector<double> radii_m;
  scene::SharedParticles& set = particles.set;
  if (!take_all(payload, radii_m) || !payload.empty() || radii_m.size() != set.species_count) return false;
  std::copy(radii_m.begin(), radii_m.end(), set.island_radius_m.begin());
  return scene::has_islands(set);
}

bool read_level(std::string_view payload, RecordedParticles& particles) {
  PictureState& picture = particles.picture;
  if (!take(payload, particles.set.level) || !take_all(payload, picture.shown) ||
      !take_all(payload, picture.measured) || !take_all(payload, picture.seen_ns) || !payload.empty()) {
    return false;
  }
  const auto sound = [&](const std::vector<scene::ParticlePage>& pages) {
    return pages.size() == (picture.empty() ? 0 : particles.pages.size()) &&
           std::all_of(pages.begin(), pages.end(), [](const auto& page) { return scene::is_valid(page); });
  };
  return has_level(particles) && sound(picture.shown) && sound(picture.measured) &&
         (picture.empty() || picture.seen_ns.size() == particles.set.count);
}

bool read_soft(std::string_view payload, RecordedParticles& particles) {
  return read_marks(payload, particles.set.soft, particles) && is_soft(particles);
}

bool read_ink(std::string_view payload, RecordedParticles& particles) {
  return read_marks(payload, particles.set.ink, particles) && is_ink(particles);
}

// Kinds of chunks in the order of a file.
constexpr std::array kParticleChunks{
    ParticleChunk{"SOFT", true, "its soft sample is damaged", is_soft, soft_of, read_soft},
    ParticleChunk{"INKS", true, "its ink is damaged", is_ink, ink_of, read_ink},
    ParticleChunk{"PRTC", true, "its particles are damaged", has_places, places_of, read_places},
    ParticleChunk{"RODS", false, "its rods are damaged", has_rods, rods_of, read_rods},
    ParticleChunk{"PADS", false, "its pads are damaged", has_pads, pads_of, read_pads},
    ParticleChunk{"ISLE", false, "its islands are damaged", has_islands, islands_of, read_islands},
    ParticleChunk{"LEVL", false, "its picture is damaged", has_level, level_of, read_level}};

}  // namespace

bool is_soft(const RecordedParticles& particles) { return particles.set.soft.hardness_pa > 0.0; }

bool is_ink(const RecordedParticles& particles) { return particles.set.ink.molecules_per_s > 0.0; }

bool has_level(const RecordedParticles& particles) {
  return particles.set.level.level > 0 && !scene::has_marks(particles.set);
}

std::span<const ParticleChunk> particle_chunks() { return kParticleChunks; }

}  // namespace afm::servo
