// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

namespace afm::core {

// Newest value of a trivially copyable T for one writer and any number of readers. It has no locks and no pointers, so
// that it can be placed in memory shared by two processes. A reader can miss values but never sees a torn one, and
// gives up after a bounded number of tries if the writer died or was stopped in the middle of a store.
//
// Implemented as a seqlock whose payload consists of atomic words, so that no access is a data race (Boehm, "Can
// seqlocks get along with programming language memory models?", MSPC 2012). Acquire and release on the words themselves
// replace fences, which ThreadSanitizer does not model.
template <class T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

 public:
  // Called by the single writer's thread. Wait-free.
  void store(const T& value) noexcept {
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &value, sizeof(T));

    // an odd number marks a store in progress; a writer that died there leaves it odd, and its successor must continue
    // from the next even one
    const std::uint64_t begin = (sequence_.load(std::memory_order_relaxed) | 1U);
    sequence_.store(begin, std::memory_order_relaxed);
    for (std::size_t i = 0; i < kWords; ++i) payload_[i].store(words[i], std::memory_order_release);
    sequence_.store(begin + 1, std::memory_order_release);
  }

  // Tries once; empty before the first store and during a store. Any thread, wait-free: the only variant that a servo
  // tick may use.
  std::optional<T> try_load() const noexcept {
    std::uint64_t seen = 0;
    return try_load_newer(seen);
  }

  // Like try_load(), but also empty if the newest value was already returned for this `seen`. Updates `seen` when it
  // returns a value; start with 0.
  std::optional<T> try_load_newer(std::uint64_t& seen) const noexcept {
    const std::uint64_t before = sequence_.load(std::memory_order_acquire);
    if (before == seen || before == 0 || (before & 1U) != 0) return std::nullopt;
    std::array<std::uint64_t, kWords> words;
    for (std::size_t i = 0; i < kWords; ++i) words[i] = payload_[i].load(std::memory_order_acquire);
    if (sequence_.load(std::memory_order_relaxed) != before) return std::nullopt;
    seen = before;
    T value;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return value;
  }

  // Tries a bounded number of times, for readers that can afford a few microseconds.
  std::optional<T> load() const noexcept {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (auto value = try_load()) return value;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kWords = (sizeof(T) + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
  static constexpr int kAttempts = 64;

  alignas(64) std::atomic<std::uint64_t> sequence_{0};
  std::array<std::atomic<std::uint64_t>, kWords> payload_{};
};

}  // namespace afm::core
