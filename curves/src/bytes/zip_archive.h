// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unzip.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afm::curves {

// Reads a zip archive in memory. The bytes must outlive the object. Lists the archive once, so that a map's million
// entries are found in no time and take 32 bytes each; plain entries are unpacked by zlib itself, any others through
// minizip, whose preparations take longer than a short entry. Throws CurveError. One thread.
class ZipArchive {
 public:
  // `see` gets every name, in the order of the archive.
  explicit ZipArchive(std::string_view bytes, const std::function<void(std::string_view name)>& see = {});

  bool holds(std::string_view name) const { return find(name).has_value(); }

  // The whole entry, unpacked. Throws if it does not exist or declares a size above `most_bytes`, because an entry of a
  // few kilobytes may unpack to gigabytes.
  std::string entry(std::string_view name, std::size_t most_bytes) const;

 private:
  struct Place {
    std::size_t hash = 0;  // hash of the name
    unz64_file_pos at{};
  };

  void sort_by_hash();

  // Empty without it. Looks first where the last one was found, and behind it: a map is read in its order.
  std::optional<Place> find(std::string_view name) const;

  std::string unpacked(const Place& place, std::string_view name, std::size_t most_bytes) const;

  // Source of minizip's reads.
  struct Cursor {
    std::string_view bytes;
    std::size_t at = 0;
  };
  friend struct ZipCallbacks;

  // zlib's state, made once.
  class Inflater {
   public:
    Inflater() = default;
    ~Inflater() { ::inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    // Unpacks all of `packed` to exactly `bytes`; false if it does not.
    bool unpack(std::string_view packed, std::string& bytes);

   private:
    z_stream stream_{};
    bool made_ = false;
  };

  std::unique_ptr<Cursor> cursor_;
  std::unique_ptr<void, decltype(&unzClose)> archive_;
  bool listed_here_ = true;              // false: by minizip, which knows where the headers are
  std::vector<Place> places_;            // by the first bits of the hash, then as in the archive
  std::vector<std::uint32_t> begin_of_;  // first place by the first bits of its hash
  unsigned begin_shift_ = 0;             // bits of a hash that do not count there
  mutable Inflater inflater_;
  bool in_order_ = false;          // entries may be looked for where the last one was found
  mutable Place last_{}, next_{};  // place found last, and the one behind it
};

}  // namespace afm::curves
