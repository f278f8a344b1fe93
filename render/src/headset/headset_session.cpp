// SPDX-License-Identifier: Apache-2.0
#include "headset/headset_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/interruption.h"
#include "device/device.h"
#include "headset/openxr_pose.h"

namespace afm::render {
namespace {

constexpr std::chrono::milliseconds kTurnOfFrameWait{5};
constexpr std::chrono::seconds kLastWait{2};  // time allowed at exit for a runtime that holds back a frame
constexpr std::int64_t kLongFrozenNs = 10'000'000'000;
constexpr int kMostEventsATurn = 100;
constexpr double kUnusedFarM = 100.0;  // far plane reported for a projection without one

struct StateRow {
  XrSessionState state;
  SessionEvent event;
  const char* messages;  // log text of the state; null: none worth printing
};
constexpr std::array<StateRow, 8> kStates{
    {{XR_SESSION_STATE_IDLE, SessionEvent::BecameIdle, "headset: not worn"},
     {XR_SESSION_STATE_READY, SessionEvent::BecameReady, nullptr},
     {XR_SESSION_STATE_SYNCHRONIZED, SessionEvent::BecameSynchronized, nullptr},
     {XR_SESSION_STATE_VISIBLE, SessionEvent::BecameVisible, "headset: shows the picture"},
     {XR_SESSION_STATE_FOCUSED, SessionEvent::BecameFocused, "headset: has the controllers"},
     {XR_SESSION_STATE_STOPPING, SessionEvent::BecameStopping, nullptr},
     {XR_SESSION_STATE_LOSS_PENDING, SessionEvent::BecameLossPending, "headset: the runtime is about to end"},
     {XR_SESSION_STATE_EXITING, SessionEvent::BecameExiting, "headset: its user has closed the session"}}};

}  // namespace

HeadsetSession::HeadsetSession(HeadsetRuntimeParts& runtime, const Device& device, const EyeTargets& eyes,
                               const Panels& panels, const scene::HeadPose& room_from_floor,
                               std::vector<std::string>& messages)
    : calls_(runtime.calls),
      device_(device),
      eyes_(eyes),
      panels_(panels),
      room_from_floor_(room_from_floor),
      messages_(messages),
      session_(runtime, device),
      floor_(calls_, session_, runtime.has(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME)),
      actions_(calls_, session_),
      pictures_(calls_, session_, device, choose_format(), eyes.extent(), takes_depth(runtime)),
      quads_(calls_, session_, session_.formats(), runtime.most_layers),
      pool_(*device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                               .queueFamilyIndex = device.queue_family()}) {
  for (Copying& copying : copying_) {
    copying.commands = std::move(
        vk::raii::CommandBuffers(
            *device, {.commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1})
            .front());
    copying.done = vk::raii::Fence(*device, vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled});
  }
  wait_.emplace(calls_.WaitFrame, session_);
}

HeadsetSession::~HeadsetSession() {
  if (wait_->under_way() && !wait_->answer_within(kLastWait)) {
    core::end_at_once(core::ExitCode::RunFailed,
                      "error: the headset's runtime keeps a frame that the program waits for: restart the runtime");
  }
  // pending commands may still fill the runtime's images
  device_.wait_idle();
}

HeadsetFormat HeadsetSession::choose_format() const {
  const auto format = choose_headset_format(session_.formats());
  if (!format) throw OpenXrFailure(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "xrEnumerateSwapchainFormats");
  return *format;
}

EyeSwapchains::Depth HeadsetSession::takes_depth(const HeadsetRuntimeParts& runtime) const {
  const auto formats = session_.formats();
  const bool fits = std::find(formats.begin(), formats.end(), static_cast<std::int64_t>(kDepthFormat)) != formats.end();
  return fits && runtime.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) ? EyeSwapchains::Depth::Shown
                                                                            : EyeSwapchains::Depth::None;
}

void HeadsetSession::follow_events() {
  for (int i = 0; i < kMostEventsATurn; ++i) {
    auto event = openxr_struct<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    const XrResult polled = calls_.PollEvent(calls_.handle(), &event);
    check_openxr(polled, "xrPollEvent");
    if (polled == XR_EVENT_UNAVAILABLE) return;
    take(event);
  }
}

void HeadsetSession::take(const XrEventDataBuffer& event) {
  switch (event.type) {
    case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED:
      return follow_state(reinterpret_cast<const XrEventDataSessionStateChanged&>(event).state);
    case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
      messages_.emplace_back("headset: the runtime is about to end");
      states_.take(SessionEvent::WasLost);
      return;
    case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING:
      floor_.recentered();
      return;
    default:
      return;
  }
}

void HeadsetSession::follow_state(XrSessionState state) {
  for (const StateRow& row : kStates) {
    if (row.state != state) continue;
    if (row.messages != nullptr) messages_.emplace_back(row.messages);
    const SessionDuty duty = states_.take(row.event);
    if (duty == SessionDuty::Begin) begin_session();
    ending_ = ending_ || duty == SessionDuty::End;
  }
}

void HeadsetSession::begin_session() {
  // a frame may still be waited for
  if (ending_ && !wait_->under_way()) end_session();
  const XrSessionBeginInfo info{.type = XR_TYPE_SESSION_BEGIN_INFO,
                                .next = nullptr,
                                .primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
  check_openxr(calls_.BeginSession(session_, &info), "xrBeginSession");
}

void HeadsetSession::end_session() {
  ending_ = false;
  check_openxr(calls_.EndSession(session_), "xrEndSession");
}

std::optional<FrameWait::Answer> HeadsetSession::wait_for_frame(const core::Clock& clock,
                                                                const std::function<void()>& while_waiting) {
  while (true) {
    if (auto answer = wait_->answer_within(kTurnOfFrameWait)) return answer;
    if (clock.now_ns() - wait_began_ns_ >= Headset::kFrozenNs) return std::nullopt;
    while_waiting();
  }
}

Headset::Turn HeadsetSession::next_turn(const core::Clock& clock, const std::function<void()>& while_waiting) {
  const auto gone = [this] { return states_.phase() == SessionPhase::Over; };
  if (gone()) frame_.reset();
  if (frame_) end_frame(Picture::None);
  if (!gone()) follow_events();
  const bool wanted = states_.phase() == SessionPhase::Running || ending_;
  if (!wanted && !wait_->under_way()) return Headset::Turn::Off;
  if (!wait_->under_way()) {
    if (ending_) {
      end_session();
      return Headset::Turn::Off;
    }
    wait_->begin();
    wait_began_ns_ = clock.now_ns();
  }
  const auto answer = wait_for_frame(clock, while_waiting);
  if (!answer) {
    say_frozen(clock.now_ns() - wait_began_ns_);
    return Headset::Turn::Frozen;
  }
  said_frozen_ = false;
  if (gone()) return Headset::Turn::Off;
  begin_frame(*answer);
  const bool seen = states_.visible() && answer->frame.shouldRender == XR_TRUE;
  if (!ending_)
    controller_ =
        actions_.read(floor_.at(frame_->predictedDisplayTime), frame_->predictedDisplayTime, room_from_floor_);
  if (!seen || ending_) end_frame(Picture::None);
  if (ending_) {
    end_session();
    return Headset::Turn::Off;
  }
  return seen ? Headset::Turn::Frame : Headset::Turn::Hidden;
}

// Logs the freeze. The session can be ended, and another headset looked for, only after the runtime responds.
void HeadsetSession::say_frozen(std::int64_t since_ns) {
  if (since_ns < kLongFrozenNs || std::exchange(said_frozen_, true)) return;
  messages_.emplace_back("headset: frozen for 10 s, and no other is looked for before its runtime answers: restart it");
}

void HeadsetSession::begin_frame(const FrameWait::Answer& answer) {
  check_openxr(answer.result, "xrWaitFrame");
  const XrFrameBeginInfo info{.type = XR_TYPE_FRAME_BEGIN_INFO, .next = nullptr};
  check_openxr(calls_.BeginFrame(session_, &info), "xrBeginFrame");
  frame_ = answer.frame;
  located_ = false;
  const XrSpace floor = floor_.at(frame_->predictedDisplayTime);
  if (floor != XR_NULL_HANDLE && !std::exchange(said_floor_, true)) {
    messages_.push_back("headset: the floor is " + floor_.source());
  }
}

std::optional<std::array<HeadsetEye, 2>> HeadsetSession::locate_eyes(const std::function<void()>& while_waiting) {
  located_ = false;
  if (!frame_ || !get_ready_to_copy(while_waiting)) return std::nullopt;
  const XrViewLocateInfo info{.type = XR_TYPE_VIEW_LOCATE_INFO,
                              .next = nullptr,
                              .viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO,
                              .displayTime = frame_->predictedDisplayTime,
                              .space = floor_.at(frame_->predictedDisplayTime)};
  auto state = openxr_struct<XrViewState>(XR_TYPE_VIEW_STATE);
  std::uint32_t count = 0;
  for (XrView& view : views_) view = openxr_struct<XrView>(XR_TYPE_VIEW);
  check_openxr(
      calls_.LocateViews(session_, &info, &state, static_cast<std::uint32_t>(views_.size()), &count, views_.data()),
      "xrLocateViews");
  if (count != views_.size() || !is_placed(state.viewStateFlags)) return std::nullopt;
  std::array<HeadsetEye, 2> eyes;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const XrFovf& fov = views_[i].fov;
    eyes[i].pose = in_room(room_from_floor_, to_pose(views_[i].pose));
    eyes[i].fov = {.left_rad = static_cast<double>(fov.angleLeft),
                   .right_rad = static_cast<double>(fov.angleRight),
                   .down_rad = static_cast<double>(fov.angleDown),
                   .up_rad = static_cast<double>(fov.angleUp)};
    const auto view = scene::eye_from_fov(eyes[i].pose, eyes[i].fov, scene::DepthConvention::VulkanReversedInfinite,
                                          scene::kNearM, kUnusedFarM);
    if (!view) return std::nullopt;
    eyes[i].view = *view;
  }
  located_ = true;
  return eyes;
}

// Does all the waiting that showing a picture needs; false if the runtime provides no image for it.
bool HeadsetSession::get_ready_to_copy(const std::function<void()>& while_waiting) {
  if (!pictures_.take(while_waiting)) return false;
  device_.wait_for(copying_[copied_ % copying_.size()].done, while_waiting);
  return true;
}

bool HeadsetSession::show() {
  if (!frame_) return false;
  if (!located_) {
    end_frame(Picture::None);
    return false;
  }
  quads_.take(panels_.apart());
  submit_copies();
  pictures_.give_back();
  quads_.give_back();
  end_frame(Picture::Eyes);
  return true;
}

void HeadsetSession::submit_copies() {
  const Copying& copying = copying_[copied_++ % copying_.size()];
  device_->resetFences(*copying.done);
  copying.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  pictures_.record(copying.commands, eyes_);
  quads_.record(copying.commands);
  copying.commands.end();
  const vk::CommandBufferSubmitInfo submit{.commandBuffer = *copying.commands};
  device_.queue().submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &submit}, *copying.done);
}

void HeadsetSession::end_frame(Picture picture) {
  std::array<XrCompositionLayerProjectionView, 2> views{};
  std::array<std::optional<XrCompositionLayerDepthInfoKHR>, 2> depths;
  for (const scene::Eye eye : scene::kEyes) {
    const std::size_t i = eye == scene::Eye::Left ? 0 : 1;
    if (picture == Picture::None) break;
    depths[i] = pictures_.depth(eye, eyes_.drawing().extent);
    views[i] = {.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                .next = depths[i] ? &*depths[i] : nullptr,
                .pose = views_[i].pose,
                .fov = views_[i].fov,
                .subImage = pictures_.sub_image(eye, eyes_.extent())};
  }
  const XrSpace floor = floor_.at(frame_->predictedDisplayTime);
  const XrCompositionLayerProjection eyes{.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION,
                                          .next = nullptr,
                                          .layerFlags = 0,
                                          .space = floor,
                                          .viewCount = static_cast<std::uint32_t>(views.size()),
                                          .views = views.data()};
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  if (picture == Picture::Eyes) {
    layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&eyes));
    for (const XrCompositionLayerQuad& quad : quads_.layers(floor, room_from_floor_)) {
      layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad));
    }
  }
  const XrFrameEndInfo info{.type = XR_TYPE_FRAME_END_INFO,
                            .next = nullptr,
                            .displayTime = frame_->predictedDisplayTime,
                            .environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
                            .layerCount = static_cast<std::uint32_t>(layers.size()),
                            .layers = layers.data()};
  frame_.reset();
  check_openxr(calls_.EndFrame(session_, &info), "xrEndFrame");
}

void HeadsetSession::pulse() {
  if (states_.focused()) actions_.pulse();
}

}  // namespace afm::render
