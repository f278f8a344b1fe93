// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "curves/recorded_curve.h"

namespace afm::python {

// touchafm.Curve: a curve from a file, from arrays or synthetic, and its name in messages. Immutable.
struct Curve {
  std::string name;
  curves::RecordedCurve recorded;
};

}  // namespace afm::python
