// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>
#define XR_NO_PROTOTYPES
#define XR_USE_GRAPHICS_API_VULKAN
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

// The stand-in runtime: its abilities, its script, and a log of what it received. All poses are in the floor's frame,
// with -z ahead.
namespace afm::stand_in {

// Contents of a swapchain's image when it was submitted: four bytes per pixel.
struct SubmittedImage {
  std::int64_t format = 0;
  std::uint32_t width = 0, height = 0, layer = 0;
  std::vector<std::uint8_t> bytes;
};
struct SubmittedEye : SubmittedImage {
  XrPosef pose{};
  XrFovf fov{};
  float near_m = 0, far_m = 0;  // distances at depths 0 and 1
  std::vector<float> depths;    // one per pixel; empty if no depth was submitted
};
struct SubmittedQuad : SubmittedImage {
  XrPosef pose{};
  XrExtent2Df size{};
  XrCompositionLayerFlags flags = 0;
};
struct SubmittedFrame {
  std::vector<SubmittedEye> eyes;    // empty for a frame without a layer
  std::vector<SubmittedQuad> quads;  // quads in order, over the eyes
};

struct Script {
  std::string name = "headset without lenses";
  std::vector<std::int64_t> formats{91, 97, 43, 50, 37, 44, 126};
  std::uint32_t images = 3;
  std::uint32_t eye_width = 256, eye_height = 192;
  bool two_layers = true;
  bool depth = true;  // true: offers XR_KHR_composition_layer_depth
  std::uint32_t most_layers = 16;
  bool local_floor = true, stage = true;
  float local_height_m = 1.5F;  // height of the eye-level frame above the floor
  std::array<XrPosef, 2> eyes{{{{0, 0, 0, 1}, {-0.032F, 1.6F, 0.0F}}, {{0, 0, 0, 1}, {0.032F, 1.6F, 0.0F}}}};
  std::array<XrFovf, 2> fovs{{{-0.8F, 0.7F, 0.75F, -0.85F}, {-0.7F, 0.8F, 0.75F, -0.85F}}};
  bool tracked = true;
  bool should_render = true;
  bool available = true;                         // result of xrCreateInstance
  bool headset_plugged_in = true;                // result of xrGetSystem
  std::int64_t frame_ns = 0;                     // shortest duration of xrWaitFrame
  bool blocked = false;                          // true: xrWaitFrame does not return
  bool lends = true;                             // true: images available
  std::map<std::string, XrResult> failing;       // results of failing calls, once each
  std::array<std::set<std::string>, 2> pressed;  // pressed actions, by hand
  std::array<XrPosef, 2> aims{{{{0, 0, 0, 1}, {-0.2F, 1.2F, -0.3F}}, {{0, 0, 0, 1}, {0.2F, 1.2F, -0.3F}}}};
  XrVector2f stick{0, 0};
  bool controllers = true;
};

// Log of the program's calls.
struct Log {
  std::vector<std::string> calls;   // all calls except xrPollEvent and xrGetActionState...
  std::vector<std::string> faults;  // violations of the specification
  std::vector<SubmittedFrame> frames;
  int pulses = 0;
};

// State shared by the calls; a test holds the mutex while it reads or changes anything.
struct StandIn {
  std::mutex mutex;
  Script script;
  Log log;
  bool keeps_frames = true;  // true: stores frames with their pictures

  // Queues the runtime's next state; the program gets one per request.
  void say(XrSessionState next) { states.push_back(next); }
  void begin_again();  // restores the initial state

  // state of the calls
  std::deque<XrSessionState> states;
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  bool running = false;
  int waited = 0, begun = 0;  // numbers of frames waited for, and begun
  bool recentered = false;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t family = 0;
};
StandIn& stand_in();

// Swapchain, shared by the sources of the runtime.
struct Swapchain {
  XrSwapchainCreateInfo info{};
  std::vector<VkImage> images;
  std::vector<VkDeviceMemory> memory;
  std::uint32_t next = 0;
  int acquired = 0;  // 1: acquired; 2: also waited for
  bool filled = false;

  bool has_depth() const { return info.format == VK_FORMAT_D32_SFLOAT; }
};
Swapchain* create_images(const XrSwapchainCreateInfo& info, std::uint32_t count);
void destroy_images(Swapchain* chain);
SubmittedImage read_image(const Swapchain& chain, std::uint32_t layer, const XrRect2Di& rect);
std::int64_t now_ns();
bool enter(const char* call, XrResult& result);  // logs the call; false: it must fail, according to the script
void follow_script_file();
void note(
    const std::string& what);  // event whose first time after a line of the script goes to the neighbouring file ".log"

XrResult find_frame_call(const char* name, PFN_xrVoidFunction* function);

}  // namespace afm::stand_in
