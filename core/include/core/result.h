// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace afm::core {

// Failure of the outside world. The category determines the program's exit code (core/exit_code.h); the message says
// what was tried, with what, and what to do, on one line, in lower case, without a full stop.
enum class ErrorCategory { Failed, WrongUsage, BadInputFile, DeviceMissing };

struct Error {
  ErrorCategory category = ErrorCategory::Failed;
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> failure(ErrorCategory category, std::string message) {
  return tl::unexpected<Error>(Error{category, std::move(message)});
}

inline tl::unexpected<Error> wrong_usage(std::string message) {
  return failure(ErrorCategory::WrongUsage, std::move(message));
}

}  // namespace afm::core
