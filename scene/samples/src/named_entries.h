// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"

// Common part of the libraries of materials and probes: entries with unique names.
namespace afm::scene {

// Null if the name is unknown.
template <class Entry>
const Entry* find_named(const std::vector<Entry>& entries, std::string_view name) {
  const auto at = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == name; });
  return at == entries.end() ? nullptr : &*at;
}

// `kind` names an entry in the message: "material".
template <class Entry>
core::Result<const Entry*> require_named(const std::vector<Entry>& entries, const char* kind, std::string_view name) {
  if (const Entry* entry = find_named(entries, name)) return entry;
  std::string known;
  for (const Entry& entry : entries) known += (known.empty() ? "" : ", ") + entry.name;
  return core::failure(core::ErrorCategory::WrongUsage, fmt::format("unknown {} \"{}\"; choose {}", kind, name, known));
}

// Adds at the end, or replaces the entry of the same name.
template <class Entry>
void add_named(std::vector<Entry>& entries, std::vector<Entry> others) {
  for (Entry& other : others) {
    const auto old =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == other.name; });
    if (old != entries.end()) {
      *old = std::move(other);
    } else {
      entries.push_back(std::move(other));
    }
  }
}

}  // namespace afm::scene
