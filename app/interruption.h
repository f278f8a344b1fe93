// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::app {

// From now on SIGINT and SIGTERM only set a flag, so that the run ends in good order: the servo fades the force,
// nothing is left half-written. Once, from main.
void catch_interruptions();

// Whether one of them has come. Any thread.
bool interrupted();

}  // namespace afm::app
