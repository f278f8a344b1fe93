// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace afm::scene {

// A number as written ("50 nm") and its source.
struct SourcedValue {
  std::string key;  // key in files: "tip_radius"
  std::string value;
  std::string source;
  bool estimated = false;  // not measured for exactly this system; must be mentioned wherever the number is shown
};

// Null if no value has the key.
const SourcedValue* find_source(std::span<const SourcedValue> sources, std::string_view key);

}  // namespace afm::scene
