// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afm::scene {

using Json = nlohmann::json;

// A value of the JSON text that knows where it stands, so that every complaint says so: "/meshes/0/primitives/1". The
// document must outlive it. Everything it gives has been checked: the type,
// that numbers are finite and within their range, that an index exists. Whatever is not so throws GltfFault.
class JsonElement {
 public:
  explicit JsonElement(const Json& document) : value_(&document) {}

  // A member that may be absent; what is there is an object or an array.
  std::optional<JsonElement> object(const char* key) const;
  JsonElement required_object(const char* key) const;

  // The elements of a list of objects, or of anything; empty if it is absent.
  std::vector<JsonElement> objects(const char* key) const;
  std::vector<JsonElement> values(const char* key) const;
  std::size_t count(const char* key) const;

  bool has(const char* key) const { return value_->contains(key); }
  std::vector<std::string> keys() const;

  std::string text(const char* key, const char* missing) const;
  std::string required_text(const char* key) const;
  bool flag(const char* key, bool missing) const;

  struct Range {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
  };
  double number(const char* key, double missing, Range range) const;
  double required_number(const char* key, Range range) const;

  // A list of exactly as many numbers as `into` has places; false if it is absent.
  bool numbers(const char* key, std::span<double> into, Range range) const;

  // A whole number that is no larger than `most`.
  std::uint64_t size(const char* key, std::uint64_t missing, std::uint64_t most) const;
  std::uint64_t required_size(const char* key, std::uint64_t most) const;

  // An index into a list of `count` elements.
  std::optional<std::uint32_t> index(const char* key, std::size_t count) const;
  std::uint32_t required_index(const char* key, std::size_t count) const;

  // The same of the element itself.
  std::uint32_t as_index(std::size_t count) const;
  double as_number() const;
  std::string as_text() const;
  const Json& json() const { return *value_; }

  std::optional<JsonElement> extension(const char* name) const;

  [[noreturn]] void fail(std::string_view reason) const;

 private:
  JsonElement(const Json& value, std::string path) : value_(&value), path_(std::move(path)) {}
  const Json* find(const char* key) const;
  [[noreturn]] void fail_at(const char* key, std::string_view reason) const;

  const Json* value_;
  std::string path_;
};

}  // namespace afm::scene
