// SPDX-License-Identifier: Apache-2.0
#include "images/nhf_pages.h"

#include <algorithm>

#include "confined/confined_child.h"
#include "formats/format_table.h"
#include "images/gwy_image.h"

namespace afm::curves {

namespace {

bool has_near_the_front(std::string_view bytes, std::string_view text) {
  constexpr std::size_t kNear = 65536;
  return bytes.substr(0, kNear).find(text) != std::string_view::npos;
}

}  // namespace

bool is_nhf(std::string_view bytes) {
  return bytes.starts_with("\x89HDF\r\n\x1a\n") && has_near_the_front(bytes, "nsf_file_version_major");
}

bool begins_as_nhf(std::string_view bytes) {
  return is_nhf(bytes) && (has_near_the_front(bytes, "image_line_based") || !has_near_the_front(bytes, "spectroscopy"));
}

std::string nhf_as_gwy(std::string_view bytes) {
  return from_confined_program("touchafm-hdf5", {"image"}, bytes, kNotSurvived);
}

ImagePages read_nhf_pages(std::string_view gwy) {
  ImagePages found = read_gwy(gwy);
  const auto is_unread = [](const auto& entry) { return entry.first.starts_with(kUnreadPrefix); };
  for (const auto& entry : found.metadata) {
    if (is_unread(entry)) found.unread.push_back({entry.first.substr(kUnreadPrefix.size()), entry.second});
  }
  std::erase_if(found.metadata, is_unread);
  return found;
}

}  // namespace afm::curves
