// SPDX-License-Identifier: Apache-2.0
#include "session_chunks.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "scene/shared/map_vibration.h"
#include "scene/shared/shared_segment.h"
#include "session_header.h"
#include "session_records.h"

namespace afm::servo {

namespace {

constexpr std::size_t kNameBytes = 4;
constexpr std::uint64_t kLongestPartNs = 1'000'000'000;  // longest part, the most that a cut file loses
constexpr std::size_t kSumBytes = sizeof(std::uint64_t);

// True if a time belongs to a later part than the one that begins at `begin_ns`. Unsigned, since the difference of two
// absurd times would overflow.
bool is_of_later_part(std::int64_t time_ns, std::int64_t begin_ns) {
  return time_ns > begin_ns &&
         static_cast<std::uint64_t>(time_ns) - static_cast<std::uint64_t>(begin_ns) >= kLongestPartNs;
}

std::string text_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);  // text of a file may not be UTF-8
}

std::string bytes_of(const RecordedParticles& particles) {
  const scene::SharedParticles& set = particles.set;
  std::string bytes;
  put(bytes, set.pusher);
  put_all(bytes, std::span(set.species).first(set.species_count));
  put_all(bytes, std::span(set.particles).first(set.count));
  put_all(bytes, std::span(particles.pages));
  return bytes;
}

std::string rods_of(const scene::SharedParticles& set) {
  std::string bytes;
  put_all(bytes, std::span(set.length_m).first(set.species_count));
  put_all(bytes, std::span(set.angle_rad).first(set.count));
  return bytes;
}

std::string pads_of(const scene::SharedParticles& set) {
  std::string bytes;
  put_all(bytes, std::span<const scene::SharedPad>(set.pads));
  return bytes;
}

std::string islands_of(const scene::SharedParticles& set) {
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

// `sample` is the soft one, or the ink.
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

bool is_soft(const RecordedParticles& particles) { return particles.set.soft.hardness_pa > 0.0; }
bool is_ink(const RecordedParticles& particles) { return particles.set.ink.molecules_per_s > 0.0; }

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

bool has_level(const RecordedParticles& particles) { return particles.set.level.level > 0; }

std::string bytes_of(const scene::SharedLawMap& map) {
  const std::size_t count = std::size_t{map.columns} * map.rows;
  std::string bytes;
  put(bytes, map.columns);
  put(bytes, map.rows);
  put(bytes, map.spacing_m);
  put_all(bytes, std::span(map.ln_modulus).first(count));
  put_all(bytes, std::span(map.adhesion_j_per_m2).first(count));
  return bytes;
}

std::uint32_t version_of(const RecordedSession& session) {
  if (session.law_map) {
    if (session.parameters.map_vibration != scene::MapVibration::None) return kVersionWithMapVibration;
    return session.parameters.viscous_map != 0 ? kVersionWithViscousMap : kVersionWithLawMap;
  }
  if (scene::taps(session.parameters)) return kVersionWithSwing;
  if (!session.particles) return kSessionVersion;
  if (is_soft(*session.particles)) return kVersionWithMarks;
  if (is_ink(*session.particles)) return kVersionWithInk;
  if (has_level(*session.particles)) return kVersionWithLevel;
  if (scene::has_islands(session.particles->set)) return kVersionWithIslands;
  if (lifts(session.particles->set)) return kVersionWithLift;
  if (session.has_plans) return kVersionWithPlans;
  if (scene::has_hold(session.particles->set)) return kVersionWithHold;
  return scene::has_rods(session.particles->set) ? kVersionWithRods : kVersionWithParticles;
}

}  // namespace

std::shared_ptr<const scene::SharedLawMap> read_law_map(std::string_view payload) {
  auto map = std::make_shared<scene::SharedLawMap>();
  std::vector<float> moduli, adhesions;
  if (!take(payload, map->columns) || !take(payload, map->rows) || !take(payload, map->spacing_m) ||
      !take_all(payload, moduli) || !take_all(payload, adhesions) || !payload.empty() ||
      moduli.size() > map->ln_modulus.size() || moduli.size() != std::uint64_t{map->columns} * map->rows ||
      adhesions.size() != moduli.size()) {
    return nullptr;
  }
  std::copy(moduli.begin(), moduli.end(), map->ln_modulus.begin());
  std::copy(adhesions.begin(), adhesions.end(), map->adhesion_j_per_m2.begin());
  return map;
}

bool read_particles(std::string_view payload, RecordedParticles& particles) {
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

bool lifts(const scene::SharedParticles& set) { return scene::has_pads(set) || scene::has_lift(set); }

std::size_t sample_bytes_of(const RecordedSession& session) {
  if (scene::taps(session.parameters)) return kSampleBytesWithoutPlan;
  if (!session.particles) return kSampleBytesWithoutPush;
  if (has_level(*session.particles)) return kMostSampleBytes;
  const scene::SharedParticles& set = session.particles->set;
  const bool whole = session.has_plans || scene::has_marks(set) || lifts(set) || scene::has_islands(set);
  return whole ? kSampleBytesWithoutLevel : kSampleBytesWithoutSwing;
}

void SessionEncoder::head(const RecordedSession& session) {
  std::string start(kSessionMagic);
  put(start, version_of(session));
  add(start);
  sample_bytes_ = sample_bytes_of(session);
  chunk(kHeadChunk, text_of(header_of(session)));
  if (session.surface) {
    std::string surface;
    put(surface, *session.surface);
    chunk(kSurfaceChunk, surface);
  }
  if (session.topography.columns > 0) {
    std::string topography;
    put(topography, session.topography.size());
    put_all(topography, std::span(session.topography.height_m));
    chunk(kTopographyChunk, topography);
  }
  if (session.law_map) chunk(kLawMapChunk, bytes_of(*session.law_map));
  if (session.particles && is_soft(*session.particles)) {
    return chunk(kSoftChunk, marks_of(session.particles->set.soft, *session.particles));
  }
  if (session.particles && is_ink(*session.particles)) {
    return chunk(kInkChunk, marks_of(session.particles->set.ink, *session.particles));
  }
  if (session.particles) chunk(kParticlesChunk, bytes_of(*session.particles));
  if (session.particles && scene::has_rods(session.particles->set)) chunk(kRodsChunk, rods_of(session.particles->set));
  if (session.particles && scene::has_pads(session.particles->set)) chunk(kPadsChunk, pads_of(session.particles->set));
  if (session.particles && scene::has_islands(session.particles->set)) {
    chunk(kIslandsChunk, islands_of(session.particles->set));
  }
  if (session.particles && has_level(*session.particles)) chunk(kLevelChunk, level_of(*session.particles));
}

void SessionEncoder::part(const RecordedSession& session) {
  std::span samples(session.samples);
  std::span events(session.events);
  std::span frames(session.wall);
  while (!samples.empty() && is_of_later_part(samples.back().time_ns, samples.front().time_ns)) {
    const std::int64_t begin_ns = samples.front().time_ns;
    const auto take_until_end = [&](auto& records) {
      const auto end = std::find_if(records.begin(), records.end(),
                                    [&](const auto& r) { return is_of_later_part(r.time_ns, begin_ns); });
      const auto taken = records.first(static_cast<std::size_t>(end - records.begin()));
      records = records.subspan(taken.size());
      return taken;
    };
    part(take_until_end(samples), take_until_end(events), take_until_end(frames));
  }
  part(samples, events, frames);
}

void SessionEncoder::part(std::span<const scene::TipSample> samples, std::span<const scene::TipEvent> events,
                          std::span<const WallFrame> frames) {
  std::string payload;
  put_samples(payload, samples, sample_bytes_);
  put_all(payload, events);
  payload += text_of(json_of(frames, last_frame_));
  chunk(kPartChunk, payload);
}

void SessionEncoder::end() { chunk(kEndChunk, {}); }

void SessionEncoder::add(std::string_view bytes) {
  for (const char byte : bytes) sum_.add(static_cast<unsigned char>(byte));
  bytes_ += bytes;
}

void SessionEncoder::add_sum() {
  std::string sum;
  put(sum, sum_.value());
  add(sum);
}

void SessionEncoder::chunk(std::string_view name, std::string_view payload) {
  std::string front(name);
  put(front, static_cast<std::uint32_t>(payload.size()));
  add(front);
  add_sum();
  add(payload);
  add_sum();
}

SessionDecoder::SessionDecoder(std::string_view file) : rest_(file) {
  take(kSessionMagic.size() + sizeof(kSessionVersion));
}

SessionDecoder::Step SessionDecoder::next() {
  if (name_ == kEndChunk) return rest_.empty() ? Step::End : Step::Altered;
  std::uint32_t size = 0;
  if (rest_.size() < kNameBytes + sizeof(size) + kSumBytes) return Step::Cut;
  name_ = take(kNameBytes);
  std::string_view size_bytes = take(sizeof(size));
  servo::take(size_bytes, size);
  if (!sum_is_right()) return Step::Altered;
  if (rest_.size() < size + kSumBytes) return Step::Cut;
  payload_ = take(size);
  return sum_is_right() ? Step::Chunk : Step::Altered;
}

std::string_view SessionDecoder::take(std::size_t size) {
  const std::string_view taken = rest_.substr(0, size);
  for (const char byte : taken) sum_.add(static_cast<unsigned char>(byte));
  rest_.remove_prefix(taken.size());
  return taken;
}

bool SessionDecoder::sum_is_right() {
  const std::uint64_t expected = sum_.value();
  std::string_view bytes = take(kSumBytes);
  std::uint64_t found = 0;
  return servo::take(bytes, found) && found == expected;
}

}  // namespace afm::servo
