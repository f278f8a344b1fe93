// SPDX-License-Identifier: Apache-2.0
#include "bytes/scaled_unit.h"

#include <array>

#include "bytes/text_table.h"

namespace afm::curves {

namespace {

struct Prefix {
  std::string_view text;
  double factor;
};

// "~" is Nanoscope's micro; the others are UTF-8 and Latin-1.
constexpr std::array kPrefixes{Prefix{"f", 1e-15},       Prefix{"p", 1e-12},   Prefix{"n", 1e-9},
                               Prefix{"u", 1e-6},        Prefix{"~", 1e-6},    Prefix{"\xc2\xb5", 1e-6},
                               Prefix{"\xce\xbc", 1e-6}, Prefix{"\xb5", 1e-6}, Prefix{"m", 1e-3},
                               Prefix{"k", 1e3},         Prefix{"M", 1e6},     Prefix{"G", 1e9}};
constexpr std::array<std::string_view, 3> kAngstroms{"\u00c5", "\u212b", "\xc5"};  // UTF-8, UTF-8, Latin-1
constexpr std::array<std::string_view, 10> kSiUnits{"m", "V", "N", "A", "Hz", "Pa", "s", "J", "W", "deg"};

bool is_unit(std::string_view text) {
  for (const std::string_view unit : kSiUnits) {
    if (text == unit) return true;
  }
  return false;
}

}  // namespace

ScaledUnit scaled_unit(std::string_view text) {
  text = trimmed(text);
  if (is_unit(text)) return {1.0, std::string(text)};
  for (const std::string_view angstrom : kAngstroms) {
    if (text == angstrom) return {1e-10, "m"};
  }
  for (const Prefix& prefix : kPrefixes) {
    if (text.starts_with(prefix.text) && is_unit(text.substr(prefix.text.size()))) {
      return {prefix.factor, std::string(text.substr(prefix.text.size()))};
    }
  }
  return {1.0, std::string(text)};
}

}  // namespace afm::curves
