// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "physics/friction/friction_loop.h"
#include "servo/session_file.h"

namespace afm::servo {

// The friction loop of a session: the last whole cycle there and back, in the last contact that holds one, along the
// line on which the tip moved most. None where the tip was not led there and back, or without friction.
std::optional<physics::FrictionLoop> friction_loop(const RecordedSession& session);

}  // namespace afm::servo
