// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "arguments.h"
#include "core/base64.h"

namespace afm::instrument {

// Encoder of one answer's arrays: as numbers, null where there is none, or packed as the bytes of 64-bit floats.
class AnswerArrays {
 public:
  explicit AnswerArrays(const Arguments& arguments) : packed_(arguments.packs_arrays()) {}

  nlohmann::ordered_json of(const std::vector<double>& numbers) const {
    static_assert(std::endian::native == std::endian::little && sizeof(double) == 8);
    nlohmann::ordered_json json;
    if (packed_) {
      json["base64"] = core::base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)});
      return json;
    }
    json = nlohmann::ordered_json::array();
    for (const double number : numbers) {
      json.push_back(std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr));
    }
    return json;
  }

  // Array of one value of each row.
  template <class Rows, class Value>
  nlohmann::ordered_json of(const Rows& rows, const Value& value) const {
    std::vector<double> numbers;
    numbers.reserve(rows.size());
    for (const auto& row : rows) numbers.push_back(value(row));
    return of(numbers);
  }

 private:
  bool packed_;
};

}  // namespace afm::instrument
