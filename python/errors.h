// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>
#include <type_traits>
#include <utility>

#include "core/result.h"

namespace afm::python {

// Origin of a fault if the usage is right: a file, or data that the program already has.
enum class FaultOf { File, Data };

// An error of the library on its way to Python: wrong usage becomes ValueError, a fault of data touchafm.DataError, one
// of a file touchafm.FileError.
class Refusal : public std::exception {
 public:
  explicit Refusal(core::Error error, FaultOf fault = FaultOf::File) : error_(std::move(error)), fault_(fault) {}
  const char* what() const noexcept override { return error_.message.c_str(); }
  const std::string& message() const { return error_.message; }
  core::ErrorCategory category() const { return error_.category; }
  FaultOf fault() const { return fault_; }

 private:
  core::Error error_;
  FaultOf fault_;
};

template <class T>
T value_of(core::Result<T> result, FaultOf fault = FaultOf::File) {
  if (!result) throw Refusal(std::move(result.error()), fault);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

[[noreturn]] inline void refuse(std::string message) {
  throw Refusal({core::ErrorCategory::WrongUsage, std::move(message)});
}

}  // namespace afm::python
