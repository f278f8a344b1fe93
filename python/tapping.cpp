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
#include "python/drive.h"
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

// touchafm.Tapping: what was asked for, and what it gave.
struct Tapping {
  curves::TappingChoice choice;
  curves::PathOptions path;
  TappingRun run;
};

TappingRun computed_run(const curves::ContactSetup& setup, const curves::TappingChoice& choice,
                        const curves::PathOptions& path) {
  value_of(curves::check_path(choice, path));
  return value_of(long_work([setup, path, numbers = choice.numbers](const std::stop_token& stop) {
    return curves::run_tapping(setup, path, numbers,
                               [&stop](std::size_t, std::size_t) { return !stop.stop_requested(); });
  }));
}

curves::PathOptions path_of(std::optional<double> z_from, std::optional<double> z_to, std::optional<double> step,
                            std::optional<double> speed) {
  return {.from = typed(z_from, "m"), .to = typed(z_to, "m"), .step = typed(step, "m"), .speed = typed(speed, "m/s")};
}

Tapping make_tapping(const Contact& contact, const DriveArgument& drive, std::optional<double> free_amplitude,
                     std::optional<double> resonance, std::optional<double> quality_factor,
                     std::optional<double> contact_gap, std::optional<double> viscosity,
                     const std::optional<std::string>& law, const std::optional<std::string>& method,
                     std::optional<double> at, std::optional<double> z_from, std::optional<double> z_to,
                     std::optional<double> step, std::optional<double> speed) {
  if (method && *method != "averaged" && *method != "direct") {
    refuse(fmt::format("unknown method \"{}\"; choose averaged or direct", *method));
  }
  const Drive swing = joined(drive, {free_amplitude, resonance, quality_factor, std::nullopt, viscosity, contact_gap});
  if (!swing.free_amplitude) refuse("tapping needs free_amplitude, m, or a Drive with it");
  curves::TappingChoice choice;
  choice.mode = "tapping";
  choice.numbers.free_amplitude = typed(swing.free_amplitude, "m");
  choice.numbers.drive = typed(swing.frequency, "Hz");
  choice.numbers.viscosity = typed(swing.viscosity, "Pa*s");
  choice.numbers.method = method.value_or("");
  choice.numbers.at = typed(at, "m");
  choice.contact_gap = typed(swing.contact_gap, "m");
  curves::ContactOptions options = contact.options();
  if (law) options.model = *law;
  if (swing.contact_gap) options.si_values.erase("work-of-adhesion");
  if (swing.resonance) options.si_values["resonance"] = *swing.resonance;
  if (swing.quality_factor) options.si_values["quality-factor"] = *swing.quality_factor;
  const curves::PathOptions path = path_of(z_from, z_to, step, speed);
  value_of(curves::check_path(choice, path));
  TappingRun run = computed_run(value_of(curves::driven_setup(choice, options)), choice, path);
  return {std::move(choice), path, std::move(run)};
}

py::object states_of(const Tapping& self, double z) {
  curves::TappingChoice choice(self.choice);
  choice.numbers.at = typed(z, "m");
  return dict_of(curves::tapping_json(computed_run(self.run.setup, choice, {})))["states"];
}

// The same lever over the same contact on another path.
Tapping curve_of(const Tapping& self, std::optional<double> z_from, std::optional<double> z_to,
                 std::optional<double> step, std::optional<double> speed) {
  Tapping other{self.choice, path_of(z_from, z_to, step, speed), {}};
  other.choice.numbers.at.clear();
  other.run = computed_run(self.run.setup, other.choice, other.path);
  return other;
}

py::object folds_of(const Tapping& self) {
  const bool at_rest = !self.run.at && !self.run.path.speed;
  curves::PathOptions path(self.path);
  path.speed.clear();
  curves::TappingChoice choice(self.choice);
  choice.numbers.at.clear();
  return dict_of(curves::tapping_json(at_rest ? self.run : computed_run(self.run.setup, choice, path)))["jumps"];
}

template <class Value>
auto points(Value value) {
  return [value](const Tapping& self) { return computed(self.run.curve.points, value); };
}

}  // namespace

void add_tapping(py::module_& module) {
  py::class_<Tapping>(module, "Tapping", plain_type(), py::is_final(),
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
          "as_dict", [](const Tapping& self) { return dict_of(curves::tapping_json(self.run)); },
          "The JSON of touchafm curve --mode tapping: jumps, loops and islands, or the states at one height.")
      .def("states", &states_of, py::arg("z"),
           "All states at the height z, m, of the unbent lever's tip: a list of dicts, as \"states\" of the JSON of\n"
           "touchafm curve --mode tapping --at. Raises ValueError for an impossible height.")
      .def_property_readonly("folds", &folds_of,
                             "Jumps of the lever at rest at each height, where a state ends: a list of dicts, as "
                             "\"jumps\" of the JSON; if this curve was taken at a speed, computed for it.")
      .def("curve", &curve_of, py::kw_only(), py::arg("z_from") = py::none(), py::arg("z_to") = py::none(),
           py::arg("step") = py::none(), py::arg("speed") = py::none(),
           "The curve of the same lever over the same contact on another path: z_from, z_to and step, m, at a speed,\n"
           "m/s, default: at rest at each height. Raises ValueError as tapping().")
      .def("__len__", [](const Tapping& self) { return self.run.curve.points.size(); })
      .def("__repr__", [](const Tapping& self) {
        return fmt::format("<touchafm.Tapping {} on {}, {} points>", self.run.model, self.run.setup.material.name,
                           self.run.curve.points.size());
      });
  module.def(
      "tapping", &make_tapping, py::arg("contact"), py::arg("drive") = py::none(), py::kw_only(),
      py::arg("free_amplitude") = py::none(), py::arg("resonance") = py::none(), py::arg("quality_factor") = py::none(),
      py::arg("contact_gap") = py::none(), py::arg("viscosity") = py::none(), py::arg("law") = py::none(),
      py::arg("method") = py::none(), py::arg("at") = py::none(), py::arg("z_from") = py::none(),
      py::arg("z_to") = py::none(), py::arg("step") = py::none(), py::arg("speed") = py::none(),
      "A tapping curve, as touchafm curve --mode tapping computes it, or the states at the height `at`, m.\n\n"
      "free_amplitude, m, zero-to-peak; resonance, Hz, and quality_factor instead of the contact's; drive: its\n"
      "frequency, Hz, default: at the resonance, or a Drive with all of these numbers; contact_gap, m, instead of the "
      "contact's work of adhesion; viscosity, Pa*s;\n"
      "method: \"averaged\" (Q of at least 100) or \"direct\"; z_from, z_to, step: path of the unbent lever's tip, m;\n"
      "speed, m/s, default: at rest at each height.\n"
      "Raises ValueError as the command refuses its options. docs/tapping.md has the equations with their sources.");
}

}  // namespace afm::python
