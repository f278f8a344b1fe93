// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "curves/spectrum_file.h"
#include "fuzz/accepted.h"

// Whatever the bytes: rising frequencies with densities that are numbers, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const auto spectrum = afm::curves::parse_spectrum({reinterpret_cast<const char*>(bytes), size}, "x");
  if (!spectrum) return 0;
  ++afm::fuzz::accepted_inputs;
  double before_hz = 0.0;
  for (const afm::curves::SpectrumRow& row : spectrum->rows) {
    if (!(row.frequency_hz > before_hz) || !std::isfinite(row.frequency_hz)) std::abort();
    if (!(row.density >= 0.0) || !std::isfinite(row.density)) std::abort();
    before_hz = row.frequency_hz;
  }
  return 0;
}
