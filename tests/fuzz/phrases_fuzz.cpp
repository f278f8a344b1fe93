// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdlib>

#include "exhibit/message_catalog.h"
#include "fuzz/memory_file.h"

// Whatever the bytes: every phrase that was asked for, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  constexpr std::array<std::string_view, 1> kKeys{"lift"};
  constexpr std::array<std::string_view, 1> kOptionalKeys{"mouse-up"}, kPlaces{"{up}"};
  const auto phrases =
      afm::exhibit::load_messages(file.path(), {.keys = kKeys, .optional_keys = kOptionalKeys, .places = kPlaces});
  if (phrases && (phrases->size() != 2 || phrases->front().empty())) std::abort();
  return 0;
}
