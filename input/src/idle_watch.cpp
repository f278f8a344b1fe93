// SPDX-License-Identifier: Apache-2.0
#include "input/idle_watch.h"

#include <utility>

namespace afm::input {

IdleWatch::Change IdleWatch::update(bool used, std::int64_t now_ns) {
  if (used || !std::exchange(began_, true)) used_ns_ = now_ns;
  const bool was_away = std::exchange(away_, now_ns - used_ns_ >= patience_ns_);
  if (away_ == was_away) return Change::None;
  return away_ ? Change::WentAway : Change::CameBack;
}

}  // namespace afm::input
