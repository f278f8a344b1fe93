// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace afm::support {

using Tokens = std::vector<std::string>;

// Words, numbers, "::" and single other characters of a C++ source. A literal is one token; comments and directives are
// left out.
Tokens tokens_of(std::string_view source);

bool is_name(const std::string& token);

// Index after the bracket that closes the one at `at`.
std::size_t after_bracket(const Tokens& tokens, std::size_t at);

}  // namespace afm::support
