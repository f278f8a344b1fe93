// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace afm::curves {

// The name of a file's kind with what to do, for use behind "it is", if no reader here takes it: "a scan of Nanonis
// (.sxm), which is not read". Looks at core::kFileKindBytes of the beginning. Empty for any other file.
std::string unread_kind_of(std::string_view beginning, std::uint64_t file_size);

// Refuses a file that is no text: by its kind, or with the advice to save it as UTF-8. Throws CurveError.
[[noreturn]] void refuse_no_text(std::string_view bytes);

// Text files that Windows editors save begin with a byte order mark, which means nothing in UTF-8.
std::string_view without_byte_order_mark(std::string_view bytes);

}  // namespace afm::curves
