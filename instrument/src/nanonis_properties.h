// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <initializer_list>
#include <string>

#include "instrument/nanonis_door.h"
#include "nanonis_bytes.h"
#include "refused_request.h"

namespace afm::instrument {

inline double within(const char* what, double value, double smallest, double largest) {
  if (!(value >= smallest && value <= largest)) {
    throw RefusedRequest(fmt::format("{}: {} is not within {} to {}", what, value, smallest, largest));
  }
  return value;
}

// A choice of a request, which counts from 1, with 0 for no change: the one of `answers` by which Get names it.
inline std::uint32_t chosen(NanonisReader& in, std::uint32_t kept, std::initializer_list<std::uint32_t> answers) {
  const auto choice = in.read<std::uint32_t>();
  within("choice", choice, 0.0, static_cast<double>(answers.size()));
  return choice == 0 ? kept : *(answers.begin() + (choice - 1));
}

// The properties after Scan.PropsSet. Throws without a change.
inline NanonisProperties changed(const NanonisProperties& kept, NanonisReader& in) {
  constexpr std::uint32_t kOff = 0, kOn = 1, kSaveAll = 0, kSaveNext = 1;
  NanonisProperties set;
  set.continuous = chosen(in, kept.continuous, {kOn, kOff});
  set.bouncing = chosen(in, kept.bouncing, {kOn, kOff});
  set.autosave = chosen(in, kept.autosave, {kSaveAll, kSaveNext, NanonisProperties::kSaveNone});
  set.series = in.text();
  set.comment = in.text();
  return set;
}

}  // namespace afm::instrument
