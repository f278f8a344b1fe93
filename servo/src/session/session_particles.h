// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "servo/session_file.h"

namespace afm::servo {

// Chunk with particles, a soft sample or ink as they were when the session began.
struct ParticleChunk {
  std::string_view name;
  bool begins;          // true: the chunk is the only or the first one; false: it follows another
  const char* damaged;  // error message for a damaged payload
  bool (*is_needed)(const RecordedParticles& particles);
  std::string (*bytes_of)(const RecordedParticles& particles);
  // Reads a payload; false if it is damaged. The set as a whole is checked with its scene.
  bool (*read)(std::string_view payload, RecordedParticles& particles);
};

// All kinds of chunks, in the order of a file.
std::span<const ParticleChunk> particle_chunks();

bool is_soft(const RecordedParticles& particles);    // true for a soft sample, which the tip scratches
bool is_ink(const RecordedParticles& particles);     // true for ink, with which the tip writes
bool has_level(const RecordedParticles& particles);  // true for particles at level 1 or 2

}  // namespace afm::servo
