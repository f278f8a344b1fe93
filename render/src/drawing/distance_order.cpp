// SPDX-License-Identifier: Apache-2.0
#include "drawing/distance_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace afm::render {
namespace {

constexpr unsigned kDigitBits = 11, kKeyBits = 32;
constexpr std::uint32_t kDigits = 1U << kDigitBits;
constexpr std::size_t kFew = 128;  // number of draws; comparing so few takes less time than counting digits

}  // namespace

void DistanceOrder::add(double distance, std::uint32_t draw) {
  // + 0: the bits of -0 would be those of the largest number
  draws_.push_back({.key = std::bit_cast<std::uint32_t>(static_cast<float>(distance) + 0.0F), .draw = draw});
}

// Moves the draws into the order of one digit of their keys; equal digits keep their order.
void DistanceOrder::sort_by_digit(unsigned lowest_bit) {
  const auto digit = [&](const Placed& placed) { return (placed.key >> lowest_bit) & (kDigits - 1); };
  std::array<std::uint32_t, kDigits> places{};
  for (const Placed& placed : draws_) ++places[digit(placed)];
  std::uint32_t next = 0;
  for (std::uint32_t& place : places) {
    const std::uint32_t count = place;
    place = next;
    next += count;
  }
  sorted_.resize(draws_.size());
  for (const Placed& placed : draws_) sorted_[places[digit(placed)]++] = placed;
  draws_.swap(sorted_);
}

void DistanceOrder::near_to_far(std::vector<std::uint32_t>& order) {
  if (draws_.size() < kFew) {
    const auto nearer = [](const Placed& a, const Placed& b) { return a.key < b.key; };
    // no allocation, as in std::stable_sort
    for (auto each = draws_.begin(); each != draws_.end(); ++each) {
      std::rotate(std::upper_bound(draws_.begin(), each, *each, nearer), each, each + 1);
    }
  } else {
    for (unsigned bit = 0; bit < kKeyBits; bit += kDigitBits) sort_by_digit(bit);
  }
  order.clear();
  order.reserve(draws_.size());
  for (const Placed& placed : draws_) order.push_back(placed.draw);
}

}  // namespace afm::render
