// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unzip.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace afm::curves {

// Reads a zip archive in memory through minizip. The bytes must outlive the object. Lists the archive once, so that a
// map's million entries are found in no time and take 32 bytes each. Throws CurveError.
class ZipArchive {
 public:
  // `see` gets every name, in the order of the archive.
  explicit ZipArchive(std::string_view bytes, const std::function<void(std::string_view name)>& see = {});

  bool holds(std::string_view name) const { return find(name); }

  // The whole entry, unpacked. Throws if it does not exist or declares a size above `most_bytes`, because an entry of a
  // few kilobytes may unpack to gigabytes.
  std::string entry(std::string_view name, std::size_t most_bytes) const;

 private:
  struct Place {
    std::size_t hash;  // hash of the name
    unz64_file_pos at;
  };

  // Makes the entry the archive's current one; false without it.
  bool find(std::string_view name) const;

  // Source of minizip's reads.
  struct Cursor {
    std::string_view bytes;
    std::size_t at = 0;
  };
  friend struct ZipCallbacks;

  std::unique_ptr<Cursor> cursor_;
  std::unique_ptr<void, decltype(&unzClose)> archive_;
  std::vector<Place> places_;  // by hash
};

}  // namespace afm::curves
