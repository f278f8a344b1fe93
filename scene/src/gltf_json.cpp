// SPDX-License-Identifier: Apache-2.0
#include "gltf_json.h"

#include <fmt/core.h>

#include <cmath>

#include "gltf_fault.h"

namespace afm::scene {
namespace {

bool is_within(const Json& value, JsonElement::Range range) {
  return value.is_number() && std::isfinite(value.get<double>()) && value.get<double>() >= range.low &&
         value.get<double>() <= range.high;
}

// JSON knows one kind of number: 4 may be written as 4.0.
std::optional<std::uint64_t> whole(const Json& value) {
  constexpr double kLargestExact = 9007199254740992.0;
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (!value.is_number_float()) return std::nullopt;
  const auto number = value.get<double>();
  if (!(number >= 0.0 && number <= kLargestExact) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

std::string of_range(JsonElement::Range range) {
  const JsonElement::Range any;
  if (range.low == any.low && range.high == any.high) return "a finite number";
  if (range.high == any.high) return fmt::format("a number of at least {:g}", range.low);
  return fmt::format("a number of {:g} to {:g}", range.low, range.high);
}

// A stranger's value, short enough for a line.
std::string quoted(const Json& value) {
  if (value.is_structured()) return value.is_object() ? "an object" : "a list";
  return value.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
}

}  // namespace

void JsonElement::fail(std::string_view reason) const {
  throw GltfFault(fmt::format("{} {}", path_.empty() ? "its JSON text" : path_, reason));
}

void JsonElement::fail_at(const char* key, std::string_view reason) const {
  throw GltfFault(fmt::format("{}/{} {}", path_, key, reason));
}

const Json* JsonElement::find(const char* key) const {
  if (!value_->is_object()) fail(fmt::format("is {}, not an object", quoted(*value_)));
  const auto found = value_->find(key);
  return found == value_->end() ? nullptr : &*found;
}

std::optional<JsonElement> JsonElement::object(const char* key) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_object()) fail_at(key, fmt::format("is {}, not an object", quoted(*value)));
  return JsonElement(*value, fmt::format("{}/{}", path_, key));
}

JsonElement JsonElement::required_object(const char* key) const {
  if (auto value = object(key)) return *value;
  fail(fmt::format("has no '{}'", key));
}

std::vector<JsonElement> JsonElement::values(const char* key) const {
  std::vector<JsonElement> elements;
  const Json* value = find(key);
  if (value == nullptr) return elements;
  if (!value->is_array()) fail_at(key, fmt::format("is {}, not a list", quoted(*value)));
  elements.reserve(value->size());
  for (std::size_t i = 0; i < value->size(); ++i) {
    elements.push_back(JsonElement((*value)[i], fmt::format("{}/{}/{}", path_, key, i)));
  }
  return elements;
}

std::vector<JsonElement> JsonElement::objects(const char* key) const {
  auto elements = values(key);
  for (const JsonElement& element : elements) {
    if (!element.json().is_object()) element.fail(fmt::format("is {}, not an object", quoted(element.json())));
  }
  return elements;
}

std::size_t JsonElement::count(const char* key) const {
  const Json* value = find(key);
  if (value != nullptr && !value->is_array()) fail_at(key, fmt::format("is {}, not a list", quoted(*value)));
  return value == nullptr ? 0 : value->size();
}

std::vector<std::string> JsonElement::keys() const {
  std::vector<std::string> names;
  if (!value_->is_object()) return names;
  for (const auto& [name, value] : value_->items()) names.push_back(name);
  return names;
}

std::string JsonElement::text(const char* key, const char* missing) const {
  return find(key) == nullptr ? std::string(missing) : required_text(key);
}

std::string JsonElement::required_text(const char* key) const {
  const Json* value = find(key);
  if (value == nullptr) fail(fmt::format("has no '{}'", key));
  if (!value->is_string()) fail_at(key, fmt::format("is {}, not a text", quoted(*value)));
  return value->get<std::string>();
}

bool JsonElement::flag(const char* key, bool missing) const {
  const Json* value = find(key);
  if (value == nullptr) return missing;
  if (!value->is_boolean()) fail_at(key, fmt::format("is {}, not true or false", quoted(*value)));
  return value->get<bool>();
}

double JsonElement::number(const char* key, double missing, Range range) const {
  return find(key) == nullptr ? missing : required_number(key, range);
}

double JsonElement::required_number(const char* key, Range range) const {
  const Json* value = find(key);
  if (value == nullptr) fail(fmt::format("has no '{}'", key));
  if (!is_within(*value, range)) fail_at(key, fmt::format("is {}, not {}", quoted(*value), of_range(range)));
  return value->get<double>();
}

bool JsonElement::numbers(const char* key, std::span<double> into, Range range) const {
  const Json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_array() || value->size() != into.size()) {
    fail_at(key, fmt::format("is not a list of {} numbers", into.size()));
  }
  for (std::size_t i = 0; i < into.size(); ++i) {
    const Json& number = (*value)[i];
    if (!is_within(number, range)) fail_at(key, fmt::format("holds {}, not {}", quoted(number), of_range(range)));
    into[i] = number.get<double>();
  }
  return true;
}

std::uint64_t JsonElement::size(const char* key, std::uint64_t missing, std::uint64_t most) const {
  return find(key) == nullptr ? missing : required_size(key, most);
}

std::uint64_t JsonElement::required_size(const char* key, std::uint64_t most) const {
  const Json* value = find(key);
  if (value == nullptr) fail(fmt::format("has no '{}'", key));
  const auto number = whole(*value);
  if (!number || *number > most) {
    fail_at(key, fmt::format("is {}, not a whole number of 0 to {}", quoted(*value), most));
  }
  return *number;
}

std::optional<std::uint32_t> JsonElement::index(const char* key, std::size_t count) const {
  if (find(key) == nullptr) return std::nullopt;
  return required_index(key, count);
}

std::uint32_t JsonElement::required_index(const char* key, std::size_t count) const {
  const Json* value = find(key);
  if (value == nullptr) fail(fmt::format("has no '{}'", key));
  return JsonElement(*value, fmt::format("{}/{}", path_, key)).as_index(count);
}

std::uint32_t JsonElement::as_index(std::size_t count) const {
  const auto number = whole(*value_);
  if (!number || *number >= count) {
    fail(fmt::format("is {}, which does not exist: there are {}", quoted(*value_), count));
  }
  return static_cast<std::uint32_t>(*number);
}

double JsonElement::as_number() const {
  if (!is_within(*value_, {})) fail(fmt::format("is {}, not a finite number", quoted(*value_)));
  return value_->get<double>();
}

std::string JsonElement::as_text() const {
  if (!value_->is_string()) fail(fmt::format("is {}, not a text", quoted(*value_)));
  return value_->get<std::string>();
}

std::optional<JsonElement> JsonElement::extension(const char* name) const {
  const auto extensions = object("extensions");
  return extensions ? extensions->object(name) : std::nullopt;
}

}  // namespace afm::scene
