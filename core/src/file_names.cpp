// SPDX-License-Identifier: Apache-2.0
#include "core/file_names.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace afm::core {

namespace {

constexpr std::array<std::string_view, 32> kKnownEndings{
    ".mp3",  ".ogg",  ".flac", ".m4a", ".svg", ".png",  ".jpg", ".jpeg", ".gif",  ".bmp", ".tif",
    ".tiff", ".webp", ".pdf",  ".eps", ".ps",  ".html", ".htm", ".doc",  ".docx", ".odt", ".xls",
    ".xlsx", ".ods",  ".mat",  ".npy", ".npz", ".zip",  ".gz",  ".wav",  ".mp4",  ".webm"};

}  // namespace

std::string in_file_name(std::string_view name) {
  std::string part;
  for (const char letter : name) {
    if (letter == '/') {
      part += "%2F";
    } else {
      part += letter;
    }
  }
  return part;
}

bool has_ending(std::string_view name, std::string_view ending) {
  const auto small = [](char letter) { return std::tolower(static_cast<unsigned char>(letter)); };
  return name.size() > ending.size() && std::equal(ending.rbegin(), ending.rend(), name.rbegin(),
                                                   [&](char a, char b) { return small(a) == small(b); });
}

bool is_named_as_another(std::string_view name, std::string_view own) {
  return std::any_of(kKnownEndings.begin(), kKnownEndings.end(),
                     [&](std::string_view ending) { return ending != own && has_ending(name, ending); });
}

}  // namespace afm::core
