// SPDX-License-Identifier: Apache-2.0
#include "headset/openxr_calls.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace afm::render {
namespace {

constexpr const char* kLoader = "libopenxr_loader.so.1";

// Opens the loader once and never closes it: a runtime's threads may run in it until the process ends.
PFN_xrGetInstanceProcAddr find_openxr_loader() {
  static void* const library = ::dlopen(kLoader, RTLD_NOW | RTLD_LOCAL);
  return library == nullptr ? nullptr
                            : reinterpret_cast<PFN_xrGetInstanceProcAddr>(::dlsym(library, "xrGetInstanceProcAddr"));
}

template <class Function>
Function find_openxr_call(PFN_xrGetInstanceProcAddr get, XrInstance instance, const char* name) {
  PFN_xrVoidFunction found = nullptr;
  check_openxr(get(instance, name, &found), name);
  return reinterpret_cast<Function>(found);
}

bool offers(const std::vector<XrExtensionProperties>& offered, const char* name) {
  return std::any_of(offered.begin(), offered.end(), [&](const XrExtensionProperties& extension) {
    return std::string_view(extension.extensionName) == name;
  });
}

}  // namespace

OpenXrFailure::OpenXrFailure(XrResult the_result, const char* call)
    : std::runtime_error(fmt::format("{}: {}", call, name_of(the_result))), result(the_result) {}

bool is_loss(const OpenXrFailure& failure) {
  return failure.result == XR_ERROR_SESSION_LOST || failure.result == XR_ERROR_INSTANCE_LOST;
}

void check_openxr(XrResult result, const char* call) {
  if (XR_FAILED(result)) throw OpenXrFailure(result, call);
}

std::string name_of(XrResult result) {
#define AFM_OPENXR_RESULT(name, value) \
  if (result == (value)) return #name;
  XR_LIST_ENUM_XrResult(AFM_OPENXR_RESULT)
#undef AFM_OPENXR_RESULT
      return fmt::format("error {}", static_cast<int>(result));
}

core::Result<void> OpenXrInstance::open(const std::vector<const char*>& required, std::vector<const char*>& optional) {
  close();
  const auto get = find_openxr_loader();
  if (get == nullptr) {
    return core::failure(core::ErrorCategory::DeviceMissing, fmt::format("cannot open the OpenXR loader {}", kLoader));
  }
  get_ = get;
  try {
    const auto list = find_openxr_call<PFN_xrEnumerateInstanceExtensionProperties>(
        get, XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties");
    const auto offered = openxr_list<XrExtensionProperties>(
        "xrEnumerateInstanceExtensionProperties", openxr_struct<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES),
        [&](auto... more) { return list(nullptr, more...); });
    for (const char* name : required) {
      if (offers(offered, name)) continue;
      return core::failure(core::ErrorCategory::DeviceMissing, fmt::format("the OpenXR runtime lacks {}", name));
    }
    std::erase_if(optional, [&](const char* name) { return !offers(offered, name); });
    std::vector<const char*> enabled = required;
    enabled.insert(enabled.end(), optional.begin(), optional.end());
    auto info = openxr_struct<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
    std::strncpy(info.applicationInfo.applicationName, "touchafm", XR_MAX_APPLICATION_NAME_SIZE - 1);
    // a 1.0 runtime rejects the version 1.1 of newer headers
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    info.enabledExtensionCount = static_cast<std::uint32_t>(enabled.size());
    info.enabledExtensionNames = enabled.data();
    const auto create = find_openxr_call<PFN_xrCreateInstance>(get, XR_NULL_HANDLE, "xrCreateInstance");
    check_openxr(create(&info, &instance_), "xrCreateInstance");
#define AFM_OPENXR_FIND(name) name = find_openxr_call<PFN_xr##name>(get, instance_, "xr" #name);
    AFM_OPENXR_CALLS(AFM_OPENXR_FIND)
#undef AFM_OPENXR_FIND
  } catch (const OpenXrFailure& failure) {
    close();
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("the OpenXR runtime does not answer ({})", failure.what()));
  }
  return {};
}

void OpenXrInstance::close() {
  if (instance_ != XR_NULL_HANDLE && DestroyInstance != nullptr) DestroyInstance(instance_);
  instance_ = XR_NULL_HANDLE;
}

XrPath OpenXrInstance::path(const char* text) const {
  XrPath path = XR_NULL_PATH;
  check_openxr(StringToPath(instance_, text, &path), "xrStringToPath");
  return path;
}

}  // namespace afm::render
