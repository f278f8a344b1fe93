// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

// Pages and tags of a TIFF 6.0 file. Read without libtiff, because AFM programs write a dozen tags of uncompressed
// numbers, most of them their own. Throws CurveError.
namespace afm::curves {

// Returns whether the bytes begin like a TIFF.
bool looks_like_tiff(std::string_view bytes);

std::endian tiff_order(std::string_view file);
std::size_t tiff_first_page(std::string_view file);  // offset of the first page

// One page of a TIFF. Refers to the bytes of the file, which must outlive it.
class TiffPage {
 public:
  TiffPage(std::string_view file, std::size_t offset, std::endian order);

  std::size_t next() const { return next_; }  // offset of the next page in the file; 0: none

  // Number of a tag; empty if the page has none.
  std::optional<double> number(unsigned tag, std::size_t index = 0) const;

  std::size_t count(unsigned tag) const;       // number of values of a tag
  std::string text(unsigned tag) const;        // text of a tag; empty: none
  std::string_view bytes(unsigned tag) const;  // value of any type as in the file; empty without the tag

 private:
  struct Entry {
    std::uint16_t type = 0;
    std::size_t count = 0;
    std::string_view bytes;
  };
  const Entry* find(unsigned tag) const;

  std::map<std::uint16_t, Entry> entries_;
  std::endian order_;
  std::size_t next_ = 0;
};

// The first `size` bytes of a page's pixels, strip by strip, each with a whole number of rows.
std::string tiff_strips(std::string_view file, const TiffPage& page, std::size_t size);

}  // namespace afm::curves
