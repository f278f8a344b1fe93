// SPDX-License-Identifier: Apache-2.0
#include "curves/unread_kinds.h"

#include <algorithm>
#include <array>

namespace afm::curves {

namespace {

// Kinds of file that people bring and that have no reader here, by the bytes at `offset`.
struct UnreadKind {
  std::size_t offset;
  std::string_view bytes;
  std::string_view kind;
};

template <std::size_t Size>
constexpr std::string_view with_nuls(const char (&literal)[Size]) {
  return {literal, Size - 1};
}

constexpr std::array kUnreadKinds{
    UnreadKind{0, "\\*Force file list", "a Nanoscope force curve or force volume, which is not read"},
    UnreadKind{8, "ARDF", "a force map of Asylum Research (.ardf), which is not read"},
    UnreadKind{0, "\x01\xb0\x93\xff", "a file of NT-MDT (.mdt), which is not read"},
    UnreadKind{0, "[DataSet]", "a file of Nanosurf (.nid), which is not read"},
    UnreadKind{0, ":NANONIS_VERSION:", "a scan of Nanonis (.sxm), which is not read"},
    UnreadKind{0, "WSxM file", "a file of WSxM, which is not read"},
    UnreadKind{2, with_nuls("S\0T\0i\0M\0a\0g\0e\0"), "a file of RHK (.sm4), which is not read"},
    UnreadKind{0, "MATLAB 5.0", "a file of MATLAB, which is not read"},
    UnreadKind{0, "\x93NUMPY", "an array of NumPy, which has no units"},
    UnreadKind{0, "\x1f\x8b", "packed by gzip; unpack it first"},
    UnreadKind{0, "7z\xbc\xaf\x27\x1c", "an archive of 7-Zip; unpack it first"},
    UnreadKind{0, "Rar!", "an archive of RAR; unpack it first"},
    UnreadKind{0, "version https://git-lfs", "a pointer of Git LFS, not the file itself; get that by \"git lfs pull\""},
    UnreadKind{0, "<!DOCTYPE", "a web page, perhaps in place of a download"},
    UnreadKind{0, "<!doctype", "a web page, perhaps in place of a download"},
    UnreadKind{0, "<html", "a web page, perhaps in place of a download"},
    UnreadKind{0, "\xff\xfe", "text in UTF-16; save it as UTF-8"},
    UnreadKind{0, "\xfe\xff", "text in UTF-16; save it as UTF-8"},
    UnreadKind{0, "\x89PNG", "a PNG picture, which has no heights"},
    UnreadKind{0, "\xff\xd8\xff", "a JPEG picture, which has no heights"},
    UnreadKind{0, "%PDF", "a PDF document"}};

constexpr bool all_within_the_beginning() {
  return std::all_of(kUnreadKinds.begin(), kUnreadKinds.end(),
                     [](const UnreadKind& row) { return row.offset + row.bytes.size() <= kUnreadKindBytes; });
}
static_assert(all_within_the_beginning());

}  // namespace

std::string_view unread_kind_of(std::string_view beginning) {
  const auto begins = [&](const UnreadKind& row) {
    return beginning.size() > row.offset && beginning.substr(row.offset).starts_with(row.bytes);
  };
  const auto found = std::find_if(kUnreadKinds.begin(), kUnreadKinds.end(), begins);
  return found != kUnreadKinds.end() ? found->kind : std::string_view{};
}

std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
}

}  // namespace afm::curves
