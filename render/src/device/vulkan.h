// SPDX-License-Identifier: Apache-2.0
#pragma once

// The only place that includes Vulkan-Hpp; precompiled. The loader is opened at run time, so that a machine without it
// gets a message instead of a dynamic linker's error.
#define VK_NO_PROTOTYPES
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>
