// SPDX-License-Identifier: Apache-2.0
// Instance, system, Vulkan and actions; sessions and frames are in stand_in_frames.cpp.
#include "stand_in.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace afm::stand_in {

StandIn& stand_in() {
  static StandIn the_one;
  return the_one;
}

void StandIn::begin_again() {
  script = {};
  log = {};
  keeps_frames = true;
  states.clear();
}

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1); }

bool enter(const char* call, XrResult& result) {
  StandIn& s = stand_in();
  if (s.log.calls.size() < 100'000) s.log.calls.emplace_back(call);
  const auto failing = s.script.failing.find(call);
  if (failing == s.script.failing.end()) return true;
  result = failing->second;
  s.script.failing.erase(failing);
  note("failed");
  return false;
}

namespace {
std::set<std::string> noted;  // events noted since the last line of the script
}

void note(const std::string& what) {
  const char* path = std::getenv("AFM_STAND_IN");
  if (path == nullptr || !noted.insert(what).second) return;
  std::ofstream(std::string(path) + ".log", std::ios::app) << what << ' ' << now_ns() << std::endl;
}

// Lines of the file that have come since the last look, such as "state 7", "fail xrWaitFrame -13" or "press 1 select".
void follow_script_file() {
  static std::size_t done = 0;
  const char* path = std::getenv("AFM_STAND_IN");
  if (path == nullptr) return;
  StandIn& s = stand_in();
  s.keeps_frames = false;
  s.script.frame_ns = 20'000'000;
  std::ifstream file(path);
  std::string line;
  for (std::size_t i = 0; std::getline(file, line); ++i) {
    if (i < done) continue;
    done = i + 1;
    noted.clear();
    std::istringstream words(line);
    std::string verb, name;
    int number = 0;
    words >> verb;
    if (verb == "state" && words >> number) s.say(static_cast<XrSessionState>(number));
    if (verb == "fail" && words >> name >> number) s.script.failing[name] = static_cast<XrResult>(number);
    if (verb == "press" && words >> number >> name) s.script.pressed[number == 0 ? 0 : 1].insert(name);
    if (verb == "release" && words >> number >> name) s.script.pressed[number == 0 ? 0 : 1].erase(name);
    if (verb == "aim") {
      XrPosef& aim = s.script.aims[1];
      words >> aim.position.x >> aim.position.y >> aim.position.z >> aim.orientation.x >> aim.orientation.y >>
          aim.orientation.z >> aim.orientation.w;
    }
    if (verb == "block") s.script.blocked = true;
    if (verb == "unblock") s.script.blocked = false;
    if (verb == "keep") s.script.lends = false;
    if (verb == "lend") s.script.lends = true;
    if (verb == "hide") s.script.should_render = false;
    if (verb == "unhide") s.script.should_render = true;
    if (verb == "gone") s.script.available = false;
    if (verb == "back") s.script.available = true;
  }
}

namespace {

struct Action {
  std::string name;
};

XrResult begin(const char* call) {
  XrResult result = XR_SUCCESS;
  return enter(call, result) ? XR_SUCCESS : result;
}

#define AFM_ENTER(call)                 \
  StandIn& s = stand_in();              \
  const std::scoped_lock lock(s.mutex); \
  if (const XrResult r = begin(call); r != XR_SUCCESS) return r

std::size_t hand_of(XrPath path) { return path == 1 ? 0 : 1; }

XrResult XRAPI_CALL enumerate_extensions(const char*, std::uint32_t capacity, std::uint32_t* count,
                                         XrExtensionProperties* list) {
  const std::scoped_lock lock(stand_in().mutex);
  std::vector<const char*> names{XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};
  if (stand_in().script.local_floor) names.push_back("XR_EXT_local_floor");
  if (stand_in().script.depth) names.push_back(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
  *count = static_cast<std::uint32_t>(names.size());
  for (std::size_t i = 0; i < names.size() && i < capacity; ++i) {
    std::strncpy(list[i].extensionName, names[i], XR_MAX_EXTENSION_NAME_SIZE - 1);
    list[i].extensionVersion = 1;
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo*, XrInstance* instance) {
  AFM_ENTER("xrCreateInstance");
  follow_script_file();
  if (!s.script.available) return XR_ERROR_RUNTIME_UNAVAILABLE;
  s.states.clear();
  s.state = XR_SESSION_STATE_UNKNOWN;
  s.running = false;
  *instance = reinterpret_cast<XrInstance>(std::uintptr_t{1});
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_instance(XrInstance) {
  AFM_ENTER("xrDestroyInstance");
  return XR_SUCCESS;
}

XrResult XRAPI_CALL instance_properties(XrInstance, XrInstanceProperties* properties) {
  AFM_ENTER("xrGetInstanceProperties");
  properties->runtimeVersion = XR_MAKE_VERSION(1, 2, 3);
  std::strncpy(properties->runtimeName, "stand-in", XR_MAX_RUNTIME_NAME_SIZE - 1);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL get_system(XrInstance, const XrSystemGetInfo*, XrSystemId* system) {
  AFM_ENTER("xrGetSystem");
  *system = 1;
  return s.script.headset_plugged_in ? XR_SUCCESS : XR_ERROR_FORM_FACTOR_UNAVAILABLE;
}

XrResult XRAPI_CALL system_properties(XrInstance, XrSystemId, XrSystemProperties* properties) {
  AFM_ENTER("xrGetSystemProperties");
  s.script.name.copy(properties->systemName, XR_MAX_SYSTEM_NAME_SIZE);
  properties->graphicsProperties.maxLayerCount = s.script.most_layers;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerate_views(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t capacity,
                                    std::uint32_t* count, XrViewConfigurationView* views) {
  const std::scoped_lock lock(stand_in().mutex);
  const Script& script = stand_in().script;
  *count = 2;
  for (std::uint32_t i = 0; i < capacity; ++i) {
    views[i].recommendedImageRectWidth = views[i].maxImageRectWidth = script.eye_width;
    views[i].recommendedImageRectHeight = views[i].maxImageRectHeight = script.eye_height;
    views[i].recommendedSwapchainSampleCount = views[i].maxSwapchainSampleCount = 4;
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL vulkan_requirements(XrInstance, XrSystemId, XrGraphicsRequirementsVulkan2KHR* required) {
  AFM_ENTER("xrGetVulkanGraphicsRequirements2KHR");
  required->minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
  required->maxApiVersionSupported = XR_MAKE_VERSION(1, 4, 0);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_vulkan_instance(XrInstance, const XrVulkanInstanceCreateInfoKHR* info, VkInstance* instance,
                                           VkResult* result) {
  AFM_ENTER("xrCreateVulkanInstanceKHR");
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(info->pfnGetInstanceProcAddr(nullptr, "vkCreateInstance"));
  *result = create(info->vulkanCreateInfo, info->vulkanAllocator, instance);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL vulkan_device(XrInstance, const XrVulkanGraphicsDeviceGetInfoKHR* info, VkPhysicalDevice* device) {
  AFM_ENTER("xrGetVulkanGraphicsDevice2KHR");
  std::uint32_t count = 1;
  vkEnumeratePhysicalDevices(info->vulkanInstance, &count, device);
  return count == 1 ? XR_SUCCESS : XR_ERROR_RUNTIME_FAILURE;
}

XrResult XRAPI_CALL create_vulkan_device(XrInstance, const XrVulkanDeviceCreateInfoKHR* info, VkDevice* device,
                                         VkResult* result) {
  AFM_ENTER("xrCreateVulkanDeviceKHR");
  *result = vkCreateDevice(info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, device);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL string_to_path(XrInstance, const char* text, XrPath* path) {
  const std::string_view name(text);
  *path = name == "/user/hand/left" ? 1 : name == "/user/hand/right" ? 2 : 3 + std::hash<std::string_view>()(name) / 2;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_action_set(XrInstance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  AFM_ENTER("xrCreateActionSet");
  if (info->localizedActionSetName[0] == '\0') return XR_ERROR_LOCALIZED_NAME_INVALID;
  *set = reinterpret_cast<XrActionSet>(std::uintptr_t{1});
  return XR_SUCCESS;
}

// Actions of several instances in turn: the last ones are kept until the end.
XrResult XRAPI_CALL create_action(XrActionSet, const XrActionCreateInfo* info, XrAction* action) {
  AFM_ENTER("xrCreateAction");
  if (info->localizedActionName[0] == '\0') return XR_ERROR_LOCALIZED_NAME_INVALID;
  static std::deque<Action> actions;
  actions.push_back({info->actionName});
  *action = reinterpret_cast<XrAction>(&actions.back());
  return XR_SUCCESS;
}

XrResult XRAPI_CALL suggest(XrInstance, const XrInteractionProfileSuggestedBinding* binding) {
  AFM_ENTER("xrSuggestInteractionProfileBindings");
  return binding->countSuggestedBindings > 0 ? XR_SUCCESS : XR_ERROR_VALIDATION_FAILURE;
}

XrResult XRAPI_CALL attach(XrSession, const XrSessionActionSetsAttachInfo*) {
  AFM_ENTER("xrAttachSessionActionSets");
  return XR_SUCCESS;
}

XrResult XRAPI_CALL sync_actions(XrSession, const XrActionsSyncInfo*) {
  AFM_ENTER("xrSyncActions");
  return s.state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

XrResult XRAPI_CALL state_boolean(XrSession, const XrActionStateGetInfo* info, XrActionStateBoolean* state) {
  const std::scoped_lock lock(stand_in().mutex);
  const auto& pressed = stand_in().script.pressed[hand_of(info->subactionPath)];
  state->isActive = XR_TRUE;
  state->currentState = pressed.count(reinterpret_cast<const Action*>(info->action)->name) > 0 ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL state_vector(XrSession, const XrActionStateGetInfo*, XrActionStateVector2f* state) {
  const std::scoped_lock lock(stand_in().mutex);
  state->isActive = XR_TRUE;
  state->currentState = stand_in().script.stick;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL state_pose(XrSession, const XrActionStateGetInfo*, XrActionStatePose* state) {
  const std::scoped_lock lock(stand_in().mutex);
  state->isActive = stand_in().script.controllers ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL apply_haptics(XrSession, const XrHapticActionInfo*, const XrHapticBaseHeader*) {
  AFM_ENTER("xrApplyHapticFeedback");
  ++s.log.pulses;
  if (const char* path = std::getenv("AFM_STAND_IN")) {
    std::ofstream(std::string(path) + ".pulses", std::ios::app) << "pulse" << std::endl;
  }
  return XR_SUCCESS;
}

template <class Function>
PFN_xrVoidFunction plain(Function* function) {
  return reinterpret_cast<PFN_xrVoidFunction>(function);
}

XrResult XRAPI_CALL get_proc(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  static const std::map<std::string, PFN_xrVoidFunction> calls{
      {"xrGetInstanceProcAddr", plain(get_proc)},
      {"xrEnumerateInstanceExtensionProperties", plain(enumerate_extensions)},
      {"xrCreateInstance", plain(create_instance)},
      {"xrDestroyInstance", plain(destroy_instance)},
      {"xrGetInstanceProperties", plain(instance_properties)},
      {"xrGetSystem", plain(get_system)},
      {"xrGetSystemProperties", plain(system_properties)},
      {"xrEnumerateViewConfigurationViews", plain(enumerate_views)},
      {"xrGetVulkanGraphicsRequirements2KHR", plain(vulkan_requirements)},
      {"xrCreateVulkanInstanceKHR", plain(create_vulkan_instance)},
      {"xrGetVulkanGraphicsDevice2KHR", plain(vulkan_device)},
      {"xrCreateVulkanDeviceKHR", plain(create_vulkan_device)},
      {"xrStringToPath", plain(string_to_path)},
      {"xrCreateActionSet", plain(create_action_set)},
      {"xrCreateAction", plain(create_action)},
      {"xrSuggestInteractionProfileBindings", plain(suggest)},
      {"xrAttachSessionActionSets", plain(attach)},
      {"xrSyncActions", plain(sync_actions)},
      {"xrGetActionStateBoolean", plain(state_boolean)},
      {"xrGetActionStateVector2f", plain(state_vector)},
      {"xrGetActionStatePose", plain(state_pose)},
      {"xrApplyHapticFeedback", plain(apply_haptics)}};
  const auto found = calls.find(name);
  if (found == calls.end()) return find_frame_call(name, function);
  *function = found->second;
  return XR_SUCCESS;
}

}  // namespace

PFN_xrGetInstanceProcAddr instance_call() { return get_proc; }

// Structure of the loader's interface, missing in Debian 12's headers.
struct LoaderInfo {
  std::uint32_t type, version;
  std::size_t size;
  std::uint32_t least_interface, most_interface;
  XrVersion least_api, most_api;
};
struct RuntimeRequest {
  std::uint32_t type, version;
  std::size_t size;
  std::uint32_t interface_version;
  XrVersion api;
  PFN_xrGetInstanceProcAddr get;
};

}  // namespace afm::stand_in

extern "C" __attribute__((visibility("default"))) XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const afm::stand_in::LoaderInfo* /*loader*/, afm::stand_in::RuntimeRequest* request) {
  request->interface_version = 1;
  request->api = XR_MAKE_VERSION(1, 0, 20);
  request->get = afm::stand_in::instance_call();
  return XR_SUCCESS;
}
