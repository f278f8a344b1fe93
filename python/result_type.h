// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace afm::python {

// Metaclass of every class here: Python's own. pybind11's brings properties of classes, which nobody uses, and looks at
// subclasses, of which there are none: add pybind11::is_final() beside it.
inline pybind11::metaclass plain_type() { return pybind11::metaclass(reinterpret_cast<PyObject*>(&PyType_Type)); }

}  // namespace afm::python
