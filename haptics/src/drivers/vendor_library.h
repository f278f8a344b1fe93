// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "haptics/device_registry.h"

// Library of a device's manufacturer, installed by the lab and loaded at run time. None of its headers, binaries or
// texts is in this tree.
namespace afm::haptics {

// Library that was tried. `refusal` is the reason why it was rejected: the dynamic linker's message, a missing function
// or a wrong version; empty for the one in use.
struct LibraryAttempt {
  std::string name;
  std::string refusal;
};

template <class Functions>
struct LibrarySearch {
  std::optional<Functions> functions;
  std::vector<LibraryAttempt> attempts;  // attempts in order; the last one is in use if `functions` is set
};

// Loads only `configured` if it is not empty; otherwise the first of `names` that can be loaded and that `bind`
// accepts. `bind` returns the reason for a refusal, or an empty text. Libraries stay loaded for the lifetime of the
// process, refused ones too: no driver of this kind survives unloading and reloading. Any thread, not a servo tick.
std::vector<LibraryAttempt> load_first(std::span<const char* const> names, const std::string& configured,
                                       const std::function<std::string(void* library)>& bind);

// Searches in this way for a table of functions, which `bind_all` fills.
template <class Functions>
LibrarySearch<Functions> search_library(std::span<const char* const> names, const std::string& configured,
                                        std::string (*bind_all)(void* library, Functions& functions)) {
  LibrarySearch<Functions> search;
  Functions functions;
  search.attempts = load_first(names, configured, [&](void* library) { return bind_all(library, functions); });
  if (search.attempts.back().refusal.empty()) search.functions = functions;
  return search;
}

// One line for each attempt: "hdapi library libHD.so: loaded" for the subject "hdapi library".
void log_attempts(std::string_view subject, const std::vector<LibraryAttempt>& attempts, ProbeLog& log);

// DeviceMissing, with all lines of `log` and the remedy. `device` is "hdapi device", `variable` names the library.
tl::unexpected<core::Error> no_library(std::string_view device, const ProbeLog& log, const char* variable);

}  // namespace afm::haptics
