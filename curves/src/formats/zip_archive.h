// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unzip.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace afm::curves {

// A zip archive in memory, to be read through minizip. The bytes must outlive it. Throws CurveError.
class ZipArchive {
 public:
  explicit ZipArchive(std::string_view bytes);

  bool holds(const std::string& name) const;
  bool holds_folder(std::string_view prefix) const;

  // The whole entry, unpacked. Throws if there is none or if it says that it is larger than `most_bytes`: an entry of a
  // few kilobytes may unpack to gigabytes.
  std::string entry(const std::string& name, std::size_t most_bytes) const;

 private:
  std::unique_ptr<void, decltype(&unzClose)> archive_;
};

}  // namespace afm::curves
