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

// Loads the wall as recorded in the session, read from `path`: the paper's three materials together, any other
// material by itself, particles where they lay, and a map with its curves or its picture (exhibit/recorded_map.h).
// Its materials include the session's own. `files` are those named by the user. Errors name the session if it is at
// fault.
core::Result<exhibit::Stage> stage_of_session(const servo::RecordedSession& session, const std::string& path,
                                              const exhibit::ExhibitFiles& files);

// Materials of that stage; the session's own with the parameters that were felt.
core::Result<std::vector<curves::SampleModel>> models_of_session(const servo::RecordedSession& session,
                                                                 const exhibit::Stage& stage);

}  // namespace afm::app
