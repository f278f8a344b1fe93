// SPDX-License-Identifier: Apache-2.0
#include "python/surface.h"

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <utility>

#include "python/bindings.h"
#include "python/result_type.h"

namespace afm::python {

namespace py = pybind11;

namespace {

Surface make_surface(std::filesystem::path sample, std::optional<double> size, std::string channel,
                     std::optional<std::string> level) {
  return {std::move(sample), size, std::move(channel), std::move(level)};
}

}  // namespace

void add_surfaces(py::module_& module) {
  py::class_<Surface>(module, "Surface", plain_type(), py::is_final(), "A sample for scan(); surface() makes it.")
      .def_property_readonly(
          "sample", [](const Surface& self) { return self.sample.string(); }, "Name of the file, or \"gratings\".")
      .def_property_readonly(
          "size", [](const Surface& self) { return self.size; },
          "Width of its images, m; None: that of the whole sample.")
      .def("__repr__",
           [](const Surface& self) { return fmt::format("<touchafm.Surface \"{}\">", self.sample.string()); });
  module.def(
      "surface", &make_surface, py::arg("sample"), py::kw_only(), py::arg("size") = py::none(),
      py::arg("sample_channel") = "", py::arg("level") = py::none(),
      "A sample for scan() in place of a material's.\n\n"
      "sample: a glTF model or an image, or \"gratings\": bars 10 nm high, with a pitch of 200 nm on the left and\n"
      "100 nm on the right. size: width of its images, m; default: that of the sample. sample_channel and level:\n"
      "as for scan(), which raises ValueError and FileError for what it cannot use.");
}

}  // namespace afm::python
