// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>

#include <array>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/shared/fault_codes.h"

namespace afm::app {

// A signal to the renderer's process that must end the force, and the longest time until the force is zero.
struct Release {
  const char* name;
  const char* what;  // end of a sentence: event in the renderer while the hand is held
  int signal;
  scene::FaultCode fault;  // fault that the servo should report
  double bar_ms;
};

inline constexpr std::array kReleases{Release{"killed", "is killed", SIGKILL, scene::FaultCode::RendererDied, 30.0},
                                      Release{"stopped", "is stopped", SIGSTOP, scene::FaultCode::RendererHung, 350.0},
                                      Release{"stop-key", "sends Stop", SIGUSR1, scene::FaultCode::StopPressed, 30.0}};

// Times from the signal to zero force, milliseconds, one value per round of about two seconds. In each round a separate
// renderer process starts touchafm-servo from the folder of `program`, holds the tip on the sample and gets the signal.
// Repeats a round in which load on the machine made the servo release the hand early. Forks, so the caller must have
// only one thread.
core::Result<std::vector<double>> measure_reaction(const std::string& program, const Release& release, int rounds);

}  // namespace afm::app
