// SPDX-License-Identifier: Apache-2.0
#include "app/options/nearest_word.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace afm::app {

namespace {

constexpr std::size_t kShortWord = 4;  // letters of a word in which two may be wrong

std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);  // distances of a's beginning from each beginning of b
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, row[k + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_word(const std::string& typed, const std::vector<std::string>& words) {
  const std::size_t most = std::max(typed.size() / 3, typed.size() < kShortWord ? std::size_t{1} : std::size_t{2});
  std::string nearest;
  std::size_t least = most + 1;
  for (const std::string& word : words) {
    const std::size_t here = distance(typed, word);
    if (here >= least) continue;
    least = here;
    nearest = word;
  }
  if (!nearest.empty() || typed.size() < kShortWord) return nearest;
  // a part of its name: --radius for --tip-radius
  const std::string part = typed.substr(std::min(typed.find_first_not_of('-'), typed.size()));
  const auto whole = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
    return part.size() >= kShortWord && word.find(part) != std::string::npos;
  });
  return whole == words.end() ? "" : *whole;
}

std::string suggestion(const std::string& typed, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(typed, words);
  return nearest.empty() ? "" : " (did you mean " + nearest + "?)";
}

}  // namespace afm::app
