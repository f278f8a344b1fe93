// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace afm::haptics {

// Newest fault of a driver, and how long it counts. `Health` is the driver's enumeration. One thread.
template <class Health>
class HeldFault {
 public:
  // The fault counts for `recovery_ns` from now on, or until the end if that is empty; nothing replaces such a fault.
  void raise(Health fault, std::optional<std::int64_t> recovery_ns, std::uint32_t code, std::int64_t now_ns) noexcept {
    if (until_ns_ == kForEver) return;
    fault_ = fault;
    code_ = code;
    until_ns_ = recovery_ns ? now_ns + *recovery_ns : kForEver;
  }

  // The fault while it counts, otherwise `otherwise`.
  Health health(Health otherwise, std::int64_t now_ns) const noexcept {
    return now_ns < until_ns_ ? fault_ : otherwise;
  }

  // The driver's number for its error; 0: not an error of the driver.
  std::uint32_t code_of(Health health) const noexcept { return health == fault_ ? code_ : 0; }

 private:
  static constexpr std::int64_t kForEver = std::numeric_limits<std::int64_t>::max();

  Health fault_{};
  std::uint32_t code_ = 0;
  std::int64_t until_ns_ = 0;
};

// Changes of a driver's health that are worth a line: each state at most once in ten seconds, because a driver may
// stall and recover again and again. One thread. kLast is the last enumerator of Health.
template <class Health, Health kLast>
class ToldHealth {
 public:
  static constexpr std::int64_t kSameLineNs = 10'000'000'000;

  bool is_news(Health now, std::int64_t now_ns) noexcept {
    std::int64_t& told_ns = at_ns_[static_cast<std::size_t>(now)];
    if (now == newest_ || (told_ns != 0 && now_ns - told_ns < kSameLineNs)) return false;
    newest_ = now;
    told_ns = now_ns;
    return true;
  }

 private:
  Health newest_{};                                                        // first enumerator: not started
  std::array<std::int64_t, static_cast<std::size_t>(kLast) + 1> at_ns_{};  // time of the newest line for each state
};

}  // namespace afm::haptics
