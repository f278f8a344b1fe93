// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "curves/curve_file.h"
#include "curves/table_columns.h"
#include "fuzz/checked_curve.h"

// The first line has the names of the columns, the others any text: a curve that can be analysed and written, or an
// error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const std::size_t end = std::min(text.find('\n'), text.size());
  const auto columns = afm::curves::parse_table_columns(text.substr(0, end));
  if (!columns) return 0;
  afm::curves::CurveReading here;
  here.confined = false;
  here.columns = *columns;
  here.spring_constant = afm::physics::Stiffness(0.05);
  here.sensitivity_m_per_v = 60e-9;
  if (const auto curve = afm::curves::parse_curve(text.substr(std::min(end + 1, size)), "fuzz", here))
    afm::fuzz::check_curve(*curve);
  return 0;
}
