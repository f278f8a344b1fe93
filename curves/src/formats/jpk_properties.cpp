// SPDX-License-Identifier: Apache-2.0
#include "formats/jpk_properties.h"

#include "formats/text_table.h"

namespace afm::curves {

namespace {

// Java escapes ':' and '=' with a backslash.
std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) ++i;
    result.push_back(text[i]);
  }
  return result;
}

}  // namespace

void JpkProperties::add(std::string_view text) {
  std::string_view line;
  for (Lines lines(text); lines.next(line);) {
    line = trimmed(line);
    const std::size_t equals = line.find('=');
    if (line.starts_with('#') || line.starts_with('!') || equals == std::string_view::npos) continue;
    values_[unescaped(trimmed(line.substr(0, equals)))] = unescaped(trimmed(line.substr(equals + 1)));
  }
}

void JpkProperties::take_shared(const JpkProperties& shared) {
  std::map<std::string, std::string, std::less<>> taken;
  for (const auto& [key, number] : values_) {
    constexpr std::string_view kStar = ".*";
    if (!key.ends_with(kStar)) continue;
    const std::string_view whole = std::string_view(key).substr(0, key.size() - kStar.size());
    const std::size_t dot = whole.rfind('.');
    if (dot == std::string_view::npos) continue;
    const std::string from = std::string(whole.substr(dot + 1)) + "." + number + ".";
    for (auto entry = shared.values_.lower_bound(from); entry != shared.values_.end() && entry->first.starts_with(from);
         ++entry) {
      taken[std::string(whole.substr(0, dot + 1)) + entry->first.substr(from.size())] = entry->second;
    }
  }
  values_.merge(taken);
}

std::optional<std::string> JpkProperties::text(std::string_view key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

std::optional<double> JpkProperties::number(std::string_view key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  return number_in(found->second, key, Lines({}));
}

}  // namespace afm::curves
