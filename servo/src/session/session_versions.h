// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "servo/session_file.h"

namespace afm::servo {

// Version of a session file that consists of chunks. A session is written as the first version of session_versions()
// that it belongs to, so that an older program reads all that it can replay and refuses the rest by its number.
struct SessionVersion {
  std::uint32_t number;
  std::size_t sample_bytes;                // size of the beginning of a TipSample that the version keeps
  bool has_plans;                          // true: samples have the plans of pushes
  std::array<std::string_view, 3> chunks;  // chunks beyond HEAD, SURF, TOPO, PART and DONE, which all versions have
  bool (*is_of)(const RecordedSession& session);
};

std::span<const SessionVersion> session_versions();

const SessionVersion& version_of(const RecordedSession& session);

// Version with this number; null: no version with chunks has it.
const SessionVersion* find_version(std::uint32_t number);

bool may_have(const SessionVersion& version, std::string_view chunk);

}  // namespace afm::servo
