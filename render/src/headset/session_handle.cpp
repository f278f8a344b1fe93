// SPDX-License-Identifier: Apache-2.0
#include "headset/session_handle.h"

namespace afm::render {

SessionHandle::SessionHandle(const HeadsetRuntimeParts& runtime, const Device& device) : calls_(runtime.calls) {
  const XrGraphicsBindingVulkan2KHR binding{.type = XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR,
                                            .next = nullptr,
                                            .instance = *device.instance(),
                                            .physicalDevice = *device.physical(),
                                            .device = **device,
                                            .queueFamilyIndex = device.queue_family(),
                                            .queueIndex = 0};
  const XrSessionCreateInfo info{
      .type = XR_TYPE_SESSION_CREATE_INFO, .next = &binding, .createFlags = 0, .systemId = runtime.system};
  check_openxr(calls_.CreateSession(calls_.handle(), &info, &session_), "xrCreateSession");
}

std::vector<std::int64_t> SessionHandle::formats() const {
  return openxr_list<std::int64_t>("xrEnumerateSwapchainFormats", 0,
                                   [&](auto... more) { return calls_.EnumerateSwapchainFormats(session_, more...); });
}

}  // namespace afm::render
