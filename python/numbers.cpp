// SPDX-License-Identifier: Apache-2.0
#include "python/numbers.h"

#include <fmt/format.h>

#include <algorithm>

#include "python/errors.h"

namespace afm::python {

namespace py = pybind11;

std::string typed(std::optional<double> si, std::string_view unit) {
  return si ? fmt::format("{} {}", *si, unit) : std::string();
}

std::string keyword_of(std::string_view option) {
  std::string keyword(option);
  std::replace(keyword.begin(), keyword.end(), '-', '_');
  return keyword;
}

std::map<std::string, double, std::less<>> numbers_of(const py::kwargs& given) {
  std::map<std::string, double, std::less<>> numbers;
  for (const auto& [key, value] : given) {
    if (value.is_none()) continue;
    auto option = key.cast<std::string>();
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() != nullptr) {
      const bool too_large = PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
      PyErr_Clear();
      if (too_large) refuse(fmt::format("{}: a whole number so large is no float", option));
      not_numbers(option, "a number", value);
    }
    std::replace(option.begin(), option.end(), '_', '-');
    numbers[option] = number;
  }
  return numbers;
}

std::uint64_t whole_within(std::string_view name, const Whole& given, std::uint64_t least, std::uint64_t most) {
  const auto refused = [&](auto number) {
    refuse(fmt::format("{}: {} is outside {} to {}", name, number, least, most));
  };
  const auto* const with_sign = std::get_if<std::int64_t>(&given);  // numpy's integers, too
  if (with_sign != nullptr && *with_sign < 0) refused(*with_sign);
  const std::uint64_t number =
      with_sign != nullptr ? static_cast<std::uint64_t>(*with_sign) : std::get<std::uint64_t>(given);
  if (number < least || number > most) refused(number);
  return number;
}

void not_numbers(std::string_view name, std::string_view wanted, py::handle given) {
  const std::string text = py::str(py::module_::import("reprlib").attr("repr")(given));
  throw py::type_error(fmt::format("{}: give {}, not {}", name, wanted, text));
}

void unknown_keyword(std::string_view function, std::string_view keyword) {
  throw py::type_error(fmt::format("{}() got an unexpected keyword argument '{}'", function, keyword));
}

}  // namespace afm::python
