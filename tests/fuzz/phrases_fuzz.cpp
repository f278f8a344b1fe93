// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "exhibit/words/phrases.h"
#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"

// Whatever the bytes: phrases within their limits with the placeholders that they need, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using afm::exhibit::Phrase;
  using afm::exhibit::Phrases;
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto phrases = Phrases::load(file.path(), Phrases{});
  if (!phrases) return 0;
  ++afm::fuzz::accepted_inputs;
  if ((*phrases)[Phrase::Lift].size() > 4 * afm::exhibit::kLine) std::abort();
  const std::string journey = phrases->text<Phrase::Journey>(std::string("1.5"));
  if (!(*phrases)[Phrase::Journey].empty() && journey.find("{place}") != std::string::npos) std::abort();
  return 0;
}
