// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "servo/session_file.h"

namespace afm::servo {

// A chunk that keeps particles, a soft sample or ink, as they were when the session began.
struct ParticleChunk {
  std::string_view name;
  bool begins;          // true: alone or first; false: it follows the one that begins
  const char* damaged;  // error message if it cannot be read
  bool (*is_needed)(const RecordedParticles& particles);
  std::string (*bytes_of)(const RecordedParticles& particles);
  // False if the payload is damaged. The set as a whole is checked with its scene.
  bool (*read)(std::string_view payload, RecordedParticles& particles);
};

// All of them, in the order of a file.
std::span<const ParticleChunk> particle_chunks();

bool is_soft(const RecordedParticles& particles);    // true for a soft sample, which the tip scratches
bool is_ink(const RecordedParticles& particles);     // ink, with which the tip writes
bool has_level(const RecordedParticles& particles);  // particles at level 1 or 2

}  // namespace afm::servo
