// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/printable.h"
#include "refused_request.h"

namespace afm::instrument {

const nlohmann::ordered_json* Arguments::member(const char* name) {
  asked_.insert(name);
  const auto found = object_.find(name);
  return found == object_.end() || found->is_null() ? nullptr : &*found;
}

std::optional<double> Arguments::number(const char* name, double smallest, double largest) {
  const nlohmann::ordered_json* value = member(name);
  if (value == nullptr) return std::nullopt;
  const double si = value->is_number() ? value->get<double>() : std::nan("");
  if (!(si >= smallest && si <= largest)) {
    throw RefusedRequest(fmt::format("\"{}\": give a number from {} to {}", name, smallest, largest));
  }
  return si;
}

std::size_t Arguments::count_or(const char* name, std::size_t usual, std::size_t smallest, std::size_t largest) {
  const auto given = number(name, static_cast<double>(smallest), static_cast<double>(largest));
  if (given && *given != std::floor(*given)) throw RefusedRequest(fmt::format("\"{}\": give a whole number", name));
  return given ? static_cast<std::size_t>(*given) : usual;
}

std::optional<std::string> Arguments::text(const char* name, std::size_t most_letters) {
  const nlohmann::ordered_json* value = member(name);
  if (value == nullptr) return std::nullopt;
  if (!value->is_string() || value->get_ref<const std::string&>().size() > most_letters) {
    throw RefusedRequest(fmt::format("\"{}\": give a text of at most {} letters", name, most_letters));
  }
  return value->get<std::string>();
}

bool Arguments::flag(const char* name) {
  const nlohmann::ordered_json* value = member(name);
  if (value != nullptr && !value->is_boolean()) {
    throw RefusedRequest(fmt::format("\"{}\": give true or false", name));
  }
  return value != nullptr && value->get<bool>();
}

bool Arguments::packs_arrays() const {
  const auto found = object_.find("arrays");
  if (found == object_.end() || found->is_null()) return false;
  for (const char* form : kArrayForms) {
    if (*found == form) return form == std::string_view(kArrayForms.back());
  }
  throw RefusedRequest("\"arrays\": give \"numbers\" or \"base64\"");
}

void Arguments::finish() const {
  for (const auto& [name, value] : object_.items()) {
    if (asked_.contains(name)) continue;
    std::string known;
    for (const std::string& each : asked_) {
      if (std::find(kCommon.begin(), kCommon.end(), each) == kCommon.end()) known += (known.empty() ? "" : ", ") + each;
    }
    throw RefusedRequest(
        fmt::format("\"{}\" has no effect here; known: {}", core::printable(name), known.empty() ? "nothing" : known));
  }
}

}  // namespace afm::instrument
