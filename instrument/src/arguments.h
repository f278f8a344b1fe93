// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

namespace afm::instrument {

// The members of a request. Each accessor checks sort and range, and throws RefusedRequest, as finish() does for a
// member that no accessor requested: a misspelled name must not act as its default.
class Arguments {
 public:
  explicit Arguments(const nlohmann::ordered_json& object) : object_(object) {}

  std::optional<double> number(const char* name, double smallest, double largest);
  double number_or(const char* name, double usual, double smallest, double largest) {
    return number(name, smallest, largest).value_or(usual);
  }
  std::size_t count_or(const char* name, std::size_t usual, std::size_t smallest, std::size_t largest);
  std::optional<std::string> text(const char* name, std::size_t most_letters);
  bool flag(const char* name);  // value of a flag; false without it
  // Member of that name; null if the request does not have it.
  const nlohmann::ordered_json* member(const char* name);

  // Forms of an answer's arrays that any request may choose by "arrays"; the first is the default.
  static constexpr std::array<const char*, 2> kArrayForms{"numbers", "base64"};

  // True for base64.
  bool packs_arrays() const;

  void finish() const;

 private:
  static constexpr std::array<const char*, 3> kCommon{"id", "do", "arrays"};

  const nlohmann::ordered_json& object_;
  std::set<std::string> asked_{kCommon.begin(), kCommon.end()};
};

}  // namespace afm::instrument
