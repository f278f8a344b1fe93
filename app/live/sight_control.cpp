// SPDX-License-Identifier: Apache-2.0
#include "app/live/sight_control.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/display/view_picture.h"
#include "app/display/view_windows.h"
#include "app/view/view_parts.h"
#include "core/clock.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"

namespace afm::app {

namespace {

constexpr std::int64_t kUnseenNs = 250'000'000;  // longest time without a visible picture
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min() / 2;

}  // namespace

SightControl::SightControl(ViewParts& parts)
    : parts_(parts),
      shows_stage_(!parts.windows.that_show(parts.stage.wall_scene.contact_m()).empty()),
      sight_(shows_stage_ ? parts.windows.that_show(parts.stage.wall_scene.contact_m()) : parts.windows.all(),
             parts.clock) {
  parts_.turn.unseen = [this](std::int64_t now_ns) { return blind(now_ns); };
}

std::int64_t SightControl::last_seen_ns(std::int64_t now_ns) const {
  const auto& elsewhere_ns = parts_.turn.seen_elsewhere_ns;
  const std::int64_t there_ns = elsewhere_ns ? elsewhere_ns(now_ns) : kNever;
  if (elsewhere_ns && !shows_stage_) return there_ns;
  const std::int64_t here_ns =
      std::min(sight_.unseen_since_ns().value_or(now_ns), parts_.picture.refused_since_ns().value_or(now_ns));
  return std::max(here_ns, there_ns);
}

bool SightControl::blind(std::int64_t now_ns) const { return now_ns - last_seen_ns(now_ns) >= kUnseenNs; }

std::string SightControl::cause() const {
  if (parts_.turn.seen_elsewhere_ns && !shows_stage_)
    return "the machine that shows the sample is missing or shows none";
  const render::Sight sight = sight_.newest();
  return sight == render::Sight::Seen ? "the display takes no picture" : text_of(sight);
}

void SightControl::begin_frame() {
  const bool blind = this->blind(parts_.clock.now_ns());
  if (std::exchange(logged_blind_, blind) == blind) return;
  core::log_line(blind ? "nobody sees the picture: " + cause() : "the picture is seen again");
}

}  // namespace afm::app
