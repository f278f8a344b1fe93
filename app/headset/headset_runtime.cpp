// SPDX-License-Identifier: Apache-2.0
#include "app/headset/headset_runtime.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

namespace afm::app {

namespace {

std::string from_environment(const char* name) {
  const char* value = ::secure_getenv(name);
  return value == nullptr ? "" : value;
}

// NOLINTNEXTLINE(concurrency-mt-unsafe): no command has another thread then that asks
void silence_loader() { ::setenv("XR_LOADER_DEBUG", "none", 0); }

// Checks the manifest named by the user, since OpenXR's loader reports only that there is no runtime.
core::Result<void> check_named_manifest() {
  const std::string named = from_environment("XR_RUNTIME_JSON");
  std::error_code ignored;
  if (named.empty() || std::filesystem::exists(named, ignored)) return {};
  return core::failure(core::ErrorCategory::DeviceMissing,
                       fmt::format("no headset: XR_RUNTIME_JSON names {}, which does not exist: set it to the manifest "
                                   "of your headset's runtime, or unset it to use the system's",
                                   named));
}

}  // namespace

std::string headset_manifest() {
  if (std::string named = from_environment("XR_RUNTIME_JSON"); !named.empty()) return named;
  std::string own = from_environment("XDG_CONFIG_HOME");
  if (own.empty()) own = from_environment("HOME") + "/.config";
  for (const std::string& folder : std::vector<std::string>{own, "/etc/xdg", "/usr/local/share", "/usr/share"}) {
    const std::string file = folder + "/openxr/1/active_runtime.json";
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) return file;
  }
  return {};
}

core::Result<std::unique_ptr<render::HeadsetRuntime>> connect_headset() {
  if (const auto named = check_named_manifest(); !named) return tl::unexpected(named.error());
  silence_loader();
  return render::HeadsetRuntime::connect(headset_manifest());
}

core::Result<render::HeadsetDescription> find_headset() {
  if (const auto named = check_named_manifest(); !named) return tl::unexpected(named.error());
  silence_loader();
  return render::describe_headset(headset_manifest());
}

std::string text_of(const render::HeadsetDescription& headset) {
  std::string text = fmt::format("{} through {}, head-mounted display, {} x {} pixels an eye, {}, formats {}",
                                 headset.headset, headset.runtime, headset.eye_px.x, headset.eye_px.y,
                                 headset.refresh_hz ? fmt::format("{:g} Hz", *headset.refresh_hz) : "rate unknown",
                                 fmt::join(headset.formats, " "));
  for (const std::string& extension : headset.missing) text += "; lacks " + extension;
  return text;
}

}  // namespace afm::app
