// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "curves/curve_file.h"
#include "fuzz/accepted.h"
#include "physics/curve_analysis.h"

// Whatever the bytes, and whichever format they claim: a curve that can be analysed and written, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  if (text.starts_with("\x89HDF")) return 0;  // read by a separate program, which corpus/hdf5 covers
  afm::curves::CurveReading here;
  here.confined = false;
  const auto curve = afm::curves::parse_curve(text, "fuzz", here);
  if (!curve) return 0;
  ++afm::fuzz::accepted_inputs;
  for (const auto& point : curve->points) {
    if (!isfinite(point.z) || !isfinite(point.force)) std::abort();
  }
  try {
    afm::physics::analyse(curve->points);
  } catch (const std::invalid_argument&) {
    // too few points, or all at one height
  }
  const auto written = afm::curves::curve_bytes(afm::curves::CurveFormat::Tab, *curve);
  if (!written || !afm::curves::parse_curve(*written, "again")) std::abort();
  return 0;
}
