// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace afm::curves {

// A file of any size in memory, for a confined child to read: pages come from the disk as they are read. A process that
// touches bytes which another program has cut off dies, so the parent never reads them.
class MappedFile {
 public:
  // Throws CurveError with the reason: a folder, a pipe, an empty file, or one above 16 GiB.
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::string_view bytes() const { return {begin_, size_}; }

  // Returns the pages that have been read to the system; they come from the disk again.
  void forget() const;

 private:
  const char* begin_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace afm::curves
