// SPDX-License-Identifier: Apache-2.0
// Sessions, spaces, swapchains and frames.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>
#include <thread>

#include "stand_in.h"

namespace afm::stand_in {
namespace {

struct Space {
  float up_m = 0;      // height of its origin above that of its frame
  bool local = false;  // true: frame at eye level, which moves when the headset is recentred
  int hand = -1;       // hand of this aim; -1: none

  float height_m() const { return up_m + (local ? stand_in().script.local_height_m : 0.0F); }
};

struct Session {
  std::vector<Swapchain*> chains;
  std::vector<std::unique_ptr<Space>> spaces;
};
std::unique_ptr<Session>& session() {
  static std::unique_ptr<Session> the_one;
  return the_one;
}

const XrSession kSession = reinterpret_cast<XrSession>(std::uintptr_t{1});

XrResult fault(XrResult result, std::string what) {
  stand_in().log.faults.push_back(std::move(what));
  return result;
}

#define AFM_ENTER_FRAME(call)           \
  StandIn& s = stand_in();              \
  const std::scoped_lock lock(s.mutex); \
  XrResult failed = XR_SUCCESS;         \
  if (!enter(call, failed)) return failed

XrResult XRAPI_CALL create_session(XrInstance, const XrSessionCreateInfo* info, XrSession* made) {
  AFM_ENTER_FRAME("xrCreateSession");
  const auto* binding = static_cast<const XrGraphicsBindingVulkan2KHR*>(info->next);
  s.instance = binding->instance;
  s.physical = binding->physicalDevice;
  s.device = binding->device;
  s.family = binding->queueFamilyIndex;
  vkGetDeviceQueue(s.device, binding->queueFamilyIndex, binding->queueIndex, &s.queue);
  session() = std::make_unique<Session>();
  s.waited = s.begun = 0;
  s.say(XR_SESSION_STATE_IDLE);
  s.say(XR_SESSION_STATE_READY);
  *made = kSession;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_session(XrSession) {
  AFM_ENTER_FRAME("xrDestroySession");
  vkQueueWaitIdle(s.queue);
  for (Swapchain* chain : session()->chains) destroy_images(chain);
  session().reset();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL begin_session(XrSession, const XrSessionBeginInfo*) {
  AFM_ENTER_FRAME("xrBeginSession");
  if (s.running) return fault(XR_ERROR_SESSION_RUNNING, "begun twice");
  if (s.state != XR_SESSION_STATE_READY) return fault(XR_ERROR_SESSION_NOT_READY, "begun before READY");
  s.running = true;
  s.say(XR_SESSION_STATE_SYNCHRONIZED);
  s.say(XR_SESSION_STATE_VISIBLE);
  s.say(XR_SESSION_STATE_FOCUSED);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL end_session(XrSession) {
  AFM_ENTER_FRAME("xrEndSession");
  if (s.state != XR_SESSION_STATE_STOPPING) return fault(XR_ERROR_SESSION_NOT_STOPPING, "ended before STOPPING");
  if (s.begun != s.waited) fault(XR_SUCCESS, "ended within a frame");
  s.running = false;
  s.states.push_front(XR_SESSION_STATE_IDLE);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL poll_event(XrInstance, XrEventDataBuffer* event) {
  StandIn& s = stand_in();
  const std::scoped_lock lock(s.mutex);
  follow_script_file();
  XrResult failed = XR_SUCCESS;
  if (s.script.failing.count("xrPollEvent") > 0 && !enter("xrPollEvent", failed)) return failed;
  if (s.recentered) {
    s.recentered = false;
    event->type = XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING;
    return XR_SUCCESS;
  }
  if (s.states.empty()) return XR_EVENT_UNAVAILABLE;
  s.state = s.states.front();
  s.states.pop_front();
  auto& changed = reinterpret_cast<XrEventDataSessionStateChanged&>(*event);
  changed.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
  changed.session = kSession;
  changed.state = s.state;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerate_spaces(XrSession, std::uint32_t capacity, std::uint32_t* count,
                                     XrReferenceSpaceType* list) {
  const std::scoped_lock lock(stand_in().mutex);
  std::vector<XrReferenceSpaceType> types{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
  if (stand_in().script.stage) types.push_back(XR_REFERENCE_SPACE_TYPE_STAGE);
  if (stand_in().script.local_floor) types.push_back(static_cast<XrReferenceSpaceType>(1000426000));
  *count = static_cast<std::uint32_t>(types.size());
  for (std::size_t i = 0; i < types.size() && i < capacity; ++i) list[i] = types[i];
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_space(XrSession, const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
  AFM_ENTER_FRAME("xrCreateReferenceSpace");
  session()->spaces.push_back(
      std::make_unique<Space>(Space{.up_m = info->poseInReferenceSpace.position.y,
                                    .local = info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_LOCAL}));
  *space = reinterpret_cast<XrSpace>(session()->spaces.back().get());
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_aim(XrSession, const XrActionSpaceCreateInfo* info, XrSpace* space) {
  AFM_ENTER_FRAME("xrCreateActionSpace");
  session()->spaces.push_back(std::make_unique<Space>(Space{.hand = info->subactionPath == 1 ? 0 : 1}));
  *space = reinterpret_cast<XrSpace>(session()->spaces.back().get());
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_space(XrSpace) { return XR_SUCCESS; }

XrResult XRAPI_CALL locate_space(XrSpace space, XrSpace base, XrTime, XrSpaceLocation* location) {
  AFM_ENTER_FRAME("xrLocateSpace");
  const auto& of = *reinterpret_cast<const Space*>(space);
  const auto& in = *reinterpret_cast<const Space*>(base);
  location->locationFlags = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  location->pose = {{0, 0, 0, 1}, {0, of.height_m(), 0}};
  if (of.hand >= 0) location->pose = s.script.aims[static_cast<std::size_t>(of.hand)];
  location->pose.position.y -= in.height_m();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerate_formats(XrSession, std::uint32_t capacity, std::uint32_t* count, std::int64_t* list) {
  const std::scoped_lock lock(stand_in().mutex);
  const auto& formats = stand_in().script.formats;
  *count = static_cast<std::uint32_t>(formats.size());
  for (std::size_t i = 0; i < formats.size() && i < capacity; ++i) list[i] = formats[i];
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_swapchain(XrSession, const XrSwapchainCreateInfo* info, XrSwapchain* made) {
  AFM_ENTER_FRAME("xrCreateSwapchain");
  if (info->arraySize > 1 && !s.script.two_layers) return XR_ERROR_FEATURE_UNSUPPORTED;
  if (info->sampleCount != 1) return fault(XR_ERROR_VALIDATION_FAILURE, "more than one sample");
  const auto& formats = s.script.formats;
  if (std::find(formats.begin(), formats.end(), info->format) == formats.end()) {
    return fault(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "a format that was not offered");
  }
  Swapchain* chain = create_images(*info, s.script.images);
  session()->chains.push_back(chain);
  *made = reinterpret_cast<XrSwapchain>(chain);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_swapchain(XrSwapchain handle) {
  AFM_ENTER_FRAME("xrDestroySwapchain");
  auto* chain = reinterpret_cast<Swapchain*>(handle);
  std::erase(session()->chains, chain);
  destroy_images(chain);  // validation reports any command that still writes to them
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerate_images(XrSwapchain handle, std::uint32_t capacity, std::uint32_t* count,
                                     XrSwapchainImageBaseHeader* list) {
  const auto& images = reinterpret_cast<const Swapchain*>(handle)->images;
  *count = static_cast<std::uint32_t>(images.size());
  auto* vulkan = reinterpret_cast<XrSwapchainImageVulkan2KHR*>(list);
  for (std::size_t i = 0; i < images.size() && i < capacity; ++i) vulkan[i].image = images[i];
  return XR_SUCCESS;
}

XrResult XRAPI_CALL acquire(XrSwapchain handle, const XrSwapchainImageAcquireInfo*, std::uint32_t* index) {
  AFM_ENTER_FRAME("xrAcquireSwapchainImage");
  auto& chain = *reinterpret_cast<Swapchain*>(handle);
  if (chain.acquired != 0) return fault(XR_ERROR_CALL_ORDER_INVALID, "acquired twice");
  chain.acquired = 1;
  *index = chain.next;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL wait_image(XrSwapchain handle, const XrSwapchainImageWaitInfo*) {
  AFM_ENTER_FRAME("xrWaitSwapchainImage");
  auto& chain = *reinterpret_cast<Swapchain*>(handle);
  if (chain.acquired != 1) return fault(XR_ERROR_CALL_ORDER_INVALID, "waited for an image that was not acquired");
  if (!s.script.lends) {
    note("kept");
    return XR_TIMEOUT_EXPIRED;
  }
  chain.acquired = 2;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL release(XrSwapchain handle, const XrSwapchainImageReleaseInfo*) {
  AFM_ENTER_FRAME("xrReleaseSwapchainImage");
  auto& chain = *reinterpret_cast<Swapchain*>(handle);
  if (chain.acquired != 2) return fault(XR_ERROR_CALL_ORDER_INVALID, "released an image that was not waited for");
  chain.acquired = 0;
  chain.filled = true;
  chain.next = (chain.next + 1) % static_cast<std::uint32_t>(chain.images.size());
  return XR_SUCCESS;
}

// The mutex must not be locked while the program waits here.
XrResult XRAPI_CALL wait_frame(XrSession, const XrFrameWaitInfo*, XrFrameState* frame) {
  StandIn& s = stand_in();
  std::unique_lock lock(s.mutex);
  XrResult failed = XR_SUCCESS;
  if (!enter("xrWaitFrame", failed)) return failed;
  if (!s.running) return fault(XR_ERROR_SESSION_NOT_RUNNING, "waited for a frame of a session that does not run");
  const std::int64_t until_ns = now_ns() + s.script.frame_ns;
  while (s.script.blocked || now_ns() < until_ns) {
    if (s.script.blocked) note("blocked");
    lock.unlock();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.lock();
    follow_script_file();
  }
  if (s.waited != s.begun) return fault(XR_ERROR_CALL_ORDER_INVALID, "waited twice for a frame");
  ++s.waited;
  frame->predictedDisplayTime = now_ns() + 16'000'000;
  frame->predictedDisplayPeriod = 11'111'111;
  frame->shouldRender = s.script.should_render ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL begin_frame(XrSession, const XrFrameBeginInfo*) {
  AFM_ENTER_FRAME("xrBeginFrame");
  if (s.begun + 1 != s.waited) return fault(XR_ERROR_CALL_ORDER_INVALID, "begun a frame that was not waited for");
  ++s.begun;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locate_views(XrSession, const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                                 std::uint32_t* count, XrView* views) {
  AFM_ENTER_FRAME("xrLocateViews");
  *count = 2;
  state->viewStateFlags =
      s.script.tracked ? XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT : XrViewStateFlags{0};
  for (std::size_t i = 0; i < capacity; ++i) {
    views[i].pose = s.script.eyes[i];
    views[i].pose.position.y -= reinterpret_cast<const Space*>(info->space)->height_m();
    views[i].fov = s.script.fovs[i];
  }
  return XR_SUCCESS;
}

SubmittedImage read(const XrSwapchainSubImage& of) {
  const auto& chain = *reinterpret_cast<const Swapchain*>(of.swapchain);
  if (!chain.filled) fault(XR_ERROR_LAYER_INVALID, "submitted an image that was never filled");
  return read_image(chain, of.imageArrayIndex, of.imageRect);
}

SubmittedEye read(const XrCompositionLayerProjectionView& shown) {
  SubmittedEye eye;
  static_cast<SubmittedImage&>(eye) = read(shown.subImage);
  eye.pose = shown.pose;
  eye.fov = shown.fov;
  if (shown.next == nullptr) return eye;
  const auto& depth = *static_cast<const XrCompositionLayerDepthInfoKHR*>(shown.next);
  const bool right = depth.type == XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR && depth.minDepth == 0.0F &&
                     depth.maxDepth == 1.0F && depth.nearZ > 0.0F && depth.farZ > 0.0F && depth.nearZ != depth.farZ;
  if (!right) fault(XR_ERROR_VALIDATION_FAILURE, "depth that means nothing");
  const SubmittedImage read_depth = read(depth.subImage);
  if (read_depth.format != VK_FORMAT_D32_SFLOAT) fault(XR_ERROR_VALIDATION_FAILURE, "depth in a format of colour");
  eye.near_m = depth.nearZ;
  eye.far_m = depth.farZ;
  eye.depths.resize(read_depth.bytes.size() / sizeof(float));
  std::memcpy(eye.depths.data(), read_depth.bytes.data(), read_depth.bytes.size());
  return eye;
}

SubmittedQuad read(const XrCompositionLayerQuad& shown) {
  SubmittedQuad quad;
  static_cast<SubmittedImage&>(quad) = read(shown.subImage);
  quad.pose = shown.pose;
  quad.pose.position.y += reinterpret_cast<const Space*>(shown.space)->height_m();
  quad.size = shown.size;
  quad.flags = shown.layerFlags;
  return quad;
}

XrResult XRAPI_CALL end_frame(XrSession, const XrFrameEndInfo* info) {
  AFM_ENTER_FRAME("xrEndFrame");
  if (s.begun != s.waited) return fault(XR_ERROR_CALL_ORDER_INVALID, "ended a frame that was not begun");
  if (info->layerCount > s.script.most_layers) return fault(XR_ERROR_LAYER_LIMIT_EXCEEDED, "too many layers");
  if (!s.keeps_frames) return XR_SUCCESS;
  SubmittedFrame frame;
  for (std::uint32_t i = 0; i < info->layerCount; ++i) {
    if (info->layers[i]->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      if (frame.eyes.empty()) fault(XR_SUCCESS, "a quad below the eyes");
      frame.quads.push_back(read(*reinterpret_cast<const XrCompositionLayerQuad*>(info->layers[i])));
    }
    if (info->layers[i]->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) continue;
    const auto* layer = reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[i]);
    for (std::uint32_t view = 0; view < layer->viewCount; ++view) frame.eyes.push_back(read(layer->views[view]));
  }
  s.log.frames.push_back(std::move(frame));
  return XR_SUCCESS;
}

template <class Function>
PFN_xrVoidFunction plain_call(Function* function) {
  return reinterpret_cast<PFN_xrVoidFunction>(function);
}

}  // namespace

XrResult find_frame_call(const char* name, PFN_xrVoidFunction* function) {
  static const std::map<std::string, PFN_xrVoidFunction> calls{
      {"xrCreateSession", plain_call(create_session)},
      {"xrDestroySession", plain_call(destroy_session)},
      {"xrBeginSession", plain_call(begin_session)},
      {"xrEndSession", plain_call(end_session)},
      {"xrPollEvent", plain_call(poll_event)},
      {"xrEnumerateReferenceSpaces", plain_call(enumerate_spaces)},
      {"xrCreateReferenceSpace", plain_call(create_space)},
      {"xrCreateActionSpace", plain_call(create_aim)},
      {"xrDestroySpace", plain_call(destroy_space)},
      {"xrLocateSpace", plain_call(locate_space)},
      {"xrEnumerateSwapchainFormats", plain_call(enumerate_formats)},
      {"xrCreateSwapchain", plain_call(create_swapchain)},
      {"xrDestroySwapchain", plain_call(destroy_swapchain)},
      {"xrEnumerateSwapchainImages", plain_call(enumerate_images)},
      {"xrAcquireSwapchainImage", plain_call(acquire)},
      {"xrWaitSwapchainImage", plain_call(wait_image)},
      {"xrReleaseSwapchainImage", plain_call(release)},
      {"xrWaitFrame", plain_call(wait_frame)},
      {"xrBeginFrame", plain_call(begin_frame)},
      {"xrLocateViews", plain_call(locate_views)},
      {"xrEndFrame", plain_call(end_frame)}};
  const auto found = calls.find(name);
  *function = found == calls.end() ? nullptr : found->second;
  return *function == nullptr ? XR_ERROR_FUNCTION_UNSUPPORTED : XR_SUCCESS;
}

}  // namespace afm::stand_in
