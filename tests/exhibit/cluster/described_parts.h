// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/state/moment.h"

namespace afm::exhibit {

// ---- parts of a record: its fields, their fields, and the presence of optional ones ----

template <class Value>
constexpr bool kIsGroup = false;
template <scene::Described Value>
constexpr bool kIsGroup<std::optional<Value>> = true;

template <class Value, class Visit>
void for_each_part(const std::string& path, Value& value, Visit&& visit) {
  if constexpr (scene::Described<std::remove_const_t<Value>>) {
    const auto visit_field = [&](const char* name, auto& field) {
      for_each_part(path.empty() ? name : path + "." + name, field, visit);
    };
    for_each_field(visit_field, value);
  } else {
    visit(path, value);
    if constexpr (kIsGroup<std::remove_const_t<Value>>) {
      if (value) for_each_part(path, *value, visit);
    }
  }
}

inline std::string text_of(const std::string& text) { return text; }
template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
std::string text_of(Number number) {
  return fmt::format("{:.9g}", static_cast<double>(number));
}
template <glm::length_t length, class Number>
std::string text_of(const glm::vec<length, Number>& v) {
  std::string text;
  for (glm::length_t i = 0; i < length; ++i) text += text_of(v[i]) + " ";
  return text;
}
inline std::string text_of(const glm::dquat& q) { return text_of(glm::dvec4(q.w, q.x, q.y, q.z)); }
inline std::string text_of(const glm::dmat4& m) {
  return text_of(m[0]) + text_of(m[1]) + text_of(m[2]) + text_of(m[3]);
}
inline std::string text_of(const LiveScan* scan) { return scan == nullptr ? "none" : "a scan"; }
inline std::string text_of(const ParticlesNow* particles) { return particles == nullptr ? "none" : "particles"; }
inline std::string text_of(const render::DataRow& row) { return row.name + "|" + row.value + "|" + row.source; }
inline std::string text_of(const CycleResult& result) { return result.title; }
inline std::string text_of(const CycleCurve& curve) { return text_of(curve.points().size()); }
template <class Value, std::size_t count>
std::string text_of(const std::array<Value, count>& values);
template <class Value>
std::string text_of(const std::optional<Value>& value) {
  if constexpr (scene::Described<Value>) {
    return value ? "there" : "none";
  } else {
    return value ? text_of(*value) : "none";
  }
}
template <class List>
std::string text_of_list(const List& values) {
  std::string text;
  for (const auto& value : values) text += text_of(value) + ";";
  return text;
}
template <class Value, std::size_t count>
std::string text_of(const std::array<Value, count>& values) {
  return text_of_list(values);
}
template <class Value>
std::string text_of(const std::vector<Value>& values) {
  return text_of_list(values);
}
inline std::string text_of(std::span<const CycleCurve> curves) { return text_of_list(curves); }

using Parts = std::map<std::string, std::string>;

template <class Record>
Parts parts_of(const Record& record) {
  Parts parts;
  for_each_part("", record, [&](const std::string& path, const auto& value) { parts[path] = text_of(value); });
  return parts;
}

// ---- a different valid value ----

inline void change(bool& value) { value = !value; }
inline void change(float& value) { value = value == 0.0F ? 0.25F : 1.5F * value; }
inline void change(double& value) { value = value == 0.0 ? 0.25 : 1.5 * value; }
template <class Integer>
  requires std::is_integral_v<Integer>
void change(Integer& value) {
  ++value;
}
template <class Enum>
  requires std::is_enum_v<Enum>
void change(Enum& value) {
  value = core::kEnumerators<Enum>[(core::index_of(value) + 1) % core::kEnumerators<Enum>.size()];
}
inline void change(std::string& text) { text += "!"; }
template <glm::length_t length>
void change(glm::vec<length, double>& v) {
  v.x += 0.125;
}
inline void change(glm::dquat& q) { q = q.w == 1.0 ? glm::dquat(0.5, 0.5, -0.5, 0.5) : glm::dquat(1.0, 0.0, 0.0, 0.0); }
inline void change(glm::dmat4& m) { m = glm::translate(m, glm::dvec3(0.1, -0.2, 0.3)); }
inline void change(std::array<double, 4>& orientation) { orientation = {0.5, 0.5, -0.5, 0.5}; }
template <class Value, std::size_t count>
void change(std::array<Value, count>& values) {
  change(values.front());
}
template <class Value>
void change(std::optional<Value>& value) {
  if constexpr (scene::Described<Value>) {
    value.reset();
  } else {
    change(*value);
  }
}
inline void change(std::vector<render::DataRow>& rows) { rows.back().value += "!"; }
inline void change(std::vector<CycleResult>& results) { results.push_back({.title = "Mica", .law = "dmt"}); }
inline void change(std::span<const CycleCurve>& curves) { curves = curves.first(0); }
inline void change(const LiveScan*& scan) { scan = nullptr; }
inline void change(const ParticlesNow*& particles) { particles = nullptr; }

template <class Record>
Record changed(Record record, const std::string& part) {
  for_each_part("", record, [&](const std::string& path, auto& value) {
    if (path == part) change(value);
  });
  return record;
}

}  // namespace afm::exhibit
