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

inline constexpr std::array kReleases{Release{"killed", "is killed", SIGKILL, scene::FaultCode::RendererDied, 30.0},
                                      Release{"stopped", "is stopped", SIGSTOP, scene::FaultCode::RendererHung, 350.0},
                                      Release{"stop-key", "sends Stop", SIGUSR1, scene::FaultCode::StopPressed, 30.0}};

// Time from the signal to zero force, milliseconds, one value per round. In each round a renderer in a separate process
// starts touchafm-servo from the folder of `program` and holds the tip on the sample; then it is sent the signal.
// Repeats a round in which the load on the machine made the servo release the hand early. The caller has one thread
// only. Two seconds a round.
core::Result<std::vector<double>> measure_reaction(const std::string& program, const Release& release, int rounds);

}  // namespace afm::app
