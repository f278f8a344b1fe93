// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>

#include <array>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/shared/fault_codes.h"

namespace afm::app {

// What ends the force, sent as a signal to the renderer's process, and within how long the hand must feel none.
struct Release {
  const char* name;
  const char* what;  // happens to the renderer while the hand is held
  int signal;
  scene::FaultCode fault;  // that the servo then says
  double bar_ms;
};

inline constexpr std::array kReleases{
    Release{"killed", "is killed", SIGKILL, scene::FaultCode::RendererDied, 30.0},
    Release{"stopped", "is stopped", SIGSTOP, scene::FaultCode::RendererHung, 350.0},
    Release{"stop-key", "is told to stop the force", SIGUSR1, scene::FaultCode::StopPressed, 30.0}};

// How long the hand still felt a force after the signal, milliseconds, once for each round: a renderer in a process of
// its own starts touchafm-servo, which lies beside `program`, and holds the tip on the sample; then it is sent the
// signal. A round in which the machine made the servo let go before is done again. The caller has one thread only. Two
// seconds a round.
core::Result<std::vector<double>> measure_reaction(const std::string& program, const Release& release, int rounds);

}  // namespace afm::app
