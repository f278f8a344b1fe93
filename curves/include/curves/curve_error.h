// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace afm::curves {

// Why a file is no curve, and what to do. Thrown inside the readers alone; parse_curve() makes an error of it that
// names the file.
class CurveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace afm::curves
