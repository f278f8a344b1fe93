// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "curves/curve_file.h"
#include "fuzz/checked_curve.h"

namespace {

// An .ardf whose sections have the right checksums again, since a changed one would be refused at once.
std::string with_checksums(std::string bytes) {
  constexpr std::size_t kHead = 16, kName = 4;
  constexpr std::string_view kNames = "ARDF FTOC TTOC TOFF TEXT IMAG VOLM NSET VDEF VCHN XDEF VTOC VOFF VSET VNAM VDAT";
  for (std::size_t at = 0; at + kHead <= bytes.size(); ++at) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at + kName, sizeof(size));
    const bool is_section = size >= kHead && size <= bytes.size() - at &&
                            kNames.find(std::string_view(bytes).substr(at + 8, kName)) != std::string_view::npos;
    if (!is_section) continue;
    const auto sum = static_cast<std::uint32_t>(
        ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + at + kName), size - kName));
    std::memcpy(bytes.data() + at, &sum, sizeof(sum));
  }
  return bytes;
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T number{};
  std::memcpy(&number, bytes.data() + at, sizeof(T));
  return number;
}

// A zip archive whose stored entries have the right checksums again, so that a changed number gets to the readers.
std::string with_zip_checksums(std::string bytes) {
  constexpr std::size_t kHeader = 46, kLocal = 30;
  for (std::size_t at = bytes.find("PK\x01\x02"); at != std::string::npos && at + kHeader <= bytes.size();
       at = bytes.find("PK\x01\x02", at + 4)) {
    const std::size_t local = number_at<std::uint32_t>(bytes, at + 42), size = number_at<std::uint32_t>(bytes, at + 20);
    if (number_at<std::uint16_t>(bytes, at + 10) != 0 || local > bytes.size() || bytes.size() - local < kLocal)
      continue;
    const std::size_t begin =
        local + kLocal + number_at<std::uint16_t>(bytes, local + 26) + number_at<std::uint16_t>(bytes, local + 28);
    if (begin > bytes.size() || bytes.size() - begin < size) continue;
    const auto sum =
        static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + begin), size));
    std::memcpy(bytes.data() + at + 16, &sum, sizeof(sum));
  }
  return bytes;
}

}  // namespace

// Any bytes in any format: a curve that can be analysed and written, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(bytes), size);
  if (size > 12 && std::string_view(text).substr(8, 4) == "ARDF") text = with_checksums(std::move(text));
  if (text.starts_with("PK\x03\x04")) text = with_zip_checksums(std::move(text));
  if (text.starts_with("\x89HDF")) return 0;  // format read by a separate program, which corpus/hdf5 covers
  afm::curves::CurveReading here;
  here.confined = false;
  const auto curve = afm::curves::parse_curve(text, "fuzz", here);
  // the next curve of a map
  here.index = 1;
  (void)afm::curves::parse_curve(text, "fuzz", here);
  if (curve) afm::fuzz::check_curve(*curve);
  return 0;
}
