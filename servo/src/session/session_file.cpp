// SPDX-License-Identifier: Apache-2.0
#include "servo/session_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <type_traits>

#include "core/enumerators.h"
#include "core/fnv1a.h"
#include "core/printable.h"
#include "core/whole_file.h"
#include "scene/shared/map_vibration.h"
#include "scene/shared/shared_segment.h"
#include "session_chunks.h"
#include "session_header.h"
#include "session_particles.h"
#include "session_records.h"
#include "session_versions.h"

namespace afm::servo {

namespace {

using scene::SharedHeightField;
using scene::TipEvent;
using scene::TipSample;

constexpr std::uint32_t kVersionOf010 = 3;  // version written by TouchAFM 0.1.0
constexpr double kFarthestM = 1e6;
constexpr double kUnitWithin = 1e-3;
constexpr double kUnitTurnWithin = 1e-9;
constexpr double kMostOrders = 9.0;
constexpr const char* kRecordAgain = "; record it again";

// Reads a header; returns an error message, or nothing. Throws as session_of does.
std::string read_header(std::string_view text, std::size_t sample_bytes, RecordedSession& session) {
  const nlohmann::json header = nlohmann::json::parse(text);
  if (!fits_records(header, sample_bytes)) return "the size of its records differs from this program's";
  session = session_of(header);
  return {};
}

template <class Record>
bool finite(const Record& record) {
  bool all = true;
  scene::for_each_leaf(
      [&]<class Value>(const char*, const Value& value) {
        if constexpr (std::is_floating_point_v<Value>) {
          all = all && std::isfinite(value);
        } else if constexpr (!std::is_integral_v<Value> && !std::is_enum_v<Value>) {
          all = all && std::all_of(value.begin(), value.end(), [](double number) { return std::isfinite(number); });
        }
      },
      record);
  return all;
}

// Reads version 3: the header with its size, then samples, events and at most one surface, each preceded by their
// number, then the checksum of everything before it. Returns an error message, or nothing.
std::string read_records(std::string_view file, RecordedSession& session) {
  std::string_view body = file.substr(kSessionMagic.size() + sizeof(kVersionOf010));
  std::uint64_t sum = 0, header_size = 0;
  if (body.size() < sizeof(sum)) return "it is truncated";
  std::memcpy(&sum, body.data() + body.size() - sizeof(sum), sizeof(sum));
  body.remove_suffix(sizeof(sum));
  if (sum != core::fnv1a(file.substr(0, file.size() - sizeof(sum)))) {
    return "its checksum is wrong: the file is truncated or altered";
  }
  if (!take(body, header_size) || header_size > body.size()) return "it is truncated";
  if (std::string wrong = read_header(body.substr(0, header_size), kSampleBytesOf010, session); !wrong.empty())
    return wrong;
  body.remove_prefix(header_size);
  std::vector<SharedHeightField> surface;
  if (!take_samples(body, session.samples, kSampleBytesOf010) || !take_all(body, session.events) ||
      !take_all(body, surface) || surface.size() > 1 || !body.empty()) {
    return "its records do not fill the file";
  }
  if (!surface.empty()) session.surface = surface.front();
  return {};
}

// Reads the topography's chunk; false unless its size is exact. Its numbers are checked with those of the scene.
bool read_topography(std::string_view payload, scene::Topography& topography) {
  scene::SharedTopography size;
  if (!take(payload, size) || !take_all(payload, topography.height_m) || !payload.empty()) return false;
  topography.columns = size.columns;
  topography.rows = size.rows;
  topography.spacing_m = size.spacing_m;
  return true;
}

bool read_surface(std::string_view payload, RecordedSession& session) {
  return payload.size() == sizeof(SharedHeightField) && take(payload, session.surface.emplace());
}

// Reads a chunk that follows the head; returns an error message, or nothing. Chunks of a later TouchAFM are skipped:
// they do not change the forces.
std::string read_chunk(const SessionVersion& version, std::string_view name, std::string_view payload,
                       RecordedSession& session) {
  if (name == kSurfaceChunk && !read_surface(payload, session)) {
    return "the size of its surface differs from this program's";
  }
  if (name == kTopographyChunk && !read_topography(payload, session.topography)) return "its topography is damaged";
  if (!may_have(version, name)) return {};
  if (name == kLawMapChunk) {
    session.law_map = read_law_map(payload);
    return session.law_map ? "" : "its map of modulus and adhesion is damaged";
  }
  for (const ParticleChunk& chunk : particle_chunks()) {
    if (name != chunk.name) continue;
    if (chunk.begins) session.particles.emplace();
    if (!session.particles || !chunk.read(payload, *session.particles)) return chunk.damaged;
  }
  return {};
}

// Reads a part; returns an error message, or nothing.
std::string read_part(const SessionVersion& version, std::string_view payload, RecordedSession& session,
                      nlohmann::json& last_frame) {
  const bool has_law = session.parameters.law_map != 0;
  if (&version_of(session) != &version || has_law != (session.law_map != nullptr)) {
    return "its content is that of another version";
  }
  if (!take_samples(payload, session.samples, version.sample_bytes) || !take_all(payload, session.events))
    return "a part of it is damaged";
  for (WallFrame& frame : frames_of(nlohmann::json::parse(payload), last_frame)) {
    session.wall.push_back(std::move(frame));
  }
  return {};
}

// Reads a file of chunks; returns an error message, or nothing.
std::string read_chunks(std::string_view file, const SessionVersion& version, RecordedSession& session) {
  SessionDecoder decoder(file);
  nlohmann::json last_frame;
  for (bool first = true;; first = false) {
    const SessionDecoder::Step step = decoder.next();
    if (step == SessionDecoder::Step::Altered) return "its checksum is wrong: the file was altered";
    if (step == SessionDecoder::Step::End) return {};
    session.complete = false;
    if (step == SessionDecoder::Step::Cut)
      return session.samples.empty() ? "it is truncated before its first tick" : "";
    if (first != (decoder.name() == kHeadChunk)) return "its parts are out of order";
    std::string wrong;
    if (first) {
      wrong = read_header(decoder.payload(), version.sample_bytes, session);
      session.has_plans = version.has_plans;
    } else if (decoder.name() == kPartChunk) {
      wrong = read_part(version, decoder.payload(), session, last_frame);
    } else {
      wrong = read_chunk(version, decoder.name(), decoder.payload(), session);
    }
    if (!wrong.empty()) return wrong;
    session.complete = decoder.name() == kEndChunk;
  }
}

std::vector<std::uint32_t> readable_versions() {
  std::vector<std::uint32_t> numbers{kVersionOf010};
  for (const SessionVersion& version : session_versions()) numbers.push_back(version.number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

bool can_be(const scene::Pose& pose) {
  double length = 0;
  for (const double part : pose.orientation) length += part * part;
  return std::abs(length - 1.0) < kUnitWithin &&
         std::all_of(pose.position_m.begin(), pose.position_m.end(), [](double m) { return std::abs(m) < kFarthestM; });
}

bool can_be(const WallFrame& frame) {
  const auto near = [](double number) { return std::abs(number) < kFarthestM; };
  const auto is_affine = [](const std::array<double, 16>& m) {
    return m[3] == 0.0 && m[7] == 0.0 && m[11] == 0.0 && m[15] == 1.0;
  };
  return std::all_of(frame.room_from_sample.begin(), frame.room_from_sample.end(), near) &&
         std::all_of(frame.navigation.begin(), frame.navigation.end(), near) && is_affine(frame.navigation) &&
         frame.journey_orders >= 0.0 && frame.journey_orders <= kMostOrders && frame.fade >= 0.0 && frame.fade <= 1.0 &&
         frame.ipd_m >= 0.0 && frame.ipd_m < 1.0 && near(frame.release_z_m) &&
         (!frame.wand || can_be(frame.wand->pose)) && can_be(frame.head);
}

bool can_be_a_name(const std::string& name) {
  return !name.empty() && name.size() < scene::kNameLength && core::printable_line(name) == name;
}

// Returns whether the poses marked as rods are those of rods and islands, and these turn only about the vertical.
bool can_be(const RecordedParticles& particles) {
  for (std::uint32_t i = 0; i < particles.set.count; ++i) {
    const scene::ParticlePose& pose = particles.pages[scene::page_of(i)].poses[i % scene::kPosesPerPage];
    const std::uint32_t species = particles.set.particles[i].species;
    const bool rod = particles.set.length_m[species] > 0.0 || particles.set.island_radius_m[species] > 0.0;
    const auto& [w, x, y, z] = pose.orientation;
    if ((pose.rod != 0) != rod) return false;
    if (rod && (x != 0.0 || y != 0.0 || !(std::abs(w * w + z * z - 1.0) < kUnitTurnWithin))) return false;
  }
  return true;
}

// Checks a session that was read; returns an error message, or nothing.
std::string what_cannot_be(const RecordedSession& session) {
  const std::unique_ptr<scene::SharedModel> model = model_of(session);
  if (const auto valid = scene::validate(*model); !valid) return valid.error().message;
  if (session.particles && !can_be(*session.particles)) return "the poses of its rods or islands are impossible";
  if (!scene::is_valid(session.topography, session.topography.size())) return "its topography is not a grid of heights";
  if (!scene::is_valid(session.device)) return "the limits of its device are impossible";
  if (!(session.rate_hz > 0 && std::isfinite(session.hand_m_per_m) && std::isfinite(session.hand_n_per_n))) {
    return "its rate or its scale is impossible";
  }
  if (session.samples.empty()) return "it contains no samples";
  if (!can_be_a_name(session.material)) return "the name of its material is invalid";
  const auto not_before = [](const TipSample& a, const TipSample& b) { return a.time_ns >= b.time_ns; };
  if (session.samples.front().time_ns < 0 ||
      std::adjacent_find(session.samples.begin(), session.samples.end(), not_before) != session.samples.end()) {
    return "the times of its ticks do not increase";
  }
  const auto seen_before = [&](std::int64_t ns) { return ns >= 0 && ns <= session.samples.front().time_ns; };
  if (session.particles &&
      !std::all_of(session.particles->picture.seen_ns.begin(), session.particles->picture.seen_ns.end(), seen_before)) {
    return "the age of its picture is impossible";
  }
  if (!std::all_of(session.samples.begin(), session.samples.end(), [](const TipSample& sample) {
        return sample.level.met <= 1 && sample.level.since_ns >= 0 && sample.level.since_ns <= sample.time_ns;
      })) {
    return "the drift of its sample is impossible";
  }
  const auto is_finite = [](const auto& record) { return finite(record); };
  if (!std::all_of(session.samples.begin(), session.samples.end(), is_finite) ||
      !std::all_of(session.events.begin(), session.events.end(), is_finite)) {
    return "it contains values that are not finite";
  }
  if (!std::all_of(session.events.begin(), session.events.end(),
                   [](const TipEvent& event) { return core::is_enumerator(event.kind); })) {
    return "it contains an event of an unknown kind";
  }
  if (!std::all_of(session.samples.begin(), session.samples.end(),
                   [&](const TipSample& sample) { return scene::is_valid(sample.plan, *model); })) {
    return "the plan of a push is impossible";
  }
  if (!std::all_of(session.wall.begin(), session.wall.end(), [](const WallFrame& f) { return can_be(f); })) {
    return "its state of the wall is impossible";
  }
  return {};
}

}  // namespace

double RecordedSession::seconds_since_start(std::int64_t time_ns) const {
  return samples.empty() ? 0.0 : static_cast<double>(time_ns - samples.front().time_ns) * 1e-9;
}

const TipEvent* RecordedSession::find(physics::EventKind kind) const {
  const auto found = std::find_if(events.begin(), events.end(), [&](const TipEvent& e) { return e.kind == kind; });
  return found == events.end() ? nullptr : &*found;
}

std::unique_ptr<scene::SharedModel> model_of(const RecordedSession& session) {
  auto model = std::make_unique<scene::SharedModel>();
  model->node_count = 1;
  model->nodes[0].parent_from_node = session.room_from_sample;
  model->material_count = 2;
  model->materials[0] = model->materials[1] = session.parameters;
  if (session.curve) {
    model->curve_count = 1;
    model->curves[0] = *session.curve;
  }
  if (!session.samples.empty() && session.samples.front().scale_mode == scene::ScaleMode::Common) {
    model->common_hand_m_per_m = session.hand_m_per_m;  // limit set by other materials as well
    model->common_hand_n_per_n = session.hand_n_per_n;
  }
  model->topography = session.topography.size();
  if (session.law_map) model->law_map = *session.law_map;
  if (session.particles) model->particles = session.particles->set;
  if (session.surface) {
    model->height_field_count = 1;
    model->height_fields[0] = *session.surface;
  }
  return model;
}

core::Result<void> save_session(const RecordedSession& session, const std::string& path) {
  SessionEncoder encoder;
  encoder.head(session);
  encoder.part(session);
  encoder.end();
  return core::write_file(path, encoder.bytes());
}

bool is_session_file(const std::string& path) {
  const auto beginning = core::read_beginning(path, kSessionMagic.size());
  return beginning && *beginning == kSessionMagic;
}

core::Result<RecordedSession> load_session(const std::string& path) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("session file {}: {}{}", path, why, kRecordAgain));
  };
  const auto file = core::read_file(path);
  if (!file) return tl::unexpected(file.error());
  if (!file->starts_with(kSessionMagic)) {
    return core::failure(
        core::ErrorCategory::BadInputFile,
        fmt::format("session file {}: not a TouchAFM session; give a file that touchafm demo wrote", path));
  }
  std::string_view body = std::string_view(*file).substr(kSessionMagic.size());
  std::uint32_t version = 0;
  if (!take(body, version)) return bad("it is truncated");
  const SessionVersion* chunked = find_version(version);
  if (!chunked && version != kVersionOf010) {
    return bad(fmt::format("its version is {}; this program reads versions {}", version,
                           fmt::join(readable_versions(), ", ")));
  }
  RecordedSession session;
  try {
    const std::string wrong = chunked ? read_chunks(*file, *chunked, session) : read_records(*file, session);
    if (!wrong.empty()) return bad(wrong);
  } catch (const nlohmann::json::exception& error) {
    return bad(fmt::format("its header is damaged ({})", error.what()));
  }
  const std::uint32_t traced = session.topography.columns > 0 ? scene::kTopography : scene::kNoHeightField;
  session.parameters.height_field = session.surface ? 0 : traced;
  const std::string wrong = what_cannot_be(session);
  if (!wrong.empty()) return bad(wrong);
  return session;
}

std::string cut_text(const RecordedSession& session, const std::string& path) {
  return fmt::format("session file {}: truncated after {:.3f} s; everything before is complete", path,
                     session.seconds_since_start(session.samples.back().time_ns));
}

}  // namespace afm::servo
