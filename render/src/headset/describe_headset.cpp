// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "headset/session_handle.h"

namespace afm::render {
namespace {

std::optional<double> refresh_hz_of(const OpenXrInstance& calls, XrSession session) {
  const auto ask = calls.find<PFN_xrGetDisplayRefreshRateFB>("xrGetDisplayRefreshRateFB");
  float hz = 0;
  if (ask == nullptr || XR_FAILED(ask(session, &hz)) || !(hz > 0.0F)) return std::nullopt;
  return static_cast<double>(hz);
}

}  // namespace

core::Result<HeadsetDescription> describe_headset(std::string manifest) {
  auto runtime = HeadsetRuntime::connect(std::move(manifest));
  if (!runtime) return tl::unexpected(runtime.error());
  auto context = Context::open({.runtime = runtime->get()});
  if (!context) return tl::unexpected(context.error());
  const HeadsetRuntimeParts& parts = (*runtime)->parts();
  HeadsetDescription description;
  description.runtime = parts.runtime_name;
  description.headset = parts.headset_name;
  description.eye_px = parts.eye_px;
  for (const HeadsetExtension& row : headset_extensions()) {
    if (!parts.has(row.name)) description.missing.push_back(fmt::format("{}: {}", row.name, row.without));
  }
  try {
    const SessionHandle session(parts, context->device());
    if (parts.has(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME)) {
      description.refresh_hz = refresh_hz_of(parts.calls, session);
    }
    for (const std::int64_t format : session.formats()) {
      description.formats.push_back(vk::to_string(static_cast<vk::Format>(format)));
    }
  } catch (const OpenXrFailure& failure) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("no headset: {} gives no session ({}): restart it", parts.runtime_name, failure.what()));
  }
  return description;
}

}  // namespace afm::render
