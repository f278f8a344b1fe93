// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "servo/servo_client.h"

namespace CLI {
class App;
}

namespace afm::app {

// --servo.
void add_servo_mode_option(CLI::App& command, servo::ServoMode& mode);

}  // namespace afm::app
