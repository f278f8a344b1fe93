// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene/shared/tip_blocks.h"

// Fixed-size little-endian records, end to end.
namespace afm::servo {

static_assert(std::endian::native == std::endian::little, "session records are little-endian");

// Record sizes of versions 3 and 6, in bytes. A sample of version 6 ends with the lateral force and the scan, which
// 0.1.0 did not have.
inline constexpr std::size_t kSampleBytesOf010 = 216;
static_assert(sizeof(scene::TipSample) == 288 && offsetof(scene::TipSample, scan) == 232 &&
              offsetof(scene::TipSample, lateral_force_n) == kSampleBytesOf010 &&
              offsetof(scene::TipSample, tip) == 16 && offsetof(scene::TipSample, hand_height_m) == 56 &&
              offsetof(scene::TipSample, servo_state) == 72 && offsetof(scene::TipSample, hand_from_contact_m) == 104 &&
              offsetof(scene::TipSample, surface) == 176 && offsetof(scene::TipSample, motor_heat) == 200);
static_assert(sizeof(scene::TipEvent) == 40 && offsetof(scene::TipEvent, time_ns) == 8 &&
              offsetof(scene::TipEvent, z_m) == 16);

template <class T>
void put(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
void put_all(std::string& bytes, std::span<const T> values) {
  put(bytes, std::uint64_t{values.size()});
  for (const T& value : values) put(bytes, value);
}

// Removes a record from the front; false if there are too few bytes.
template <class T>
bool take(std::string_view& bytes, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (bytes.size() < sizeof(T)) return false;
  const std::string_view here = bytes.substr(0, sizeof(T));
  std::copy(here.begin(), here.end(), reinterpret_cast<char*>(&value));
  bytes.remove_prefix(sizeof(T));
  return true;
}

// Appends to `values`.
template <class T>
bool take_all(std::string_view& bytes, std::vector<T>& values) {
  std::uint64_t count = 0;
  if (!take(bytes, count) || count > bytes.size() / sizeof(T)) return false;
  const std::size_t before = values.size();
  values.resize(before + count);
  return std::all_of(values.begin() + static_cast<std::ptrdiff_t>(before), values.end(),
                     [&](T& value) { return take(bytes, value); });
}

// Same for samples of version 3, without lateral force: it stays 0.
inline bool take_samples_of_010(std::string_view& bytes, std::vector<scene::TipSample>& samples) {
  std::uint64_t count = 0;
  if (!take(bytes, count) || count > bytes.size() / kSampleBytesOf010) return false;
  samples.reserve(samples.size() + count);
  for (std::uint64_t i = 0; i < count; ++i) {
    scene::TipSample& sample = samples.emplace_back();
    std::copy_n(bytes.begin(), kSampleBytesOf010, reinterpret_cast<char*>(&sample));
    bytes.remove_prefix(kSampleBytesOf010);
  }
  return true;
}

}  // namespace afm::servo
