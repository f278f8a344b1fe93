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
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    std::replace(option.begin(), option.end(), '_', '-');
    numbers[option] = number;
  }
  return numbers;
}

std::uint64_t whole_within(std::string_view name, const Whole& given, std::uint64_t least, std::uint64_t most) {
  const auto refused = [&](auto number) {
    refuse(fmt::format("{}: {} is outside {} to {}", name, number, least, most));
  };
  if (const auto* negative = std::get_if<std::int64_t>(&given)) refused(*negative);
  const std::uint64_t number = std::get<std::uint64_t>(given);
  if (number < least || number > most) refused(number);
  return number;
}

void unknown_keyword(std::string_view function, std::string_view keyword) {
  throw py::type_error(fmt::format("{}() got an unexpected keyword argument '{}'", function, keyword));
}

}  // namespace afm::python
