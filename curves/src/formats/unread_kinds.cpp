// SPDX-License-Identifier: Apache-2.0
#include "curves/unread_kinds.h"

#include <fmt/core.h>

#include "core/file_kind.h"
#include "curves/curve_error.h"

namespace afm::curves {

std::string unread_kind_of(std::string_view beginning, std::uint64_t file_size) {
  const auto kind = core::file_kind(beginning.substr(0, core::kFileKindBytes), file_size);
  if (!kind) return "";
  const std::string_view remedy = core::remedy_of(kind->role);
  return remedy.empty() ? fmt::format("{}, which is not read", kind->name) : fmt::format("{}; {}", kind->name, remedy);
}

void refuse_no_text(std::string_view bytes) {
  const std::string kind = unread_kind_of(bytes, bytes.size());
  throw CurveError("it is " + (kind.empty() ? "no plain text, or UTF-16; save it as UTF-8" : kind));
}

std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
}

}  // namespace afm::curves
