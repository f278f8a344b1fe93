// SPDX-License-Identifier: Apache-2.0
#pragma once

// The only place that includes OpenXR. Its loader is opened at run time, so that a machine without it gets a message
// instead of a dynamic linker's error.
#include "device/vulkan.h"
#define XR_NO_PROTOTYPES
#define XR_USE_GRAPHICS_API_VULKAN
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

// missing from the headers of Debian 12 (1.0.20)
#ifndef XR_EXT_LOCAL_FLOOR_EXTENSION_NAME
#define XR_EXT_LOCAL_FLOOR_EXTENSION_NAME "XR_EXT_local_floor"
#define XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT (static_cast<XrReferenceSpaceType>(1000426000))
#endif
