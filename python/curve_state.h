// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <span>
#include <vector>

#include "python/curve.h"

namespace afm::python {

// A curve with all that is known of it as Python's own objects, to be pickled.
pybind11::tuple state_of_curve(const Curve& curve);

// The same curve. ValueError for the state of another version.
Curve curve_from_state(const pybind11::tuple& state);

// Points of equally long columns: m, N, not zero on the approach. ValueError for one that is not finite, or of the
// approach and after the retract. Needs no lock of Python.
std::vector<physics::CurvePoint> points_from(std::span<const double> z_m, std::span<const double> force_n,
                                             std::span<const double> approach);

}  // namespace afm::python
