// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
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
using curves::FrequencyShiftRun;
using physics::FrequencyShiftPoint;

FrequencyShiftRun make_frequency_shift(const Contact& contact, double amplitude, std::optional<double> resonance,
                                       std::optional<double> contact_gap, std::optional<double> viscosity,
                                       const std::optional<std::string>& law, std::optional<double> at,
                                       std::optional<double> z_from, std::optional<double> z_to,
                                       std::optional<double> step) {
  curves::TappingChoice choice;
  choice.mode = "fm";
  choice.numbers.amplitude = typed(amplitude, "m");
  choice.numbers.viscosity = typed(viscosity, "Pa*s");
  choice.numbers.at = typed(at, "m");
  choice.contact_gap = typed(contact_gap, "m");
  curves::ContactOptions options = contact.options();
  if (law) options.model = *law;
  if (contact_gap) options.si_values.erase("work-of-adhesion");
  if (resonance) options.si_values["resonance"] = *resonance;
  const curves::PathOptions path{.from = typed(z_from, "m"), .to = typed(z_to, "m"), .step = typed(step, "m")};
  value_of(curves::check_path(choice, path));
  return value_of(long_work([setup = value_of(curves::driven_setup(choice, options)), path, numbers = choice.numbers](
                                const std::stop_token&) { return curves::run_frequency_shift(setup, path, numbers); }));
}

template <class Value>
auto heights(Value value) {
  return [value](const FrequencyShiftRun& self) { return computed(self.curve.points, value); };
}

py::list turns_of(const FrequencyShiftRun& self) {
  py::list turns;
  for (const physics::FrequencyShiftTurn& turn : self.curve.turns) {
    py::dict row;
    row["z"] = turn.z.si;
    row["shift"] = turn.shift.si;
    turns.append(std::move(row));
  }
  return turns;
}

}  // namespace

void add_frequency_shifts(py::module_& module) {
  py::class_<FrequencyShiftRun>(module, "FrequencyShift", plain_type(), py::is_final(),
                                "Shift of the resonance of a lever whose amplitude is kept constant, from the highest "
                                "place down (Giessibl 1997). Amplitudes are zero-to-peak. Immutable.")
      .def_property_readonly("z", heights([](const FrequencyShiftPoint& point) { return point.z.si; }),
                             "Mean height of the tip, m.")
      .def_property_readonly("shift", heights([](const FrequencyShiftPoint& point) { return point.shift.si; }),
                             "Frequency shift, Hz.")
      .def_property_readonly("small_amplitude_shift",
                             heights([](const FrequencyShiftPoint& point) { return point.small_amplitude_shift.si; }),
                             "Shift by the force gradient at the mean height alone, Hz.")
      .def_property_readonly("mean_force",
                             heights([](const FrequencyShiftPoint& point) { return point.averages.mean.si; }),
                             "Mean force on the tip, N.")
      .def_property_readonly("peak_force",
                             heights([](const FrequencyShiftPoint& point) { return point.averages.peak.si; }),
                             "Force at the lowest point of the swing, N.")
      .def_property_readonly("energy_lost",
                             heights([](const FrequencyShiftPoint& point) { return point.averages.lost.si; }),
                             "Energy lost in the sample per swing, J.")
      .def_property_readonly("turns", &turns_of,
                             "Places at which the shift turns, from the highest down: dicts of z m and shift Hz. A "
                             "feedback holds the tip only on one side of each.")
      .def(
          "as_dict", [](const FrequencyShiftRun& self) { return dict_of(curves::frequency_shift_json(self)); },
          "The JSON of touchafm curve --mode fm.")
      .def("__len__", [](const FrequencyShiftRun& self) { return self.curve.points.size(); })
      .def("__repr__", [](const FrequencyShiftRun& self) {
        return fmt::format("<touchafm.FrequencyShift {} on {}, {} points>", self.model, self.setup.material.name,
                           self.curve.points.size());
      });
  module.def(
      "frequency_shift", &make_frequency_shift, py::arg("contact"), py::kw_only(), py::arg("amplitude"),
      py::arg("resonance") = py::none(), py::arg("contact_gap") = py::none(), py::arg("viscosity") = py::none(),
      py::arg("law") = py::none(), py::arg("at") = py::none(), py::arg("z_from") = py::none(),
      py::arg("z_to") = py::none(), py::arg("step") = py::none(),
      "The frequency shift at constant amplitude, as touchafm curve --mode fm computes it, or its value at the\n"
      "height `at`, m.\n\n"
      "amplitude, m, zero-to-peak; resonance, Hz, instead of the contact's; contact_gap, m, instead of the\n"
      "contact's work of adhesion; viscosity, Pa*s; z_from, z_to, step: path of the tip's mean height, m. Raises\n"
      "ValueError as the command refuses its options.\n"
      "docs/tapping.md has the equations with their sources.");
}

}  // namespace afm::python
