// SPDX-License-Identifier: Apache-2.0
#include "headset/controller_actions.h"

#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "headset/openxr_pose.h"

namespace afm::render {
namespace {

constexpr std::array kHandPaths{"/user/hand/left", "/user/hand/right"};
constexpr XrDuration kPulseNs = 60'000'000;
constexpr float kPulseStrength = 0.8F;

struct ActionRow {
  const char* name;
  const char* words;  // text shown by some runtimes where the user changes bindings
  XrActionType type;
};
constexpr std::array<ActionRow, 7> kControllerActions{{{"aim", "Point", XR_ACTION_TYPE_POSE_INPUT},
                                                       {"select", "Choose", XR_ACTION_TYPE_BOOLEAN_INPUT},
                                                       {"grab", "Hold the scene", XR_ACTION_TYPE_BOOLEAN_INPUT},
                                                       {"scale", "Scale the scene", XR_ACTION_TYPE_BOOLEAN_INPUT},
                                                       {"home", "Scene to its place", XR_ACTION_TYPE_BOOLEAN_INPUT},
                                                       {"fly", "Fly", XR_ACTION_TYPE_VECTOR2F_INPUT},
                                                       {"pulse", "Jump of the tip", XR_ACTION_TYPE_VIBRATION_OUTPUT}}};

// Inputs of a controller for the actions of kControllerActions; null if it has none. "x|a" means x on the left hand and
// a on the right.
struct ProfileRow {
  const char* profile;
  std::array<const char*, kControllerActions.size()> inputs;
};
constexpr const char* kAimInput = "input/aim/pose";
constexpr const char* kPulseOutput = "output/haptic";
constexpr std::array<ProfileRow, 5> kControllerProfiles{
    {{"/interaction_profiles/khr/simple_controller",
      {kAimInput, "input/select/click", nullptr, nullptr, "input/menu/click", nullptr, kPulseOutput}},
     {"/interaction_profiles/oculus/touch_controller",
      {kAimInput, "input/trigger/value", "input/squeeze/value", "input/x/click|input/a/click",
       "input/y/click|input/b/click", "input/thumbstick", kPulseOutput}},
     {"/interaction_profiles/valve/index_controller",
      {kAimInput, "input/trigger/click", "input/squeeze/value", "input/a/click", "input/b/click", "input/thumbstick",
       kPulseOutput}},
     {"/interaction_profiles/htc/vive_controller",
      {kAimInput, "input/trigger/click", "input/squeeze/click", "input/trackpad/click", "input/menu/click",
       "input/trackpad", kPulseOutput}},
     {"/interaction_profiles/microsoft/motion_controller",
      {kAimInput, "input/trigger/value", "input/squeeze/click", "input/trackpad/click", "input/menu/click",
       "input/thumbstick", kPulseOutput}}}};

std::string input_of(const char* inputs, std::size_t hand) {
  const std::string_view both(inputs);
  const std::size_t bar = both.find('|');
  if (bar == std::string_view::npos) return std::string(both);
  return std::string(hand == 0 ? both.substr(0, bar) : both.substr(bar + 1));
}

template <std::size_t kSize>
void put(char (&to)[kSize], const char* text) {
  std::strncpy(to, text, kSize - 1);
}

}  // namespace

ControllerActions::ControllerActions(const OpenXrInstance& calls, XrSession session)
    : calls_(calls), session_(session) {
  static_assert(kCount == kControllerActions.size());
  auto set = openxr_struct<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
  put(set.actionSetName, "wand");
  put(set.localizedActionSetName, "Wand");
  check_openxr(calls.CreateActionSet(calls.handle(), &set, &set_), "xrCreateActionSet");
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) hands_[hand] = calls.path(kHandPaths[hand]);
  for (std::size_t i = 0; i < kCount; ++i) actions_[i] = create(static_cast<Which>(i));
  suggest();
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    const XrActionSpaceCreateInfo space{.type = XR_TYPE_ACTION_SPACE_CREATE_INFO,
                                        .next = nullptr,
                                        .action = actions_[Aim],
                                        .subactionPath = hands_[hand],
                                        .poseInActionSpace = kOpenXrOrigin};
    check_openxr(calls.CreateActionSpace(session, &space, &aims_[hand]), "xrCreateActionSpace");
  }
  const XrSessionActionSetsAttachInfo attach{
      .type = XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, .next = nullptr, .countActionSets = 1, .actionSets = &set_};
  check_openxr(calls.AttachSessionActionSets(session, &attach), "xrAttachSessionActionSets");
}

XrAction ControllerActions::create(Which which) const {
  const ActionRow& row = kControllerActions[which];
  auto info = openxr_struct<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
  put(info.actionName, row.name);
  put(info.localizedActionName, row.words);
  info.actionType = row.type;
  info.countSubactionPaths = static_cast<std::uint32_t>(hands_.size());
  info.subactionPaths = hands_.data();
  XrAction action = XR_NULL_HANDLE;
  check_openxr(calls_.CreateAction(set_, &info, &action), "xrCreateAction");
  return action;
}

void ControllerActions::suggest() const {
  for (const ProfileRow& row : kControllerProfiles) {
    std::vector<XrActionSuggestedBinding> bindings;
    for (std::size_t i = 0; i < kCount; ++i) {
      if (row.inputs[i] == nullptr) continue;
      for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
        const std::string path = std::string(kHandPaths[hand]) + "/" + input_of(row.inputs[i], hand);
        bindings.push_back({.action = actions_[i], .binding = calls_.path(path.c_str())});
      }
    }
    const XrInteractionProfileSuggestedBinding suggested{
        .type = XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING,
        .next = nullptr,
        .interactionProfile = calls_.path(row.profile),
        .countSuggestedBindings = static_cast<std::uint32_t>(bindings.size()),
        .suggestedBindings = bindings.data()};
    const XrResult result = calls_.SuggestInteractionProfileBindings(calls_.handle(), &suggested);
    // a runtime does not have to know every controller
    if (result != XR_ERROR_PATH_UNSUPPORTED) check_openxr(result, "xrSuggestInteractionProfileBindings");
  }
}

bool ControllerActions::pressed(Which which, std::size_t hand) const {
  const XrActionStateGetInfo info{
      .type = XR_TYPE_ACTION_STATE_GET_INFO, .next = nullptr, .action = actions_[which], .subactionPath = hands_[hand]};
  auto state = openxr_struct<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
  check_openxr(calls_.GetActionStateBoolean(session_, &info, &state), "xrGetActionStateBoolean");
  return state.isActive == XR_TRUE && state.currentState == XR_TRUE;
}

HeadsetController ControllerActions::read(XrSpace base, XrTime time, const scene::HeadPose& room_from_base) {
  const XrActiveActionSet active{.actionSet = set_, .subactionPath = XR_NULL_PATH};
  const XrActionsSyncInfo sync{
      .type = XR_TYPE_ACTIONS_SYNC_INFO, .next = nullptr, .countActiveActionSets = 1, .activeActionSets = &active};
  const XrResult synced = calls_.SyncActions(session_, &sync);
  check_openxr(synced, "xrSyncActions");
  if (synced == XR_SESSION_NOT_FOCUSED) return {};

  // the hand that pressed last points, until the other one presses
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    if (!pressed(Select, hand_) && (pressed(Select, hand) || pressed(Grab, hand))) hand_ = hand;
  }
  HeadsetController controller;
  XrActionStateGetInfo info{
      .type = XR_TYPE_ACTION_STATE_GET_INFO, .next = nullptr, .action = actions_[Aim], .subactionPath = hands_[hand_]};
  auto aim = openxr_struct<XrActionStatePose>(XR_TYPE_ACTION_STATE_POSE);
  check_openxr(calls_.GetActionStatePose(session_, &info, &aim), "xrGetActionStatePose");
  controller.connected = aim.isActive == XR_TRUE;
  if (!controller.connected) return controller;
  auto found = openxr_struct<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  check_openxr(calls_.LocateSpace(aims_[hand_], base, time, &found), "xrLocateSpace");
  const scene::HeadPose placed = in_room(room_from_base, to_pose(found.pose));
  controller.place_valid = is_placed(found.locationFlags) && is_pose(placed);
  if (controller.place_valid) {
    controller.position_m = placed.position_m;
    controller.room_from_controller = placed.room_from_head;
  }
  controller.select = pressed(Select, hand_);
  controller.grab = pressed(Grab, hand_);
  controller.scale = pressed(Scale, hand_);
  controller.home = pressed(Home, hand_);
  info.action = actions_[Fly];
  auto fly = openxr_struct<XrActionStateVector2f>(XR_TYPE_ACTION_STATE_VECTOR2F);
  check_openxr(calls_.GetActionStateVector2f(session_, &info, &fly), "xrGetActionStateVector2f");
  if (fly.isActive == XR_TRUE && std::isfinite(fly.currentState.x) && std::isfinite(fly.currentState.y)) {
    controller.fly = glm::clamp(glm::dvec2(fly.currentState.x, fly.currentState.y), glm::dvec2(-1.0), glm::dvec2(1.0));
  }
  return controller;
}

void ControllerActions::pulse() const {
  const XrHapticActionInfo info{
      .type = XR_TYPE_HAPTIC_ACTION_INFO, .next = nullptr, .action = actions_[Pulse], .subactionPath = hands_[hand_]};
  const XrHapticVibration vibration{.type = XR_TYPE_HAPTIC_VIBRATION,
                                    .next = nullptr,
                                    .duration = kPulseNs,
                                    .frequency = XR_FREQUENCY_UNSPECIFIED,
                                    .amplitude = kPulseStrength};
  check_openxr(calls_.ApplyHapticFeedback(session_, &info, reinterpret_cast<const XrHapticBaseHeader*>(&vibration)),
               "xrApplyHapticFeedback");
}

}  // namespace afm::render
