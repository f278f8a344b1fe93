// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/printable.h"
#include "curves/curve_series.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/curve_state.h"
#include "python/errors.h"
#include "python/long_work.h"
#include "python/result_type.h"
#include "python/unlocked.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using curves::RecordedCurve;
using physics::CurvePoint;

curves::CurveReading reading_of(std::optional<double> spring_constant, std::optional<double> sensitivity,
                                const std::optional<std::string>& columns) {
  curves::CurveReading reading;
  // the file's calibration is divided by it
  const auto check = [](const char* name, std::optional<double> value) {
    if (value && !(*value > 0.0 && std::isfinite(*value))) refuse(fmt::format("{}: {} is not positive", name, *value));
  };
  check("spring_constant", spring_constant);
  check("sensitivity", sensitivity);
  if (spring_constant) reading.spring_constant = physics::Stiffness(*spring_constant);
  reading.sensitivity_m_per_v = sensitivity;
  if (columns) reading.columns = value_of(curves::parse_table_columns(*columns));
  return reading;
}

// All curves of a file, in their order. The first that cannot be read refuses the file.
core::Result<std::vector<Curve>> read_all(const std::string& path, const curves::CurveReading& reading,
                                          const std::stop_token& stop) {
  const auto count = curves::curve_count(path, reading);
  if (!count) return tl::unexpected(count.error());
  const std::string name = std::filesystem::path(path).filename().string();
  std::vector<Curve> all;
  if (*count == 1) {
    auto curve = curves::load_curve(path, reading);
    if (!curve) return tl::unexpected(curve.error());
    all.push_back({name, std::move(*curve)});
    return all;
  }
  all.reserve(*count);
  std::optional<core::Error> fault;
  curves::read_curves(path, *count, {}, reading, [&](std::size_t, core::Result<RecordedCurve> curve) {
    if (curve) {
      all.push_back({name, std::move(*curve)});
    } else {
      fault = std::move(curve.error());
    }
    return !fault && !stop.stop_requested();
  });
  if (fault) return tl::unexpected(std::move(*fault));
  return all;
}

std::vector<Curve> read(const std::filesystem::path& path, std::optional<double> spring_constant,
                        std::optional<double> sensitivity, const std::optional<std::string>& columns) {
  return value_of(long_work([path = path.string(), reading = reading_of(spring_constant, sensitivity, columns)](
                                const std::stop_token& stop) { return read_all(path, reading, stop); }));
}

// Shape of an array as numpy prints it, "(3, 2)".
std::string shape_of(const GivenArray& given) { return py::str(given.attr("shape")); }

Curve make_curve(const GivenArray& z, const GivenArray& force, const GivenArray& approach,
                 std::optional<double> spring_constant, const std::string& name) {
  const auto count = static_cast<std::size_t>(z.size());
  if (z.ndim() != 1 || force.ndim() != 1 || approach.ndim() != 1 || force.size() != z.size() ||
      approach.size() != z.size()) {
    refuse(fmt::format("z, force and approach are one-dimensional and equally long; their shapes are {}, {} and {}",
                       shape_of(z), shape_of(force), shape_of(approach)));
  }
  if (count > curves::kMostCurvePoints) {
    refuse(fmt::format("a curve has at most {} points, not {}", curves::kMostCurvePoints, count));
  }
  Curve curve{name, {}};
  const std::span points(z.data(), count), forces(force.data(), count), approaches(approach.data(), count);
  Unlocked unlocked;
  curve.recorded.points = points_from(points, forces, approaches);
  unlocked.lock();
  if (spring_constant) {
    if (!(*spring_constant > 0.0 && std::isfinite(*spring_constant)))
      refuse(fmt::format("spring_constant: {} is not positive", *spring_constant));
    curve.recorded.metadata.spring_constant = physics::Stiffness(*spring_constant);
  }
  return curve;
}

py::dict metadata_of(const Curve& curve) {
  const curves::CurveMetadata& data = curve.recorded.metadata;
  py::dict result;
  const auto add_si = [&result](const char* key, const auto& value) {
    if (value) result[key] = value->si;
  };
  const auto add_text = [&result](const char* key, const std::string& text) {
    if (!text.empty()) result[key] = text;
  };
  add_si("spring_constant", data.spring_constant);
  if (data.sensitivity_m_per_v) result["sensitivity"] = *data.sensitivity_m_per_v;
  add_si("approach_speed", data.approach_speed);
  add_si("retract_speed", data.retract_speed);
  add_si("setpoint", data.setpoint);
  add_text("instrument", data.instrument);
  add_text("software", data.software);
  add_text("software_version", data.software_version);
  add_text("date", data.date);
  add_text("time", data.time);
  add_text("curve_id", data.curve_id);
  if (data.position) result["position"] = py::make_tuple(data.position->x_m, data.position->y_m);
  if (data.pixel) {
    result["pixel"] = py::make_tuple(data.pixel->column, data.pixel->row);
    result["grid"] = py::make_tuple(data.pixel->grid.columns, data.pixel->grid.rows);
    result["grid_size"] = py::make_tuple(data.pixel->grid.width_m, data.pixel->grid.height_m);
  }
  for (const auto& [key, value] : data.parameters) result[py::str(key)] = value;
  return result;
}

curves::WritableFormat format_of(const std::filesystem::path& path, const std::optional<std::string>& format) {
  if (!format) {
    if (const auto of_ending = curves::writable_format_of(path.string())) return *of_ending;
    refuse(fmt::format("{}: name a file that ends in .h5, .tab or, for AFM Workshop's, .csv, or give a format",
                       path.string()));
  }
  std::string words;
  for (const curves::WritableFormat& row : curves::writable_formats()) {
    if (row.word == *format) return row;
    words += (words.empty() ? "" : ", ") + std::string(row.word);
  }
  refuse(fmt::format("unknown format \"{}\"; choose {}", *format, words));
}

void write(const Curve& curve, const std::filesystem::path& path, const std::optional<std::string>& format) {
  value_of(long_work([curve = curve.recorded, path = path.string(), written = format_of(path, format).format](
                         const std::stop_token&) { return curves::write_curve(path, written, curve); }));
}

template <class Member>
auto points_of(Member member) {
  return [member](const py::object& self) {
    return column(self, self.cast<const Curve&>().recorded.points,
                  [member](const CurvePoint& point) -> const double& { return (point.*member).si; });
  };
}

void add_curve(py::module_& module) {
  py::class_<Curve>(module, "Curve", plain_type(), py::is_final(),
                    "A force-distance curve of an instrument or a model: approach, then retract. Immutable.")
      .def(py::init(&make_curve), py::kw_only(), py::arg("z"), py::arg("force"), py::arg("approach"),
           py::arg("spring_constant") = py::none(), py::arg("name") = "curve",
           "A curve of arrays: z of the lever's base, m, smaller is deeper; force, N, positive away from the sample;\n"
           "approach, True there; spring_constant in N/m, which a fit needs. ValueError for arrays that differ in\n"
           "length, are not finite, or return to the approach.")
      .def_readonly("name", &Curve::name, "Name in messages: that of the file.")
      .def_property_readonly("z", points_of(&CurvePoint::z), "Height of the lever's base, m.")
      .def_property_readonly("force", points_of(&CurvePoint::force), "Force, N, positive away from the sample.")
      .def_property_readonly(
          "approach",
          [](const Curve& self) {
            return computed(self.recorded.points,
                            [](const CurvePoint& point) { return point.branch == physics::Branch::Approach; });
          },
          "True on the approach.")
      .def_property_readonly(
          "time",
          [](const py::object& self) {
            return column(self, self.cast<const Curve&>().recorded.time_s, std::identity());
          },
          "Time since the first point, s; empty if unknown.")
      .def_property_readonly("metadata", &metadata_of, "What the file says of the recording, in SI.")
      .def_property_readonly(
          "remarks", [](const Curve& self) { return self.recorded.metadata.remarks; },
          "What was left out or turned, a sentence each.")
      .def("write", &write, py::arg("path"), py::kw_only(), py::arg("format") = py::none(),
           "Writes a file for other programs, whole or not at all: format \"tab\" or \"h5\" of afmformats, or\n"
           "\"afm-workshop\"; default: by the ending of its name. ValueError for another format or ending, FileError "
           "if it\n"
           "cannot be written.")
      .def(py::pickle([](const Curve& self) { return state_of_curve(self); }, &curve_from_state))
      .def("__len__", [](const Curve& self) { return self.recorded.points.size(); })
      .def("__repr__", [](const Curve& self) {
        return fmt::format("<touchafm.Curve {}, {} points>", core::printable_line(self.name),
                           self.recorded.points.size());
      });
  module.def("read", &read, py::arg("path"), py::kw_only(), py::arg("spring_constant") = py::none(),
             py::arg("sensitivity") = py::none(), py::arg("columns") = py::none(),
             "All curves of a file, as a list: every format that touchafm analyse reads.\n\n"
             "spring_constant, N/m, and sensitivity, m/V, replace those of the file; columns reads a plain table\n"
             "(\"height:um force:nN\"). FileError if the file or one of its curves cannot be understood.");
}

}  // namespace

void add_files(py::module_& module) { add_curve(module); }

}  // namespace afm::python
