// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace afm::curves {

// Bytes of a file's beginning that unread_kind_of() looks at.
inline constexpr std::size_t kUnreadKindBytes = 64;

// The name of a file's kind, for use behind "it is", if no reader here takes it: "a scan of Nanonis (.sxm), which is
// not read". Empty for any other file.
std::string_view unread_kind_of(std::string_view beginning);

// Text files that Windows editors save begin with a byte order mark, which means nothing in UTF-8.
std::string_view without_byte_order_mark(std::string_view bytes);

}  // namespace afm::curves
