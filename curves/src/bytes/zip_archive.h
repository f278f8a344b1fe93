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
    std::size_t hash = 0;  // hash of the entry's name
    unz64_file_pos at{};
  };

  void sort_by_hash();

  // Place of an entry; empty if there is none. Looks first near the last one found, because a map is read in order.
  std::optional<Place> find(std::string_view name) const;

  std::string unpacked(const Place& place, std::string_view name, std::size_t most_bytes) const;

  // Source of minizip's reads.
  struct Cursor {
    std::string_view bytes;
    std::size_t at = 0;
  };
  friend struct ZipCallbacks;

  // State of zlib, created once.
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
  bool listed_here_ = true;              // false: entries listed by minizip, which knows where the headers are
  std::vector<Place> places_;            // places by the first bits of the hash, then as in the archive
  std::vector<std::uint32_t> begin_of_;  // index of the first place for the first bits of a hash
  unsigned begin_shift_ = 0;             // number of bits of a hash that do not count for begin_of_
  mutable Inflater inflater_;
  bool in_order_ = false;          // true: search begins where the last entry was found
  mutable Place last_{}, next_{};  // place found last, and the next one
};

}  // namespace afm::curves
