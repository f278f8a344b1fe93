// SPDX-License-Identifier: Apache-2.0
#include "servo/servo_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/check.h"
#include "core/exit_code.h"
#include "servo/haptic_choice.h"
#include "servo/servo_process.h"
#include "servo/servo_takeover.h"

namespace afm::servo {

namespace {

constexpr std::int64_t kStopNs = 250'000'000;  // time in which even a servo that missed ticks notices a stop

constexpr std::int64_t kSilentNs = 200'000'000;
constexpr int kSilentPolls = 3;  // number of polls; a frame loop that was itself stopped has received nothing either

// Error for a servo that ended unexpectedly; it has printed the details to stderr.
core::Error ended(int status) {
  switch (static_cast<core::ExitCode>(status)) {
    case core::ExitCode::DeviceMissing:
      return {core::ErrorCategory::DeviceMissing,
              "the haptic device is missing: the line above lists what was tried; without a device, use --haptics sim"};
    case core::ExitCode::BadInputFile:
      return {core::ErrorCategory::BadInputFile,
              "the servo cannot make this scene or session felt: the line above gives the reason"};
    case core::ExitCode::WrongUsage:
      return {core::ErrorCategory::WrongUsage, "the servo refuses its settings: the line above gives the reason"};
    default:
      return {core::ErrorCategory::Failed,
              fmt::format("the servo ended unexpectedly (status {}): no force reaches the hand", status)};
  }
}

}  // namespace

core::Result<std::unique_ptr<ServoClient>> ServoClient::start(const scene::SharedModel& model,
                                                              std::uint64_t scene_digest, const ServoChoice& choice,
                                                              const std::string& program,
                                                              const scene::Topography& topography) {
  const auto device = parse_haptic_choice(choice.haptic_device);
  if (!device) return tl::unexpected(device.error());
  const std::string servo = std::filesystem::path(program).replace_filename("touchafm-servo").string();
  if (auto taken = take_waiting_servo(model, scene_digest, choice.settings, choice.haptic_device, servo)) {
    std::unique_ptr<ServoClient> link(new ServoClient(std::move(taken->segment), choice.settings));
    link->go_on();
    link->servo_ = AdoptedServo::adopt(std::move(taken->servo), link->segment_, link->side_);
    return link;
  }
  auto segment = scene::SharedSegment::create(model, scene_digest, topography);
  if (!segment) return tl::unexpected(segment.error());
  std::unique_ptr<ServoClient> link(new ServoClient(std::move(*segment), choice.settings));

  if (choice.mode == ServoMode::Process) {
    auto process = ServoProcess::spawn(servo, link->segment_, link->side_, choice.settings, choice.haptic_device);
    if (!process) return tl::unexpected(process.error());
    link->servo_ = std::move(*process);
  } else {
    auto opened = open_haptic_device(*device, link->clock_);
    if (!opened) return tl::unexpected(opened.error());
    auto thread = ServoThread::start(link->segment_, link->side_, choice.settings, std::move(opened->device));
    if (!thread) return tl::unexpected(thread.error());
    link->servo_ = std::move(*thread);
  }
  return link;
}

void ServoClient::beat(std::int64_t now_ns) {
  const bool stop = stopped_ns_ && now_ns - *stopped_ns_ < kStopNs;
  side_.store(scene::RendererHeartbeat{.time_ns = now_ns,
                                       .frame = beats_++,
                                       .leaving = 0,
                                       .stop = stop ? 1U : 0U,
                                       .unseen = picture_ == Picture::Unseen ? 1U : 0U,
                                       .take_back = taken_back_,
                                       .put_back = put_back_,
                                       .look = looked_});
}

void ServoClient::take_back_push(std::int64_t now_ns) {
  ++taken_back_;
  beat(now_ns);
}

void ServoClient::put_particles_back(std::int64_t now_ns) {
  ++put_back_;
  beat(now_ns);
}

void ServoClient::look_again(std::int64_t now_ns) {
  ++looked_;
  beat(now_ns);
}

void ServoClient::stop(std::int64_t now_ns) {
  stopped_ns_ = now_ns;
  beat(now_ns);
}

core::Result<ServoClient::Update> ServoClient::poll(std::int64_t now_ns) {
  beat(now_ns);
  take_state(now_ns);
  take_particles();

  Update update;
  while (const auto sample = listener_ ? listener_->pop_sample() : side_.pop_sample())
    update.samples.push_back(*sample);
  while (const auto event = listener_ ? listener_->pop_event() : side_.pop_event()) update.events.push_back(*event);

  // stored before the servo's first tick
  if (device_.name.front() == '\0') device_ = side_.device().value_or(device_);
  if (!servo_->alive()) {
    return tl::unexpected(ended(servo_->exit_status().value_or(-1)));
  }
  return update;
}

void ServoClient::listen(TipAudience& audience) {
  AFM_CHECK(!listener_);
  listener_ = std::make_unique<TipListener>(segment_.renderer_side(), audience);
}

void ServoClient::take_state(std::int64_t now_ns) {
  const auto state = side_.tip_state();
  if (state && (state->tick != tip_.tick || !heard_)) {
    heard_ = {.time_ns = now_ns, .polls = 0};
    tip_ = *state;
    tip_.acknowledged.hand_script =
        state->acknowledged.hand_script > script_base_ ? state->acknowledged.hand_script - script_base_ : 0;
  } else if (heard_ && ++heard_->polls >= kSilentPolls && now_ns - heard_->time_ns > kSilentNs) {
    tip_.servo_state = scene::ServoState::Fault;
    tip_.fault = scene::FaultCode::ServoSilent;
  }
}

void ServoClient::take_particles() {
  changed_pages_.clear();
  const scene::SharedParticles& particles = segment_.model().particles;
  if (!scene::are_there(particles)) return;
  pages_.resize(scene::pages_of(particles.count));
  push_ = side_.tip_push().value_or(push_);
  if (scene::has_marks(particles)) tiles_.resize(scene::kMarkTiles);
  for (std::uint32_t i = 0; i < tiles_.size(); ++i) {
    const auto tile = side_.new_mark_tile(i);
    if (!tile) continue;
    tiles_[i] = *tile;
    ++marks_;
  }
  for (std::uint32_t i = 0; i < pages_.size(); ++i) {
    const auto page = side_.new_particle_page(i);
    if (!page) continue;
    pages_[i] = *page;
    changed_pages_.push_back(i);
  }
}

std::uint32_t ServoClient::change(std::size_t material, const scene::SharedContact& parameters,
                                  std::shared_ptr<const scene::SharedMeasuredCurve> curve) {
  AFM_CHECK(material < segment_.model().material_count);
  edits_.push_back({parameters, std::move(curve)});
  scene::MaterialEdit edit{.material = parameters, .revision = edit_base_ + static_cast<std::uint32_t>(edits_.size())};
  if (edits_.back().curve) edit.curve = *edits_.back().curve;
  side_.store(edit, static_cast<std::uint32_t>(material));
  return edit.revision;
}

const ServoClient::Edit* ServoClient::edit_of(std::uint32_t revision) const {
  const std::size_t index = std::size_t{revision} - edit_base_ - 1;  // huge if the revision is not ours
  return index < edits_.size() ? &edits_[index] : nullptr;
}

const scene::SharedContact& ServoClient::parameters(std::size_t material, std::uint32_t edit_revision) const {
  const Edit* const edit = edit_of(edit_revision);
  return edit != nullptr ? edit->parameters : segment_.model().materials[material];
}

const scene::SharedMeasuredCurve& ServoClient::curve(std::size_t material, std::uint32_t edit_revision) const {
  const Edit* const edit = edit_of(edit_revision);
  if (edit != nullptr && edit->curve) return *edit->curve;
  const std::uint32_t index = parameters(material, edit_revision).measured_curve;
  AFM_CHECK(index < segment_.model().curve_count);
  return segment_.model().curves[index];
}

void ServoClient::place(const scene::SceneTransforms& transforms) {
  room_from_sample_ = transforms.room_from_node[segment_.model().sample_node];
  side_.store(transforms);
}

void ServoClient::script(const scene::HandScript& script) {
  scene::HandScript next = script;
  next.revision += script_base_;
  side_.store(next);
}

void ServoClient::lead(const scene::ScanLead& lead) {
  scene::ScanLead next = lead;
  next.revision = ++leads_;
  side_.store(next);
}

// Continues for a renderer that died: revisions continue from its last one, its edits and its plan are undone, and its
// unread data are discarded.
void ServoClient::go_on() {
  tip_ = side_.tip_state().value_or(scene::TipState{});
  selection_ = side_.last_selection().value_or(scene::Selection{.revision = tip_.acknowledged.selection});
  script_base_ =
      side_.last_hand_script().value_or(scene::HandScript{.revision = tip_.acknowledged.hand_script}).revision;
  const scene::SharedModel& model = segment_.model();
  std::vector<std::size_t> edited;
  for (std::uint32_t i = 0; i < model.material_count; ++i) {
    const auto edit = side_.last_edit(i);
    if (!edit) continue;
    edit_base_ = std::max(edit_base_, edit->revision);
    edited.push_back(i);
  }
  for (const std::size_t i : edited) change(i, model.materials[i]);
  plan({});
  while (side_.pop_sample()) {
  }
  while (side_.pop_event()) {
  }
}

void ServoClient::choose(std::int32_t material, scene::ScaleMode mode, const scene::PushSettings& settings) {
  selection_.material = material;
  selection_.scale_mode = mode;
  selection_.settings = settings;
  // a release that the servo has not seen yet must not be overwritten
  if (tip_.acknowledged.selection == selection_.revision) selection_.release = 0;
  ++selection_.revision;
  side_.store(selection_);
}

void ServoClient::take_force_away() {
  if (selection_.material < 0) return;
  selection_.release = 1;
  ++selection_.revision;
  side_.store(selection_);
}

}  // namespace afm::servo
