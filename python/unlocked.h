// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

namespace afm::python {

// Python's other threads run while this is there, until lock(). Like pybind11's gil_scoped_release, whose destructor
// ends the whole program where Python ends a thread that wants its lock after the program's last line: lock() lets such
// a thread unwind.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() {
    if (state_ != nullptr) PyEval_RestoreThread(state_);
  }

  // Takes the lock again.
  void lock() { PyEval_RestoreThread(std::exchange(state_, nullptr)); }

 private:
  PyThreadState* state_;
};

}  // namespace afm::python
