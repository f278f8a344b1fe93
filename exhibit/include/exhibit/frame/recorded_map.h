// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.h"
#include "exhibit/frame/exhibit_files.h"

namespace afm::servo {
struct RecordedForceMap;
struct RecordedSession;
}  // namespace afm::servo

namespace afm::exhibit {

struct Stage;

// File of this stage's map, for its sessions, and the way it was read; empty: no map.
// `files` are those of the stage. Reads the whole file, 1 GB in about a second: BadInputFile if it cannot be read.
core::Result<std::optional<servo::RecordedForceMap>> recorded_map_of(const Stage& stage, const ExhibitFiles& files);

// Adds the map of a session, read again as it was, to the files that draw a moment of it; without a map nothing
// changes. ExhibitFiles::force_map may name its place; otherwise it lies where it was recorded, or, under the same
// name, beside the session's file `path`. BadInputFile, naming the session, if an older TouchAFM has recorded a map
// that was felt whole, and if that map, or the one that `files` name, is missing or has other bytes. If one pixel was
// felt, a line of the log says so instead, and nothing changes: the session has the curve of its pixel.
core::Result<ExhibitFiles> with_recorded_map(const servo::RecordedSession& session, const std::string& path,
                                             ExhibitFiles files);

// Logs a remark if the stage's map, read again, differs from the one that the session felt: another build fits it.
void compare_map(const servo::RecordedSession& session, const std::string& path, const Stage& stage);

}  // namespace afm::exhibit
