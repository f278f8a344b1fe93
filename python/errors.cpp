// SPDX-License-Identifier: Apache-2.0
#include "python/errors.h"

#include <exception>
#include <utility>

#include "core/printable.h"
#include "python/bindings.h"

namespace afm::python {

namespace py = pybind11;

void add_errors(py::module_& module) {
  static py::handle file_error, data_error;  // types of the module, which Python never unloads
  file_error = py::exception<Refusal>(module, "FileError", PyExc_OSError).release();
  file_error.attr("__doc__") = "A file cannot be read, understood or written; the message names it and says why.";
  data_error = py::exception<Refusal>(module, "DataError", PyExc_ValueError).release();
  data_error.attr("__doc__") =
      "Nothing is found in a curve or spectrum that was read or given as arrays: no contact to fit, no resonance; the "
      "message says why.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const Refusal& refusal) {
      const bool usage = refusal.category() == core::ErrorCategory::WrongUsage;
      const py::handle fault = refusal.fault() == FaultOf::Data ? data_error : file_error;
      // a name may hold bytes that are no UTF-8, or the byte 0
      PyErr_SetString(usage ? PyExc_ValueError : fault.ptr(), core::printable(refusal.message()).c_str());
    }
  });
}

}  // namespace afm::python
