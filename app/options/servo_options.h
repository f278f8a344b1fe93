// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "servo/servo_choice.h"

namespace afm::app {

class OptionList;

// Adds --servo.
void add_servo_mode_option(OptionList& command, servo::ServoMode& mode);

}  // namespace afm::app
