// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.h"

namespace afm::core {

// Exit codes of every command; scripts rely on them.
enum class ExitCode : int { Done = 0, RunFailed = 1, WrongUsage = 2, BadInputFile = 3, DeviceMissing = 4 };

inline ExitCode exit_code(core::ErrorCategory category) {
  switch (category) {
    case core::ErrorCategory::WrongUsage:
      return ExitCode::WrongUsage;
    case core::ErrorCategory::BadInputFile:
      return ExitCode::BadInputFile;
    case core::ErrorCategory::DeviceMissing:
      return ExitCode::DeviceMissing;
    case core::ErrorCategory::Failed:
      break;
  }
  return ExitCode::RunFailed;
}

}  // namespace afm::core
