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

// Session file of one of session_versions(): "AFMS", the version, then chunks. A chunk consists of a name of four
// letters and the size of its payload in 32 bits, the checksum of these, the payload, and its checksum. A checksum is
// the 64-bit FNV-1a of all bytes from the beginning of the file up to it, so that no chunk can be altered, left out or
// exchanged. A file that ends inside a chunk was cut; all chunks before it are intact.
namespace afm::servo {

inline constexpr std::string_view kSessionMagic = "AFMS";
inline constexpr std::string_view kHeadChunk = "HEAD";        // JSON of header_of()
inline constexpr std::string_view kSurfaceChunk = "SURF";     // one SharedHeightField, if a height field is felt
inline constexpr std::string_view kTopographyChunk = "TOPO";  // size, spacing and heights, if it has a topography
inline constexpr std::string_view kLawMapChunk = "LAWS";      // size, spacing, moduli, adhesions, if it has a law map
inline constexpr std::string_view kPartChunk = "PART";        // samples and events up to one moment, and wall frames
inline constexpr std::string_view kEndChunk = "DONE";         // end of the file, no payload

// Encodes a session, chunk by chunk.
class SessionEncoder {
 public:
  // Beginning of the file and first chunk, followed by surface and particles.
  void head(const RecordedSession& session);
  void part(const RecordedSession& session);  // encodes the data since the last part, one chunk per second
  void end();

  const std::string& bytes() const { return bytes_; }  // bytes since the last clear()
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

// Reads chunks one after the other.
class SessionDecoder {
 public:
  // `file` is a whole file that begins with magic and version; it must outlive the decoder.
  explicit SessionDecoder(std::string_view file);

  enum class Step { Chunk, Cut, Altered, End };
  Step next();

  std::string_view name() const { return name_; }  // name of the newest chunk
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
