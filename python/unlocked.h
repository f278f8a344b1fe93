// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

namespace afm::python {

// Lets Python's other threads run during its lifetime, until lock(). Unlike pybind11's gil_scoped_release, whose
// destructor ends the program where Python ends a thread that wants its lock after the program's last line: lock() lets
// such a thread unwind.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() {
    if (state_ != nullptr) PyEval_RestoreThread(state_);
  }

  // Acquires the lock again.
  void lock() { PyEval_RestoreThread(std::exchange(state_, nullptr)); }

 private:
  PyThreadState* state_;
};

}  // namespace afm::python
