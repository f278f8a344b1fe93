// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unzip.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace afm::curves {

// Reads a zip archive in memory through minizip. The bytes must outlive the object. Throws CurveError.
class ZipArchive {
 public:
  explicit ZipArchive(std::string_view bytes);

  bool holds(const std::string& name) const;
  bool holds_folder(std::string_view prefix) const;

  // The whole entry, unpacked. Throws if it does not exist or declares a size above `most_bytes`, because an entry of a
  // few kilobytes may unpack to gigabytes.
  std::string entry(const std::string& name, std::size_t most_bytes) const;

 private:
  std::unique_ptr<void, decltype(&unzClose)> archive_;
};

}  // namespace afm::curves
