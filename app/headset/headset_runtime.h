// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/result.h"
#include "render/headset.h"

namespace afm::app {

// The manifest of the runtime that OpenXR's loader takes; empty if there is none.
std::string headset_manifest();

// Connects to that runtime. Its loader says on stderr nothing more than the error does, unless XR_LOADER_DEBUG asks for
// it: so before any other thread is started.
core::Result<std::unique_ptr<render::HeadsetRuntime>> connect_headset();

// What it says of itself, and the same in words: "Index through SteamVR 1.2.3, head-mounted display, ...".
core::Result<render::HeadsetDescription> find_headset();
std::string text_of(const render::HeadsetDescription& headset);

}  // namespace afm::app
