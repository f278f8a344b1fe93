// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace afm::python {

// Metaclass of every class here: Python's own. pybind11's adds class properties, which are not used, and checks
// subclasses, of which there are none: combine it with pybind11::is_final().
inline pybind11::metaclass plain_type() { return pybind11::metaclass(reinterpret_cast<PyObject*>(&PyType_Type)); }

}  // namespace afm::python
