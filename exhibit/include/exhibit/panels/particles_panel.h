// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/state/particles_now.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// The clock of the task, or its score once it is done; the plan of a push, with the aim and the speed that it needs;
// the state of the push in words, its forces, the threshold of the touched particle by the law of its species and, in
// brackets, by the other law, and the numbers of the file, whose sources are details and left out. Without a
// touched particle, values are those of the first particle's species.
render::DataPanel particles_panel(const ParticlesNow& now, const Phrases& phrases);

}  // namespace afm::exhibit
