// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::core {

// Gives every thread of this process the nice value of its first thread, so that it gets its turn on a busy machine: a
// process that ends stays until each of its threads has run once more, and Mesa's cache of shaders runs at nice 19.
// Without the right to raise a priority (RLIMIT_NICE), nothing changes. Any thread; must not be called by a servo.
void hurry_threads();

}  // namespace afm::core
