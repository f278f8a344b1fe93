// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/recorded_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include "core/fnv1a.h"
#include "core/log.h"
#include "core/whole_file.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/fitting/map_reading.h"
#include "exhibit/frame/exhibit_setup.h"
#include "servo/session_file.h"

namespace afm::exhibit {

namespace {

constexpr std::size_t kDigestBlockBytes = std::size_t{1} << 20U;

// 64-bit FNV-1a of a file of any size, as 16 hexadecimal digits.
core::Result<std::string> digest_of_file(const std::string& path) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("force map {}: {}", path, why));
  };
  if (const std::string kind = core::kind_of_no_file(path); !kind.empty()) return bad("it is " + kind);
  std::ifstream file(path, std::ios::binary);
  if (!file) return bad("it cannot be opened");
  core::Fnv1a digest;
  std::vector<char> block(kDigestBlockBytes);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto end = block.begin() + file.gcount();
    std::for_each(block.begin(), end, [&](char byte) { digest.add(static_cast<unsigned char>(byte)); });
  }
  if (!file.eof()) return bad("it cannot be read to its end");
  return fmt::format("{:016x}", digest.value());
}

// Current place of the map of a session.
std::string place_of_map(const servo::RecordedForceMap& map, const std::string& session, const std::string& given) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (!given.empty()) return given;
  if (fs::exists(map.file, none)) return map.file;
  const fs::path beside = fs::path(session).parent_path() / fs::path(map.file).filename();
  return fs::exists(beside, none) ? beside.string() : map.file;
}

// Files that reproduce the map of a session. Fails if it cannot be read in the same way.
core::Result<ExhibitFiles> found_map(const servo::RecordedSession& session, const std::string& path,
                                     ExhibitFiles files) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("session file {}: {}", path, why));
  };
  const auto& map = session.force_map;
  if (!map) {
    return bad(
        "it does not name the force map that was felt, so no moment can be drawn; play it with "
        "touchafm view --haptics replay:FILE and the map's options");
  }
  auto reading = curves::map_reading_of(map->reading);
  if (!reading) return bad(reading.error().message);
  if (session.law_map && !reading->fit.shape) return bad("the reading of its force map is damaged: it has no fit");
  files.force_map = place_of_map(*map, path, files.force_map);
  std::error_code none;
  if (!std::filesystem::exists(files.force_map, none)) {
    return bad(
        fmt::format("its force map {} is missing; give the place of the file with --force-map", files.force_map));
  }
  const auto digest = digest_of_file(files.force_map);
  if (!digest) return bad(digest.error().message);
  if (*digest != map->digest) {
    return bad(
        fmt::format("{} is not the force map that was felt, or has changed since; give the file of then with "
                    "--force-map",
                    files.force_map));
  }
  files.map_reading = std::make_shared<const curves::MapReading>(std::move(*reading));
  files.pixel = map->pixel;
  files.whole_map = session.law_map != nullptr;
  files.viscous_map = session.parameters.viscous_map != 0;
  files.map_vibration = session.parameters.map_vibration;
  return files;
}

}  // namespace

core::Result<std::optional<servo::RecordedForceMap>> recorded_map_of(const Stage& stage, const ExhibitFiles& files) {
  if (!stage.pixel) return std::nullopt;
  auto digest = digest_of_file(files.force_map);
  if (!digest) return tl::unexpected(digest.error());
  std::error_code none;
  const auto place = std::filesystem::absolute(files.force_map, none).lexically_normal();
  const curves::MapPlace& pixel = stage.pixel->pixel->place;
  const curves::MapReading reading = files.map_reading ? *files.map_reading : curves::MapReading{};
  return servo::RecordedForceMap{.file = place.string(),
                                 .digest = std::move(*digest),
                                 .reading = curves::text_of(reading),
                                 .pixel = {pixel.column, pixel.row}};
}

core::Result<ExhibitFiles> with_recorded_map(const servo::RecordedSession& session, const std::string& path,
                                             ExhibitFiles files) {
  if (!session.law_map && !session.force_map) {
    if (files.force_map.empty()) return files;
    return core::wrong_usage("--force-map: the hand of this session felt no map, or it does not name it; leave it out");
  }
  // the curve of a pixel is drawn even without a picture of its map
  const bool needed = session.law_map || !files.force_map.empty();
  auto found = found_map(session, path, files);
  if (found || needed) return found;
  core::log_line(found.error().message + "; the picture of the map is left out");
  return files;
}

void compare_map(const servo::RecordedSession& session, const std::string& path, const Stage& stage) {
  if (!session.law_map || !stage.pixel || !stage.pixel->felt_map) return;
  const scene::SharedLawMap& then = *session.law_map;
  const scene::SharedLawMap& now = stage.pixel->felt_map->laws;
  const bool same = then.columns == now.columns && then.rows == now.rows && then.spacing_m == now.spacing_m &&
                    then.ln_modulus == now.ln_modulus && then.adhesion_j_per_m2 == now.adhesion_j_per_m2;
  if (same) return;
  core::log_line(fmt::format(
      "session file {}: this build of TouchAFM fits the force map differently; the picture may differ slightly", path));
}

}  // namespace afm::exhibit
