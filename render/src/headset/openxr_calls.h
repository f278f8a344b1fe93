// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/result.h"
#include "headset/openxr.h"

namespace afm::render {

#define AFM_OPENXR_CALLS(CALL)            \
  CALL(AcquireSwapchainImage)             \
  CALL(ApplyHapticFeedback)               \
  CALL(AttachSessionActionSets)           \
  CALL(BeginFrame)                        \
  CALL(BeginSession)                      \
  CALL(CreateAction)                      \
  CALL(CreateActionSet)                   \
  CALL(CreateActionSpace)                 \
  CALL(CreateReferenceSpace)              \
  CALL(CreateSession)                     \
  CALL(CreateSwapchain)                   \
  CALL(CreateVulkanDeviceKHR)             \
  CALL(CreateVulkanInstanceKHR)           \
  CALL(DestroyInstance)                   \
  CALL(DestroySession)                    \
  CALL(DestroySpace)                      \
  CALL(DestroySwapchain)                  \
  CALL(EndFrame)                          \
  CALL(EndSession)                        \
  CALL(EnumerateReferenceSpaces)          \
  CALL(EnumerateSwapchainFormats)         \
  CALL(EnumerateSwapchainImages)          \
  CALL(EnumerateViewConfigurationViews)   \
  CALL(GetActionStateBoolean)             \
  CALL(GetActionStatePose)                \
  CALL(GetActionStateVector2f)            \
  CALL(GetInstanceProperties)             \
  CALL(GetSystem)                         \
  CALL(GetSystemProperties)               \
  CALL(GetVulkanGraphicsDevice2KHR)       \
  CALL(GetVulkanGraphicsRequirements2KHR) \
  CALL(LocateSpace)                       \
  CALL(LocateViews)                       \
  CALL(PollEvent)                         \
  CALL(ReleaseSwapchainImage)             \
  CALL(StringToPath)                      \
  CALL(SuggestInteractionProfileBindings) \
  CALL(SyncActions)                       \
  CALL(WaitFrame)                         \
  CALL(WaitSwapchainImage)

// Failed call of the runtime.
class OpenXrFailure : public std::runtime_error {
 public:
  OpenXrFailure(XrResult the_result, const char* call);
  XrResult result;
};

// True if the session or the runtime is lost.
bool is_loss(const OpenXrFailure& failure);

// Throws OpenXrFailure for an error.
void check_openxr(XrResult result, const char* call);

// Name of a result, such as "XR_ERROR_RUNTIME_UNAVAILABLE".
std::string name_of(XrResult result);

// OpenXR structure with only its type set.
template <class Struct>
Struct openxr_struct(XrStructureType type) {
  Struct made{};
  made.type = type;
  return made;
}

inline constexpr std::uint32_t kMostOpenXrItems = 10'000;  // limit on the length of a runtime's list

// Calls `ask(capacity, count, list)` twice: for the length of a list, then for its items.
template <class Item, class Ask>
std::vector<Item> openxr_list(const char* call, const Item& empty, Ask&& ask) {
  std::uint32_t count = 0;
  check_openxr(ask(0U, &count, static_cast<Item*>(nullptr)), call);
  if (count > kMostOpenXrItems) throw OpenXrFailure(XR_ERROR_RUNTIME_FAILURE, call);
  std::vector<Item> items(count, empty);
  check_openxr(ask(count, &count, items.data()), call);
  items.resize(std::min<std::size_t>(count, items.size()));
  return items;
}

// Functions of one runtime instance. Destroying this destroys the instance and everything created from it.
class OpenXrInstance {
 public:
  OpenXrInstance() = default;
  OpenXrInstance(const OpenXrInstance&) = delete;
  OpenXrInstance& operator=(const OpenXrInstance&) = delete;
  ~OpenXrInstance() { close(); }

  // DeviceMissing, without advice: no loader, or a runtime that does not respond. Extensions that the runtime lacks are
  // removed from `optional`; a missing one of `required` is named in the message.
  core::Result<void> open(const std::vector<const char*>& required, std::vector<const char*>& optional);
  void close();

  explicit operator bool() const { return instance_ != XR_NULL_HANDLE; }
  XrInstance handle() const { return instance_; }
  XrPath path(const char* text) const;

  // Function of an optional extension; null if the instance lacks it.
  template <class Function>
  Function find(const char* name) const {
    PFN_xrVoidFunction found = nullptr;
    return XR_FAILED(get_(instance_, name, &found)) ? nullptr : reinterpret_cast<Function>(found);
  }

#define AFM_OPENXR_MEMBER(name) PFN_xr##name name = nullptr;
  AFM_OPENXR_CALLS(AFM_OPENXR_MEMBER)
#undef AFM_OPENXR_MEMBER

 private:
  PFN_xrGetInstanceProcAddr get_ = nullptr;
  XrInstance instance_ = XR_NULL_HANDLE;
};

}  // namespace afm::render
