// SPDX-License-Identifier: Apache-2.0
#include "python/drive.h"

#include <fmt/format.h>

#include <string>

#include "python/bindings.h"
#include "python/errors.h"
#include "python/result_type.h"

namespace afm::python {

namespace py = pybind11;

Drive joined(const DriveArgument& argument, Drive beside) {
  if (!argument) return beside;
  Drive drive;
  if (const auto* frequency = std::get_if<double>(&*argument)) {
    drive.frequency = *frequency;
  } else {
    drive = std::get<Drive>(*argument);
  }
  for (const DriveMember& each : kDriveMembers) {
    const std::optional<double>& given = drive.*each.value;
    if (!given) continue;
    if (beside.*each.value) refuse(fmt::format("{}: it is given by drive, too; leave one out", each.name));
    beside.*each.value = given;
  }
  return beside;
}

void add_drive(py::module_& module) {
  using Number = std::optional<double>;
  py::class_<Drive> drive(module, "Drive", plain_type(), py::is_final(),
                          "A lever that taps, for tapping() and scan(). SI; None where nothing was given. Immutable.");
  drive.def(
      py::init([](double free_amplitude, Number resonance, Number quality_factor, Number frequency, Number viscosity,
                  Number contact_gap) {
        return Drive{free_amplitude, resonance, quality_factor, frequency, viscosity, contact_gap};
      }),
      py::kw_only(), py::arg("free_amplitude"), py::arg("resonance") = py::none(),
      py::arg("quality_factor") = py::none(), py::arg("frequency") = py::none(), py::arg("viscosity") = py::none(),
      py::arg("contact_gap") = py::none(),
      "free_amplitude, m, zero-to-peak; resonance, Hz, and quality_factor instead of the contact's; frequency of\n"
      "the drive, Hz, default: at the resonance; viscosity of the contact, Pa*s; contact_gap, m, instead of the\n"
      "contact's work of adhesion. tapping() and scan() raise ValueError for what is impossible.");
  for (const DriveMember& each : kDriveMembers) {
    drive.def_property_readonly(
        each.name, [value = each.value](const Drive& self) { return self.*value; }, each.meaning);
  }
  drive.def("__repr__", [](const Drive& self) {
    std::string text;
    for (const DriveMember& each : kDriveMembers) {
      if (self.*each.value) text += fmt::format("{}{}={:g}", text.empty() ? "" : ", ", each.name, *(self.*each.value));
    }
    return fmt::format("touchafm.Drive({})", text);
  });
}

}  // namespace afm::python
