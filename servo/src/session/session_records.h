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

// Record sizes of versions 3 and 6, in bytes; each is the beginning of the next. Version 6 added the lateral force and
// the scan, version 7 the push, version 10 the swing, version 11 the plan of a push and the force of its groove,
// version 14 what a picture is computed from.
inline constexpr std::size_t kSampleBytesOf010 = 216;
inline constexpr std::size_t kSampleBytesWithoutPush = 288;
inline constexpr std::size_t kSampleBytesWithoutSwing = 336;
inline constexpr std::size_t kSampleBytesWithoutPlan = 352;
inline constexpr std::size_t kSampleBytesWithoutLevel = 408;
inline constexpr std::size_t kMostSampleBytes = 424;  // size without the settings, which no file contains
static_assert(offsetof(scene::TipSample, settings) == kMostSampleBytes &&
              offsetof(scene::TipSample, level) == kSampleBytesWithoutLevel &&
              offsetof(scene::TipSample, plan) == kSampleBytesWithoutPlan &&
              offsetof(scene::TipSample, swing) == kSampleBytesWithoutSwing &&
              offsetof(scene::TipSample, push) == kSampleBytesWithoutPush && offsetof(scene::TipSample, scan) == 232 &&
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

// Writes samples of a version that keeps only the first `size` bytes: the rest is read with its defaults.
inline void put_samples(std::string& bytes, std::span<const scene::TipSample> samples, std::size_t size) {
  put(bytes, std::uint64_t{samples.size()});
  for (const scene::TipSample& sample : samples) bytes.append(reinterpret_cast<const char*>(&sample), size);
}

inline bool take_samples(std::string_view& bytes, std::vector<scene::TipSample>& samples, std::size_t size) {
  std::uint64_t count = 0;
  if (!take(bytes, count) || count > bytes.size() / size) return false;
  for (std::uint64_t i = 0; i < count; ++i) {
    scene::TipSample& sample = samples.emplace_back();
    std::copy_n(bytes.begin(), size, reinterpret_cast<char*>(&sample));
    bytes.remove_prefix(size);
  }
  return true;
}

}  // namespace afm::servo
