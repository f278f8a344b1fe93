// SPDX-License-Identifier: Apache-2.0
#include "formats/jpk_properties.h"

#include "bytes/text_table.h"

namespace afm::curves {

namespace {

// Removes the backslashes with which Java escapes ':' and '='.
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

void JpkProperties::set_shared(const JpkProperties& shared) {
  shared_ = &shared;
  for (const auto& [key, number] : values_) {
    constexpr std::string_view kStar = ".*";
    if (!key.ends_with(kStar)) continue;
    const std::string_view whole = std::string_view(key).substr(0, key.size() - kStar.size());
    const std::size_t dot = whole.rfind('.');
    if (dot == std::string_view::npos) continue;
    references_.push_back(
        {std::string(whole.substr(0, dot + 1)), std::string(whole.substr(dot + 1)) + "." + number + "."});
  }
}

std::optional<std::string> JpkProperties::text(std::string_view key) const {
  if (general_ != nullptr) {
    if (const auto found = general_->values_.find(key); found != general_->values_.end()) return found->second;
  }
  if (const auto found = values_.find(key); found != values_.end()) return found->second;
  for (const Reference& reference : references_) {
    if (!key.starts_with(reference.prefix)) continue;
    const auto found = shared_->values_.find(reference.place + std::string(key.substr(reference.prefix.size())));
    if (found != shared_->values_.end()) return found->second;
  }
  return std::nullopt;
}

std::optional<double> JpkProperties::number(std::string_view key) const {
  const auto found = text(key);
  if (!found) return std::nullopt;
  return number_in(*found, key, Lines({}));
}

}  // namespace afm::curves
