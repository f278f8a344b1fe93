// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "physics/friction/friction_loop.h"
#include "servo/session_file.h"

namespace afm::servo {

// Friction loop of a session: the last whole cycle back and forth, in the last contact that has one, along the line of
// the largest motion. None without such a cycle, or without friction.
std::optional<physics::FrictionLoop> friction_loop(const RecordedSession& session);

}  // namespace afm::servo
