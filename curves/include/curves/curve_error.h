// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace afm::curves {

// Reason why a file is not a curve, and a remedy. Thrown only within the readers; parse_curve() converts it to an error
// that names the file.
class CurveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The file ends before its data do: all of it is refused, even if only one channel is incomplete.
class CutShort : public CurveError {
 public:
  using CurveError::CurveError;
};

}  // namespace afm::curves
