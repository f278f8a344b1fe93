// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/shared_picture.h"

#include <algorithm>

#include "cluster/messages.h"
#include "exhibit/cluster/wall_history.h"
#include "exhibit/state/particles_now.h"

namespace afm::exhibit {

static_assert(static_cast<std::uint32_t>(servo::Known::Stale) == cluster::PictureRecord::kMostKnown);

cluster::PictureRecord record_of(const ParticlesNow& now) {
  if (now.picture == nullptr) return {};
  const servo::PictureNow& picture = *now.picture;
  const servo::LookResult& newest = picture.newest;
  return {.level = picture.level,
          .particle = static_cast<std::uint32_t>(picture.particle),
          .all_measured = picture.all_measured ? 1U : 0U,
          .looks = static_cast<std::uint32_t>(picture.looks),
          .newest_particle = static_cast<std::uint32_t>(newest.particle),
          .newest_lines = static_cast<std::uint32_t>(newest.lines),
          .newest_found = newest.off_m ? 1U : 0U,
          .looking = picture.look_share ? 1U : 0U,
          .look_share = picture.look_share.value_or(0.0),
          .age_s = picture.age_s,
          .doubt_m = picture.doubt_m,
          .newest_off_m = newest.off_m.value_or(0.0),
          .newest_swept_above_n = newest.swept_above_n,
          .look_load_n = now.look_load_n};
}

std::optional<servo::PictureNow> picture_of(const WallHistory& history, std::size_t count) {
  const cluster::PictureRecord& record = history.picture;
  if (record.level == 0 || record.particle >= count) return std::nullopt;
  servo::PictureNow picture{.level = record.level,
                            .particle = record.particle,
                            .age_s = record.age_s,
                            .doubt_m = record.doubt_m,
                            .all_measured = record.all_measured != 0,
                            .looks = record.looks,
                            .newest = {.particle = record.newest_particle,
                                       .lines = record.newest_lines,
                                       .swept_above_n = record.newest_swept_above_n}};
  if (record.looking != 0) picture.look_share = record.look_share;
  if (record.newest_found != 0) picture.newest.off_m = record.newest_off_m;
  picture.known.assign(count, servo::Known::Measured);
  for (std::size_t i = 0; i < std::min(count, history.known.size()); ++i) {
    picture.known[i] = static_cast<servo::Known>(history.known[i]);
  }
  return picture;
}

}  // namespace afm::exhibit
