// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace afm::servo {

// File of a force map that is felt whole, or of which one pixel is felt. The forces follow from
// RecordedSession::law_map or its curve alone; the file is needed to show the map again (exhibit/frame/recorded_map.h).
struct RecordedForceMap {
  std::string file;                    // absolute path at the time of the recording
  std::string digest;                  // 64-bit FNV-1a of the file's bytes, 16 hexadecimal digits
  std::string reading;                 // reading of the file as JSON of curves/fitting/map_reading.h
  std::array<std::size_t, 2> pixel{};  // column and row of the curve that gives lever and appearance, or is felt

  bool operator==(const RecordedForceMap&) const = default;
};

}  // namespace afm::servo
