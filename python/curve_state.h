// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <span>
#include <vector>

#include "python/curve.h"

namespace afm::python {

// A curve with all of its data as Python's own objects, for pickling.
pybind11::tuple state_of_curve(const Curve& curve);

// The curve of such a state. ValueError for the state of another version.
Curve curve_from_state(const pybind11::tuple& state);

// Points of equally long columns: m, N, non-zero on the approach. ValueError for a number that is not finite, or an
// approach after the retract. Works without Python's lock.
std::vector<physics::CurvePoint> points_from(std::span<const double> z_m, std::span<const double> force_n,
                                             std::span<const double> approach);

}  // namespace afm::python
