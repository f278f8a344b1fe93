// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace afm::core {

// Passes every value of a trivially copyable T from one producer to one consumer, or counts it as dropped. It has no
// locks and no pointers, so that it can be placed in memory shared by two processes. Indices only count up and are
// masked on access: corrupt indices can spoil values but never lead outside the array.
template <class T, std::size_t Capacity>
class SpscRing {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "capacity must be a power of two");

 public:
  // Called by the single producer's thread. Wait-free. Returns false and counts a drop if the consumer is Capacity
  // values behind.
  bool push(const T& value) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) >= Capacity) {
      dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    slots_[head & (Capacity - 1)] = value;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  // Called by the single consumer's thread. Wait-free. Empty if there is nothing new.
  std::optional<T> pop() noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    const std::uint64_t head = head_.load(std::memory_order_acquire);
    if (tail == head) return std::nullopt;
    if (head - tail > Capacity) {
      // no producer can be that far ahead: the indices are corrupt, and draining them might never end
      tail_.store(head, std::memory_order_release);
      return std::nullopt;
    }
    const T value = slots_[tail & (Capacity - 1)];
    tail_.store(tail + 1, std::memory_order_release);
    return value;
  }

  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  alignas(64) std::atomic<std::uint64_t> head_{0};
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  alignas(64) std::atomic<std::uint64_t> dropped_{0};
  alignas(64) std::array<T, Capacity> slots_{};
};

}  // namespace afm::core
