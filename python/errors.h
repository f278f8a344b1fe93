// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>
#include <type_traits>
#include <utility>

#include "core/result.h"

namespace afm::python {

// An error of the library on its way to Python: wrong usage becomes ValueError, anything else touchafm.FileError.
class Refusal : public std::exception {
 public:
  explicit Refusal(core::Error error) : error_(std::move(error)) {}
  const char* what() const noexcept override { return error_.message.c_str(); }
  const std::string& message() const { return error_.message; }
  core::ErrorCategory category() const { return error_.category; }

 private:
  core::Error error_;
};

template <class T>
T value_of(core::Result<T> result) {
  if (!result) throw Refusal(std::move(result.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

[[noreturn]] inline void refuse(std::string message) {
  throw Refusal({core::ErrorCategory::WrongUsage, std::move(message)});
}

}  // namespace afm::python
