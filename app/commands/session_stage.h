// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace afm::curves {
struct SampleModel;
}
namespace afm::exhibit {
struct ExhibitFiles;
struct Stage;
}  // namespace afm::exhibit
namespace afm::servo {
struct RecordedSession;
}

namespace afm::app {

// Loads the wall as far as the session, read from `path`, records it: the paper's three materials together, any other
// material by itself, particles as they lay, and a map with its curves or its picture (exhibit/recorded_map.h).
// Its materials include the session's own. `files` are those that the user names. Errors name the session if it is at
// fault.
core::Result<exhibit::Stage> stage_of_session(const servo::RecordedSession& session, const std::string& path,
                                              const exhibit::ExhibitFiles& files);

// The materials of that stage, the session's own as it was felt.
core::Result<std::vector<curves::SampleModel>> models_of_session(const servo::RecordedSession& session,
                                                                 const exhibit::Stage& stage);

}  // namespace afm::app
