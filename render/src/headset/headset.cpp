// SPDX-License-Identifier: Apache-2.0
#include "render/headset.h"

#include <fmt/format.h>

#include <utility>

#include "device/device_error.h"
#include "headset/headset_session.h"
#include "renderer/renderer_parts.h"

namespace afm::render {

struct Headset::Parts {
  HeadsetRuntimeParts& runtime;
  const Device& device;
  const Renderer::Parts& renderer;
  scene::HeadPose room_from_floor;
  const core::Clock& clock;
  std::vector<std::string> messages;
  std::unique_ptr<HeadsetSession> session;  // null while the headset is lost
  Turn turn = Turn::Off;
  std::int64_t looked_ns = 0;
  std::string said_missing;
  std::int64_t located_ns = 0;
  std::optional<std::int64_t> pose_age_ns{};

  core::Result<void> begin();
  void look_again();
  void forget();
  template <class Call>
  void follow_loss(Call&& call);
};

core::Result<void> Headset::Parts::begin() {
  try {
    session =
        std::make_unique<HeadsetSession>(runtime, device, renderer.eyes, renderer.panels, room_from_floor, messages);
  } catch (const OpenXrFailure& failure) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("no headset: {} takes no picture of ours ({}): restart it, or bring it up to date",
                                     runtime.runtime_name, failure.what()));
  } catch (const vk::SystemError& error) {
    return core::failure(core::ErrorCategory::Failed, describe_error(error, device, "the headset's pictures"));
  }
  messages.push_back(fmt::format("headset: {} through {}", runtime.headset_name, runtime.runtime_name));
  return {};
}

void Headset::Parts::forget() {
  session.reset();
  runtime.close();
  looked_ns = clock.now_ns();
  said_missing.clear();
  messages.emplace_back("headset: lost; looking for it every 2 s");
}

void Headset::Parts::look_again() {
  const std::int64_t now_ns = clock.now_ns();
  if (now_ns - looked_ns < kLookAgainNs) return;
  auto found = runtime.open();
  if (found) found = runtime.check_device(device);
  if (found) found = begin();
  looked_ns = clock.now_ns();
  if (found) return;
  runtime.close();
  // a repeated message is logged once
  if (std::exchange(said_missing, found.error().message) != found.error().message) messages.push_back(said_missing);
}

// Runs `call`. After a failure the session is dropped rather than repaired: another session may succeed.
template <class Call>
void Headset::Parts::follow_loss(Call&& call) {
  try {
    rethrow_as_device_failure(device, "showing a picture in the headset", std::forward<Call>(call));
  } catch (const OpenXrFailure& failure) {
    messages.push_back(fmt::format("headset: {}", failure.what()));
    session->lost();
  }
}

Headset::Headset(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Headset::~Headset() = default;

core::Result<std::unique_ptr<Headset>> Headset::create(HeadsetRuntime& runtime, Context& context, Renderer& renderer,
                                                       const scene::HeadPose& room_from_floor,
                                                       const core::Clock& clock) {
  std::unique_ptr<Parts> parts(new Parts{
      runtime.parts(), context.device(), *renderer.parts_, room_from_floor, clock, {}, nullptr, Turn::Off, 0, {}});
  if (auto begun = parts->begin(); !begun) return tl::unexpected(begun.error());
  return std::unique_ptr<Headset>(new Headset(std::move(parts)));
}

Headset::Turn Headset::next_turn(const std::function<void()>& while_waiting) {
  Parts& parts = *parts_;
  parts.turn = Turn::Off;
  if (!parts.session) parts.look_again();
  if (!parts.session) return Turn::Off;
  parts.follow_loss([&] { parts.turn = parts.session->next_turn(parts.clock, while_waiting); });
  if (parts.session->over()) {
    parts.forget();
    parts.turn = Turn::Off;
  }
  return parts.turn;
}

std::optional<std::array<HeadsetEye, 2>> Headset::locate_eyes(const std::function<void()>& while_waiting) {
  std::optional<std::array<HeadsetEye, 2>> eyes;
  if (parts_->session) parts_->follow_loss([&] { eyes = parts_->session->locate_eyes(while_waiting); });
  parts_->located_ns = parts_->clock.now_ns();
  return eyes;
}

std::size_t Headset::most_panels() const { return parts_->session ? parts_->session->most_panels() : 0; }

bool Headset::show() {
  bool shown = false;
  if (parts_->session) parts_->follow_loss([&] { shown = parts_->session->show(); });
  if (shown) parts_->pose_age_ns = parts_->clock.now_ns() - parts_->located_ns;
  return shown;
}

std::optional<std::int64_t> Headset::pose_age_ns() const { return parts_->pose_age_ns; }

const HeadsetController& Headset::controller() const {
  static const HeadsetController kNone;
  // a button must not stay pressed when no frame could have reported its release
  const bool known = parts_->turn == Turn::Hidden || parts_->turn == Turn::Frame;
  return parts_->session && known ? parts_->session->controller() : kNone;
}

void Headset::pulse() {
  if (parts_->session) parts_->follow_loss([&] { parts_->session->pulse(); });
}

std::vector<std::string> Headset::take_messages() { return std::exchange(parts_->messages, {}); }

}  // namespace afm::render
