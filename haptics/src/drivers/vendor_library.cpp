// SPDX-License-Identifier: Apache-2.0
#include "drivers/vendor_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include "drivers/function_binder.h"

namespace afm::haptics {

namespace {

// Removes the name that the dynamic linker repeats.
std::string without_name(const LibraryAttempt& attempt) {
  const std::string prefix = attempt.name + ": ";
  return attempt.refusal.starts_with(prefix) ? attempt.refusal.substr(prefix.size()) : attempt.refusal;
}

}  // namespace

std::vector<LibraryAttempt> load_first(std::span<const char* const> names, const std::string& configured,
                                       const std::function<std::string(void* library)>& bind) {
  std::vector<std::string> wanted(names.begin(), names.end());
  if (!configured.empty()) wanted = {configured};

  std::vector<LibraryAttempt> attempts;
  for (const std::string& name : wanted) {
    LibraryAttempt& attempt = attempts.emplace_back(LibraryAttempt{name, {}});
    // never closed, not even when refused; its own plug-ins look for its symbols among the global ones
    void* library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_GLOBAL);
    attempt.refusal = library == nullptr ? linker_error() : bind(library);
    if (attempt.refusal.empty()) break;
  }
  return attempts;
}

void log_attempts(std::string_view subject, const std::vector<LibraryAttempt>& attempts, ProbeLog& log) {
  for (const LibraryAttempt& attempt : attempts) {
    const bool taken = attempt.refusal.empty();
    log.tried(fmt::format("{} {}", subject, attempt.name), taken, taken ? "loaded" : without_name(attempt));
  }
}

tl::unexpected<core::Error> no_library(std::string_view device, const ProbeLog& log, const char* variable) {
  std::string tried;
  for (const ProbeLine& line : log.lines())
    tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", line.subject, line.said);
  return core::failure(core::ErrorCategory::DeviceMissing,
                       fmt::format("no {}: {}; install the device's driver, or set {} to the path of its library",
                                   device, tried, variable));
}

}  // namespace afm::haptics
