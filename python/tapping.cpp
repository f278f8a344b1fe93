// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "curves/tapping/driven_setup.h"
#include "curves/tapping/tapping_output.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/contact.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/numbers.h"
#include "python/result_type.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using curves::TappingRun;
using physics::TapPoint;

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

TappingRun make_tapping(const Contact& contact, double free_amplitude, std::optional<double> resonance,
                        std::optional<double> quality_factor, std::optional<double> drive,
                        std::optional<double> contact_gap, std::optional<double> viscosity,
                        const std::optional<std::string>& law, const std::optional<std::string>& method,
                        std::optional<double> at, std::optional<double> z_from, std::optional<double> z_to,
                        std::optional<double> step, std::optional<double> speed) {
  if (method && *method != "averaged" && *method != "direct") {
    refuse(fmt::format("unknown method \"{}\"; choose averaged or direct", *method));
  }
  curves::TappingChoice choice;
  choice.mode = "tapping";
  choice.numbers.free_amplitude = typed(free_amplitude, "m");
  choice.numbers.drive = typed(drive, "Hz");
  choice.numbers.viscosity = typed(viscosity, "Pa*s");
  choice.numbers.method = method.value_or("");
  choice.numbers.at = typed(at, "m");
  choice.contact_gap = typed(contact_gap, "m");
  curves::ContactOptions options = contact.options();
  if (law) options.model = *law;
  if (contact_gap) options.si_values.erase("work-of-adhesion");
  if (resonance) options.si_values["resonance"] = *resonance;
  if (quality_factor) options.si_values["quality-factor"] = *quality_factor;
  const curves::PathOptions path{
      .from = typed(z_from, "m"), .to = typed(z_to, "m"), .step = typed(step, "m"), .speed = typed(speed, "m/s")};
  value_of(curves::check_path(choice, path));
  return value_of(long_work([setup = value_of(curves::driven_setup(choice, options)), path,
                             numbers = choice.numbers](const std::stop_token& stop) {
    return curves::run_tapping(setup, path, numbers,
                               [&stop](std::size_t, std::size_t) { return !stop.stop_requested(); });
  }));
}

template <class Value>
auto points(Value value) {
  return [value](const TappingRun& self) { return computed(self.curve.points, value); };
}

}  // namespace

void add_tapping(py::module_& module) {
  py::class_<TappingRun>(module, "Tapping", plain_type(), py::is_final(),
                         "Swing of a driven lever over a sample, on the way down and up again, or the states at one "
                         "height. Amplitudes are zero-to-peak; phases are the tip's lag behind the drive. Immutable.")
      .def_property_readonly("z", points([](const TapPoint& point) { return point.z.si; }),
                             "Height of the unbent lever's tip, m; empty for states at one height.")
      .def_property_readonly("amplitude", points([](const TapPoint& point) { return point.state.amplitude.si; }),
                             "Amplitude, m.")
      .def_property_readonly("phase", points([](const TapPoint& point) { return degrees(point.state.phase); }),
                             "Phase, degrees, as in the command's JSON.")
      .def_property_readonly("mean_force", points([](const TapPoint& point) { return point.averages.mean.si; }),
                             "Mean force on the tip, N.")
      .def_property_readonly("peak_force", points([](const TapPoint& point) { return point.averages.peak.si; }),
                             "Force at the lowest point, N.")
      .def_property_readonly("energy_lost", points([](const TapPoint& point) { return point.averages.lost.si; }),
                             "Energy lost in the sample per swing, J.")
      .def_property_readonly("approach",
                             points([](const TapPoint& point) { return point.branch == physics::Branch::Approach; }),
                             "True on the approach.")
      .def(
          "as_dict", [](const TappingRun& self) { return dict_of(curves::tapping_json(self)); },
          "The JSON of touchafm curve --mode tapping: jumps, loops and islands, or the states at one height.")
      .def("__len__", [](const TappingRun& self) { return self.curve.points.size(); })
      .def("__repr__", [](const TappingRun& self) {
        return fmt::format("<touchafm.Tapping {} on {}, {} points>", self.model, self.setup.material.name,
                           self.curve.points.size());
      });
  module.def(
      "tapping", &make_tapping, py::arg("contact"), py::kw_only(), py::arg("free_amplitude"),
      py::arg("resonance") = py::none(), py::arg("quality_factor") = py::none(), py::arg("drive") = py::none(),
      py::arg("contact_gap") = py::none(), py::arg("viscosity") = py::none(), py::arg("law") = py::none(),
      py::arg("method") = py::none(), py::arg("at") = py::none(), py::arg("z_from") = py::none(),
      py::arg("z_to") = py::none(), py::arg("step") = py::none(), py::arg("speed") = py::none(),
      "A tapping curve, as touchafm curve --mode tapping computes it, or the states at the height `at`, m.\n\n"
      "free_amplitude, m, zero-to-peak; resonance, Hz, and quality_factor instead of the contact's; drive, Hz,\n"
      "default: at the resonance; contact_gap, m, instead of the contact's work of adhesion; viscosity, Pa*s;\n"
      "method: \"averaged\" (Q of at least 100) or \"direct\"; z_from, z_to, step: path of the unbent lever's tip, m;\n"
      "speed, m/s, default: at rest at each height.\n"
      "Raises ValueError as the command refuses its options. docs/tapping.md has the equations with their sources.");
}

}  // namespace afm::python
