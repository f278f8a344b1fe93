// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace afm::python {

// A number in SI as a person would type it, with all digits: "5e-08 m". Empty for an empty number.
std::string typed(std::optional<double> si, std::string_view unit);

// An integer as given by the caller, in or out of range; a narrower type would be refused with a wrong reason.
using Whole = std::variant<std::uint64_t, std::int64_t>;

// ValueError with the name of the argument unless it is within `least` to `most`.
std::uint64_t whole_within(std::string_view name, const Whole& given, std::uint64_t least, std::uint64_t most);

// Keyword for an option: "tip_radius" for --tip-radius.
std::string keyword_of(std::string_view option);

// The numbers among keyword arguments, by the names of options without dashes. None is as if it were not given.
// TypeError, with the keyword, for a value that is no number.
std::map<std::string, double, std::less<>> numbers_of(const pybind11::kwargs& given);

// TypeError that names the argument and the type of what was given in place of "a number".
[[noreturn]] void not_numbers(std::string_view name, std::string_view wanted, pybind11::handle given);

// Throws the TypeError that Python raises for a keyword that a function does not have.
[[noreturn]] void unknown_keyword(std::string_view function, std::string_view keyword);

}  // namespace afm::python
