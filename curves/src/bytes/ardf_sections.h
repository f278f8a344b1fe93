// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bytes/file_bytes.h"

// Sections of Asylum Research's .ardf: a head of 16 bytes, with the checksum of what follows it, the size, a name of
// four letters and flags, then the contents; little-endian. As MagicAFM and M. Poss's readARDF describe them.
namespace afm::curves {

inline constexpr std::size_t kArdfHead = 16;

// A whole section, its head included.
struct ArdfSection {
  std::size_t offset = 0;  // offset in the file
  std::string_view name, bytes;

  std::size_t end() const { return offset + bytes.size(); }
};

// The section at `offset`. Throws CurveError for one that leaves the file, has another name than `wanted`, unless that
// is empty, or a wrong checksum.
ArdfSection ardf_section(std::string_view file, std::uint64_t offset, std::string_view wanted = {});

// A section of 32 bytes and the table that follows it. Each entry has `stride` bytes and its own header.
struct ArdfTable {
  std::vector<ArdfSection> entries;  // entries in use; the rest of the table is zero
  std::size_t end = 0;               // end of the table in the file
};
ArdfTable ardf_table(std::string_view file, std::uint64_t offset, std::string_view name, std::size_t stride);

// Text of at most `size` bytes, ended by a zero or by its size.
std::string_view ardf_text(const ArdfSection& section, std::size_t offset, std::size_t size);

}  // namespace afm::curves
