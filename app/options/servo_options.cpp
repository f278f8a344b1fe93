// SPDX-License-Identifier: Apache-2.0
#include "app/options/servo_options.h"

#include <array>

#include "app/options/enum_option.h"
#include "core/enumerators.h"

namespace afm::app {

namespace {

struct NamedServoMode {
  servo::ServoMode mode;
  const char* name;
};

constexpr std::array kServoModes{NamedServoMode{servo::ServoMode::Process, "process"},
                                 NamedServoMode{servo::ServoMode::Thread, "thread"}};
static_assert(core::has_row_for_each(kServoModes, &NamedServoMode::mode));

}  // namespace

void add_servo_mode_option(OptionList& command, servo::ServoMode& mode) {
  enum_option(command, "--servo", mode, "a way to run the servo", kServoModes, &NamedServoMode::name,
              &NamedServoMode::mode,
              "run the servo as a process, or as a thread for debuggers and sanitizers; default: process");
}

}  // namespace afm::app
