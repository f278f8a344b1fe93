// SPDX-License-Identifier: Apache-2.0
#include "session_chunks.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "scene/shared/shared_segment.h"
#include "session_header.h"
#include "session_particles.h"
#include "session_records.h"
#include "session_versions.h"

namespace afm::servo {

namespace {

constexpr std::size_t kNameBytes = 4;
constexpr std::uint64_t kLongestPartNs = 1'000'000'000;  // longest part in ns, which a cut file loses at most
constexpr std::size_t kSumBytes = sizeof(std::uint64_t);

// True if a time belongs to a later part than the one that begins at `begin_ns`. Unsigned, since the difference of two
// absurd times would overflow.
bool is_of_later_part(std::int64_t time_ns, std::int64_t begin_ns) {
  return time_ns > begin_ns &&
         static_cast<std::uint64_t>(time_ns) - static_cast<std::uint64_t>(begin_ns) >= kLongestPartNs;
}

std::string text_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);  // `replace`: file texts may not be UTF-8
}

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

void SessionEncoder::head(const RecordedSession& session) {
  const SessionVersion& version = version_of(session);
  std::string start(kSessionMagic);
  put(start, version.number);
  add(start);
  sample_bytes_ = version.sample_bytes;
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
  if (!session.particles) return;
  for (const ParticleChunk& kept : particle_chunks()) {
    if (kept.is_needed(*session.particles)) chunk(kept.name, kept.bytes_of(*session.particles));
  }
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
  take(kSessionMagic.size() + sizeof(SessionVersion::number));
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
