// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>

#include <string>

namespace afm::haptics {

// Reason for the failure of this thread's last dlopen().
inline std::string linker_error() {
  const char* text = ::dlerror();  // NOLINT(concurrency-mt-unsafe): glibc keeps one for each thread
  return text == nullptr ? "the dynamic linker gave no reason" : text;
}

// Looks up functions of one library and remembers the first that is missing.
class FunctionBinder {
 public:
  explicit FunctionBinder(void* library) : library_(library) {}

  template <class Function>
  void bind(const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(::dlsym(library_, name));
    if (function == nullptr && missing_.empty()) missing_ = name;
  }

  // Reason for a refusal, "it lacks the function dhdOpenID"; empty if no function is missing.
  std::string refusal() const { return missing_.empty() ? std::string() : "it lacks the function " + missing_; }

 private:
  void* library_;
  std::string missing_;
};

}  // namespace afm::haptics
