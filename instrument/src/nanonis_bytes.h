// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

// Numbers and texts of Nanonis' TCP protocol: big-endian, a text after its size in four bytes (Nanonis TCP protocol,
// SPECS, 2021).
namespace afm::instrument {

// An unsigned integer as wide as T.
template <class T>
using BitsOf =
    std::conditional_t<sizeof(T) == 8, std::uint64_t, std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint16_t>>;

template <class T>
concept NanonisNumber = std::same_as<T, std::uint16_t> || std::same_as<T, std::int32_t> ||
                        std::same_as<T, std::uint32_t> || std::same_as<T, float> || std::same_as<T, double>;

class NanonisWriter {
 public:
  template <NanonisNumber T>
  NanonisWriter& add(T value) {
    const auto bits = std::bit_cast<BitsOf<T>>(value);
    for (std::size_t i = sizeof(T); i-- > 0;) bytes_ += static_cast<char>((bits >> (8 * i)) & 0xFFU);
    return *this;
  }
  NanonisWriter& add_count(std::size_t count) { return add(static_cast<std::int32_t>(count)); }
  NanonisWriter& add_text(std::string_view text) {
    add_count(text.size());
    bytes_ += text;
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Reads the body of a request. Throws std::out_of_range beyond its end.
class NanonisReader {
 public:
  explicit NanonisReader(std::string_view bytes) : rest_(bytes) {}

  template <NanonisNumber T>
  T read() {
    BitsOf<T> bits = 0;
    for (const char byte : take(sizeof(T))) {
      bits = static_cast<BitsOf<T>>((std::uint64_t{bits} << 8U) | static_cast<unsigned char>(byte));
    }
    return std::bit_cast<T>(bits);
  }
  double real() { return static_cast<double>(read<float>()); }
  std::string_view text() {
    const auto size = read<std::int32_t>();
    if (size < 0) throw std::out_of_range("a text has a negative size");
    return take(static_cast<std::size_t>(size));
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw std::out_of_range("the body of the request ends too early");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
};

}  // namespace afm::instrument
