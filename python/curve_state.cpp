// SPDX-License-Identifier: Apache-2.0
#include "python/curve_state.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/errors.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using physics::CurvePoint;

template <class Q>
std::optional<double> si_or_none(const std::optional<Q>& value) {
  return value ? std::optional(value->si) : std::nullopt;
}

template <class Q>
std::optional<Q> quantity(const py::handle& si) {
  if (si.is_none()) return std::nullopt;
  return Q(si.cast<double>());
}

py::object pixel_state(const std::optional<curves::MapPixel>& pixel) {
  if (!pixel) return py::none();
  const curves::MapGrid& grid = pixel->grid;
  return py::make_tuple(pixel->column, pixel->row, grid.columns, grid.rows, grid.width_m, grid.height_m,
                        grid.center_x_m, grid.center_y_m);
}

std::optional<curves::MapPixel> pixel_from(const py::handle& state) {
  if (state.is_none()) return std::nullopt;
  const auto at = state.cast<py::tuple>();
  return curves::MapPixel{.grid = {.columns = at[2].cast<std::size_t>(),
                                   .rows = at[3].cast<std::size_t>(),
                                   .width_m = at[4].cast<double>(),
                                   .height_m = at[5].cast<double>(),
                                   .center_x_m = at[6].cast<double>(),
                                   .center_y_m = at[7].cast<double>()},
                          .column = at[0].cast<std::size_t>(),
                          .row = at[1].cast<std::size_t>()};
}

py::tuple metadata_state(const curves::CurveMetadata& data) {
  py::object position = py::none();
  if (data.position) position = py::make_tuple(data.position->x_m, data.position->y_m);
  return py::make_tuple(si_or_none(data.spring_constant), data.sensitivity_m_per_v, si_or_none(data.approach_speed),
                        si_or_none(data.retract_speed), si_or_none(data.setpoint), data.instrument, data.software,
                        data.software_version, data.date, data.time, data.curve_id, position, pixel_state(data.pixel),
                        data.parameters, data.remarks);
}

curves::CurveMetadata metadata_from(const py::tuple& state) {
  curves::CurveMetadata data;
  data.spring_constant = quantity<physics::Stiffness>(state[0]);
  data.sensitivity_m_per_v = state[1].cast<std::optional<double>>();
  data.approach_speed = quantity<physics::Velocity>(state[2]);
  data.retract_speed = quantity<physics::Velocity>(state[3]);
  data.setpoint = quantity<physics::Force>(state[4]);
  std::size_t next = 5;
  for (std::string* text :
       {&data.instrument, &data.software, &data.software_version, &data.date, &data.time, &data.curve_id}) {
    *text = state[next++].cast<std::string>();
  }
  if (const py::object position = state[next++]; !position.is_none()) {
    const auto [x_m, y_m] = position.cast<std::pair<double, double>>();
    data.position = curves::CurvePosition{x_m, y_m};
  }
  data.pixel = pixel_from(state[next++]);
  data.parameters = state[next++].cast<std::vector<std::pair<std::string, std::string>>>();
  data.remarks = state[next].cast<std::vector<std::string>>();
  return data;
}

std::span<const double> numbers_in(const GivenArray& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

}  // namespace

std::vector<CurvePoint> points_from(std::span<const double> z_m, std::span<const double> force_n,
                                    std::span<const double> approach) {
  std::vector<CurvePoint> points;
  points.reserve(z_m.size());
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    if (!std::isfinite(z_m[i]) || !std::isfinite(force_n[i]) || !std::isfinite(approach[i])) {
      refuse(fmt::format("point {} is not finite", i));
    }
    if (approach[i] != 0.0 && approach[i] != 1.0) {
      refuse(fmt::format("approach: {} of point {} is neither True nor False", approach[i], i));
    }
    const auto branch = approach[i] != 0.0 ? physics::Branch::Approach : physics::Branch::Retract;
    if (i > 0 && branch == physics::Branch::Approach && points.back().branch == physics::Branch::Retract) {
      refuse(fmt::format("point {} is of the approach and after the retract", i));
    }
    points.push_back({physics::Length(z_m[i]), physics::Force(force_n[i]), branch});
    if (const std::string doubt = curves::doubt_of(points.back()); !doubt.empty()) {
      refuse(fmt::format("point {} {}", i, doubt));
    }
  }
  return points;
}

py::tuple state_of_curve(const Curve& curve) {
  const std::vector<CurvePoint>& points = curve.recorded.points;
  return py::make_tuple(
      curve.name, computed(points, [](const CurvePoint& point) { return point.z.si; }),
      computed(points, [](const CurvePoint& point) { return point.force.si; }),
      computed(points, [](const CurvePoint& point) { return point.branch == physics::Branch::Approach; }),
      computed(curve.recorded.time_s, [](double time_s) { return time_s; }), metadata_state(curve.recorded.metadata));
}

Curve curve_from_state(const py::tuple& state) {
  if (state.size() != 6) throw py::value_error("this is no pickled curve of this version of touchafm");
  const auto z = state[1].cast<GivenArray>(), force = state[2].cast<GivenArray>(),
             approach = state[3].cast<GivenArray>(), time = state[4].cast<GivenArray>();
  const auto metadata = state[5].cast<py::tuple>();
  if (force.size() != z.size() || approach.size() != z.size() || metadata.size() != 15) {
    throw py::value_error("this is no pickled curve of this version of touchafm");
  }
  Curve curve{state[0].cast<std::string>(), {}};
  curve.recorded.points = points_from(numbers_in(z), numbers_in(force), numbers_in(approach));
  curve.recorded.time_s.assign(time.data(), time.data() + time.size());
  curve.recorded.metadata = metadata_from(metadata);
  return curve;
}

}  // namespace afm::python
