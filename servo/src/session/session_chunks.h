// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/fnv1a.h"
#include "servo/session_file.h"

// Session file of version 6, 7 with particles, 8 with rods among them, or 9 with spheres that stick to the tip, whose
// forces an older program does not know, and with rods or without, 10 for a lever that taps, or 11 for particles of any
// kind and the plans of their pushes, as touchafm records them today, 12 for those with pads or with spheres that the
// tip lifts, 13 for flat islands, 14 for particles at level 1 or 2, whose sample may drift, 15 for a map of modulus and
// adhesion, 17 for a soft sample that the tip scratches, 18 for a map that is viscous, 20 for one that vibrates:
// "AFMS", the version, then chunks. A chunk consists of a name of four letters and the size of its payload in 32 bits,
// the checksum of these, the payload, and its checksum. A checksum is the 64-bit FNV-1a of all bytes from the beginning
// of the file up to it, so that no chunk can be altered, left out or exchanged. A file that ends inside a chunk was
// cut; all chunks before it are intact.
namespace afm::servo {

inline constexpr std::string_view kSessionMagic = "AFMS";
inline constexpr std::uint32_t kSessionVersion = 6;
inline constexpr std::uint32_t kVersionWithParticles = 7;  // samples end with the push, and a chunk has the particles
inline constexpr std::uint32_t kVersionWithRods = 8;       // a chunk has the rods, too
inline constexpr std::uint32_t kVersionWithHold = 9;       // particles stick to the tip
inline constexpr std::uint32_t kVersionWithSwing = 10;  // the lever taps, without particles; samples end with its swing
inline constexpr std::uint32_t kVersionWithPlans = 11;  // as 7, 8 or 9; samples end with plan and groove
inline constexpr std::uint32_t kVersionWithLift = 12;   // as 11; the tip lifts particles, or a chunk has pads
inline constexpr std::uint32_t kVersionWithIslands = 13;  // as 11; a chunk has the islands
inline constexpr std::uint32_t kVersionWithLevel = 14;   // as 11; samples end with LevelSample, a chunk has the picture
inline constexpr std::uint32_t kVersionWithLawMap = 15;  // as 6; a chunk has a map of modulus and adhesion
inline constexpr std::uint32_t kVersionWithViscousMap = 18;    // as 15; the map damps the hand, too
inline constexpr std::uint32_t kVersionWithMapVibration = 20;  // as 15 or 18; the map vibrates, too

inline constexpr std::uint32_t kVersionWithMarks = 17;  // as 11; a chunk has a soft sample in place of particles

inline constexpr std::string_view kHeadChunk = "HEAD";        // header_of() as JSON
inline constexpr std::string_view kSurfaceChunk = "SURF";     // one SharedHeightField, if the sample has one
inline constexpr std::string_view kTopographyChunk = "TOPO";  // size, spacing and heights, if it has a topography
inline constexpr std::string_view kLawMapChunk = "LAWS";      // size, spacing, moduli, adhesions, if it has such a map
inline constexpr std::string_view kParticlesChunk = "PRTC";   // RecordedParticles, if there are any
inline constexpr std::string_view kRodsChunk = "RODS";        // their lengths and first angles, after the particles
inline constexpr std::string_view kPadsChunk = "PADS";        // pads, after the particles, if there are any
inline constexpr std::string_view kIslandsChunk = "ISLE";     // radii of the species of islands, after the particles
inline constexpr std::string_view kLevelChunk = "LEVL";       // level and PictureState, after the particles
inline constexpr std::string_view kSoftChunk = "SOFT";        // soft sample, its tip, and the tiles with marks
inline constexpr std::string_view kPartChunk = "PART";  // samples and events up to one moment, and frames of the wall
inline constexpr std::string_view kEndChunk = "DONE";   // end of the file, without a payload

// Encodes a session, chunk by chunk.
class SessionEncoder {
 public:
  // Beginning of the file and first chunk, followed by surface and particles.
  void head(const RecordedSession& session);
  void part(const RecordedSession& session);  // data since the last part, one chunk per second
  void end();

  const std::string& bytes() const { return bytes_; }  // since the last clear()
  void clear() { bytes_.clear(); }

 private:
  void part(std::span<const scene::TipSample> samples, std::span<const scene::TipEvent> events,
            std::span<const WallFrame> frames);
  void add(std::string_view bytes);
  void add_sum();
  void chunk(std::string_view name, std::string_view payload);

  std::string bytes_;
  core::Fnv1a sum_;
  nlohmann::json last_frame_;
  std::size_t sample_bytes_ = 0;
};

// Reads a kLawMapChunk; null if it is damaged. The values are checked with the scene.
std::shared_ptr<const scene::SharedLawMap> read_law_map(std::string_view payload);

// Reads a kParticlesChunk; false if it is damaged. The set itself is checked with its scene.
bool read_particles(std::string_view payload, RecordedParticles& particles);

// Reads a kRodsChunk for particles that have been read; false if it is damaged.
bool read_rods(std::string_view payload, RecordedParticles& particles);

// The same for a kPadsChunk.
bool read_pads(std::string_view payload, RecordedParticles& particles);

// The same for a kIslandsChunk.
bool read_islands(std::string_view payload, RecordedParticles& particles);

// The same for a kLevelChunk.
bool read_level(std::string_view payload, RecordedParticles& particles);

// Reads a kSoftChunk; false if it is damaged.
bool read_soft(std::string_view payload, RecordedParticles& particles);

// True if the tip lifts some of them, or a pad holds them, which needs version kVersionWithLift.
bool lifts(const scene::SharedParticles& set);

// Size of a sample in a file of this session.
std::size_t sample_bytes_of(const RecordedSession& session);

// Reads chunks one after the other.
class SessionDecoder {
 public:
  // `file` is a whole file that begins with magic and version; it must outlive the decoder.
  explicit SessionDecoder(std::string_view file);

  enum class Step { Chunk, Cut, Altered, End };
  Step next();

  std::string_view name() const { return name_; }  // newest chunk
  std::string_view payload() const { return payload_; }

 private:
  std::string_view take(std::size_t size);
  bool sum_is_right();

  std::string_view rest_;
  core::Fnv1a sum_;
  std::string_view name_;
  std::string_view payload_;
};

}  // namespace afm::servo
