// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/result.h"
#include "render/headset.h"

namespace afm::app {

// Path of the manifest that OpenXR's loader uses; empty if there is none.
std::string headset_manifest();

// Connects to the runtime. The loader prints nothing to stderr in addition to the error, unless XR_LOADER_DEBUG is set.
// Changes the environment, so call it before starting any other thread.
core::Result<std::unique_ptr<render::HeadsetRuntime>> connect_headset();

// Description by the runtime, and the same as text: "Index through SteamVR 1.2.3, head-mounted display, ...".
core::Result<render::HeadsetDescription> find_headset();
std::string text_of(const render::HeadsetDescription& headset);

}  // namespace afm::app
