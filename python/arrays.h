// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "python/unlocked.h"

namespace afm::python {

// Argument of a caller for an array: any shape, stride and real number. It is converted to float64 once. Texts, times,
// complex numbers and None are refused as of a wrong type, though numpy would convert them.
class GivenArray : public pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast> {
 public:
  using array_t::array_t;

  // Numbers of an argument; empty for one without real numbers. A masked number is NaN.
  static std::optional<GivenArray> of(pybind11::handle given) {
    const auto any = pybind11::array::ensure(without_mask(given));
    if (!any || !has_numbers(any)) return std::nullopt;
    const pybind11::object numbers = ensure(any);
    if (!numbers) return std::nullopt;
    return GivenArray(numbers);
  }

 private:
  static pybind11::object without_mask(pybind11::handle given) {
    auto any = pybind11::reinterpret_borrow<pybind11::object>(given);
    if (!pybind11::isinstance<pybind11::array>(given) || !pybind11::hasattr(given, "mask")) return any;
    if (std::string_view("biuf").find(pybind11::cast<pybind11::array>(any).dtype().kind()) == std::string_view::npos) {
      return any;
    }
    return given.attr("astype")("f8").attr("filled")(std::numeric_limits<double>::quiet_NaN());
  }

  static bool has_numbers(const pybind11::array& given) {
    const char kind = given.dtype().kind();
    if (kind != 'O') return std::string_view("biuf").find(kind) != std::string_view::npos;
    for (const auto& each : given.attr("flat")) {
      if (PyNumber_Check(each.ptr()) == 0) return false;
    }
    return true;
  }
};

// Read-only view of one member of each row: no copy. `owner` keeps the rows alive.
template <class Row, class Member>
pybind11::array column(pybind11::handle owner, const std::vector<Row>& rows, const Member& member) {
  using Value = std::decay_t<decltype(member(rows.front()))>;
  pybind11::array_t<Value> view({static_cast<pybind11::ssize_t>(rows.size())},
                                {static_cast<pybind11::ssize_t>(sizeof(Row))},
                                rows.empty() ? nullptr : &member(rows.front()), owner);
  view.attr("setflags")(pybind11::arg("write") = false);
  return view;
}

// Read-only array with values that are computed for it.
template <class Rows, class Value>
pybind11::array computed(const Rows& rows, const Value& value) {
  using Element = std::decay_t<decltype(value(*std::begin(rows)))>;
  pybind11::array_t<Element> values(static_cast<pybind11::ssize_t>(std::size(rows)));
  Element* out = values.mutable_data();
  for (const auto& row : rows) *out++ = value(row);
  values.attr("setflags")(pybind11::arg("write") = false);
  return values;
}

// Applies a function to each number: an array of the same shape, or a float for a scalar.
template <class Function>
pybind11::object each(const GivenArray& given, const Function& function) {
  pybind11::array_t<double> result(std::vector<pybind11::ssize_t>(given.shape(), given.shape() + given.ndim()));
  const auto count = static_cast<std::size_t>(given.size());
  const double* in = given.data();
  double* out = result.mutable_data();
  constexpr std::size_t kUnwatched = 1'000'000;  // number of points between two checks for Ctrl-C
  for (std::size_t begin = 0; begin < count; begin += kUnwatched) {
    Unlocked unlocked;
    const std::size_t end = std::min(count, begin + kUnwatched);
    for (std::size_t i = begin; i < end; ++i) out[i] = function(in[i]);
    unlocked.lock();
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }
  if (given.ndim() == 0) return pybind11::float_(*out);
  return result;
}

}  // namespace afm::python

namespace pybind11::detail {

template <>
struct type_caster<afm::python::GivenArray> {
  PYBIND11_TYPE_CASTER(afm::python::GivenArray, const_name("numpy.ndarray[numpy.float64]"));

  bool load(handle given, bool) {
    auto numbers = afm::python::GivenArray::of(given);
    if (!numbers) return false;
    value = std::move(*numbers);
    return true;
  }
};

}  // namespace pybind11::detail
