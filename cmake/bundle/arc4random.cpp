// SPDX-License-Identifier: Apache-2.0
// The function by which the archive of libstdc++ implements std::random_device, and which glibc has since 2.36 alone
// (cmake/AfmBundle.cmake).
#include <sys/random.h>

#include <cstdint>
#include <cstdlib>

extern "C" std::uint32_t arc4random() noexcept {
  std::uint32_t number = 0;
  // never interrupted and never short for so few bytes (man 2 getrandom)
  if (::getrandom(&number, sizeof(number), 0) != static_cast<ssize_t>(sizeof(number))) std::abort();
  return number;
}
