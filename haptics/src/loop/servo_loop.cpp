// SPDX-License-Identifier: Apache-2.0
#include "haptics/servo_loop.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <span>
#include <utility>

#include "core/clock.h"
#include "haptics/felt_marks.h"
#include "haptics/felt_particles.h"
#include "haptics/realtime.h"

namespace afm::haptics {

namespace {

constexpr double kSlowestHz = 100.0;
constexpr double kFastestHz = 10'000.0;
constexpr std::uint64_t kTimingStoresPerSecond = 5;
constexpr std::int64_t kMostTicksOfMotion = 3;  // most ticks that a moving part catches up after a stall

void count(std::array<std::uint32_t, scene::kHistogramBins>& bins, std::uint32_t& largest, std::uint32_t us) {
  ++bins[std::min<std::uint32_t>(us, scene::kHistogramBins - 1)];
  largest = std::max(largest, us);
}

std::int64_t period_of(const ServoSettings& settings) { return std::llround(1e9 / settings.rate_hz); }

// Scales that all materials of a scene share.
core::Result<CommonScale> scales_of(const scene::SharedModel& model,
                                    std::span<const std::shared_ptr<const physics::LawTables>> tables,
                                    const DeviceSpec& device) {
  auto common = Scaling::common_scale(tables, device);
  if (!common) return common;
  if (model.common_hand_m_per_m > 0) {
    common->hand_m_per_m = model.common_hand_m_per_m;
    common->hand_n_per_n = model.common_hand_n_per_n;
  }
  const auto particles = particle_scale(model.particles, device);
  if (!particles) return tl::unexpected(particles.error());
  common->particles = *particles;
  return common;
}

// Map of the law, null without a map.
std::unique_ptr<const scene::SharedLawMap> map_of(const scene::SharedModel& model) {
  return model.law_map.columns > 0 ? std::make_unique<const scene::SharedLawMap>(model.law_map) : nullptr;
}

std::uint32_t microseconds(std::int64_t ns) {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(ns / 1000, 0, UINT32_MAX));
}

}  // namespace

core::Result<std::unique_ptr<ServoLoop>> ServoLoop::create(scene::SharedSegment& segment, HapticDevice& device,
                                                           const ServoSettings& settings) {
  const double rate_hz = settings.rate_hz;
  if (!(rate_hz >= kSlowestHz && rate_hz <= kFastestHz)) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("cannot run the servo at {} Hz: choose {} to {} Hz", rate_hz, kSlowestHz, kFastestHz));
  }
  const std::int64_t period_ns = period_of(settings);
  // one late tick must not drop the force
  const double slowest_hz = 2.0 / device.spec().force_lasts_s;
  if (rate_hz < slowest_hz) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("cannot run the servo at {} Hz: the {} drops any force older than {} ms; choose {} Hz or more",
                    rate_hz, device.spec().name, 1e3 * device.spec().force_lasts_s, slowest_hz));
  }
  if (settings.spin_ns < 0 || settings.spin_ns > period_ns / 2) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("--spin {} us is too long for a period of {} us: choose 0 to {} us",
                                     settings.spin_ns / 1000, period_ns / 1000, period_ns / 2000));
  }
  if (!(settings.max_force_n >= kLeastForceLimitN)) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("cannot limit the force to {} N: choose {} N or more", settings.max_force_n, kLeastForceLimitN));
  }
  const DeviceSpec spec = limited_to(device.spec(), settings.max_force_n);
  // a copy, because checked data in shared memory could still change
  const auto copy = std::make_unique<const scene::SharedModel>(segment.model());
  const scene::SharedModel& shared = *copy;
  if (auto valid = scene::validate(shared); !valid) return tl::unexpected(valid.error());
  scene::Topography topography = segment.topography();
  if (!scene::is_valid(topography, shared.topography)) {
    return core::failure(core::ErrorCategory::Failed, "the topography of the shared scene is not a grid of heights");
  }
  std::vector<std::shared_ptr<const physics::LawTables>> tables;
  for (std::uint32_t i = 0; i < shared.material_count; ++i) {
    auto felt = build_tables(shared.materials[i], std::span(shared.curves).first(shared.curve_count));
    if (!felt) return tl::unexpected(felt.error());
    tables.push_back(std::move(*felt));
  }
  const auto common = scales_of(shared, tables, spec);
  if (!common) return tl::unexpected(common.error());
  std::vector<std::unique_ptr<ContactModel>> models;
  for (std::uint32_t i = 0; i < shared.material_count; ++i) {
    const auto fields = std::span(shared.height_fields).first(shared.height_field_count);
    auto model = ContactModel::create(shared.materials[i], 0, tables[i],
                                      scene::surface_of(shared.materials[i], fields, topography), *common, spec,
                                      period_ns, &shared.law_map);
    if (!model) return tl::unexpected(model.error());
    models.push_back(std::move(*model));
  }
  return std::unique_ptr<ServoLoop>(
      new ServoLoop(segment, shared, std::move(topography), device, settings, std::move(models), *common));
}

ServoLoop::~ServoLoop() = default;

FeltParticles* ServoLoop::particles() const noexcept { return swap_->used(); }

ServoLoop::ServoLoop(scene::SharedSegment& segment, const scene::SharedModel& model, scene::Topography topography,
                     HapticDevice& device, const ServoSettings& settings,
                     std::vector<std::unique_ptr<ContactModel>> models, const CommonScale& common)
    : shared_(segment.servo_side()),
      device_(device),
      spec_(limited_to(device.spec(), settings.max_force_n)),
      settings_(settings),
      period_ns_(period_of(settings)),
      sample_node_(model.sample_node),
      swap_(ParticleSwap::create(segment, model.particles, common.particles, spec_)),
      marks_(felt_marks_of(segment, model.particles, common.particles, period_ns_)),
      exchange_(std::move(models)),
      edits_(segment.edit_side(), {model.curves.begin(), model.curves.begin() + model.curve_count},
             {model.height_fields.begin(), model.height_fields.begin() + model.height_field_count},
             std::move(topography), map_of(model), common, spec_, period_ns_, exchange_, *swap_),
      governor_(safety_limits(spec_, period_ns_, Scaling::kStrokeM, settings.dead_man)),
      guide_(spec_),
      position_check_(spec_.measures),
      hand_{.position_m = spec_.contact_point_m} {
  shared_.store(shared(spec_));
  for (std::uint32_t i = 0; particles() != nullptr && i < particles()->pages().size(); ++i) {
    shared_.store(particles()->pages()[i], i);
  }
  for (std::uint32_t i = 0; marks_ && i < scene::kMarkTiles; ++i) shared_.store(marks_->tiles()[i], i);
  timing_.rate_hz = 1e9 / static_cast<double>(period_ns_);
  const glm::dmat4 rest = scene::rest_room_from_node(model, sample_node_);
  std::array<double, 16> room_from_sample{};
  std::copy_n(glm::value_ptr(rest), room_from_sample.size(), room_from_sample.begin());
  sample_.set_orientation(room_from_sample);
  // a successor continues with its predecessor's changes
  edits_.build();
}

void ServoLoop::note_grant(const RealtimeGrant& grant) noexcept {
  timing_.policy_fifo = grant.priority > 0 ? 1 : 0;
  timing_.priority = static_cast<std::uint32_t>(std::max(0, grant.priority));
  timing_.pages_locked = grant.pages_locked ? 1 : 0;
  state_.realtime = grant.realtime() && device_.driver_is_realtime() ? 1 : 0;
}

void ServoLoop::tick(std::int64_t now_ns, std::uint32_t wake_us) noexcept {
  read_shared_blocks(now_ns);
  const std::int64_t elapsed_ns = previous_ns_ > 0 ? std::max<std::int64_t>(0, now_ns - previous_ns_) : period_ns_;
  const auto& [x_n, y_n, z_n] = state_.hand.force_n;
  const DeviceSample hand = position_check_.checked(device_.read(now_ns), elapsed_ns, {x_n, y_n, z_n});

  // a failed device, or an implausible position, leaves the last known one in use; the governor handles it below
  hand_.healthy = hand.healthy && is_within_reach(hand.position_m);
  if (hand_.healthy) {
    hand_.position_m = hand.position_m;
    hand_.from_contact_m = hand.position_m - spec_.contact_point_m;
  } else if (model_ != nullptr) {
    model_->wait_for_lift();
  }
  if (hand.turn_on && !hand_.turn_on) ++state_.presses;
  hand_.turn_on = hand.turn_on;

  if (particles() != nullptr) particles()->drift_to(now_ns);
  const double elapsed_s = 1e-9 * static_cast<double>(std::min(elapsed_ns, kMostTicksOfMotion * period_ns_));
  const Wanted wanted = meet_sample(elapsed_s);
  put_particles(elapsed_s);
  put_marks();
  bool pulled_off = false;
  for (std::uint32_t i = 0; i < touch_.response.event_count; ++i) {
    pulled_off = pulled_off || touch_.response.events[i].kind == physics::EventKind::JumpOffContact;
  }

  // from the contact point, so that a recording without any other frame gives the same bits
  renderer_ = renderer_link(now_ns);
  const auto output = governor_.step({.time_ns = now_ns,
                                      .hand_position_m = hand.position_m - spec_.contact_point_m,
                                      .wanted_force_n = wanted.force_n,
                                      .hand_height_m = wanted.hand_height_m,
                                      .phase = touch_.response.phase,
                                      .pulled_off = pulled_off,
                                      .turn_on = hand.turn_on,
                                      .device_healthy = hand.healthy,
                                      .motor_heat = hand.motor_heat,
                                      .renderer = renderer_,
                                      .law_energy = wanted.energy,
                                      .sample_moved = std::exchange(sample_moved_, false),
                                      .led = wanted.led,
                                      .damping_n_s_per_m = wanted.damping_n_s_per_m});
  device_.write(output.command);
  if (output.dropped && model_ != nullptr) model_->wait_for_lift();

  const glm::dvec3& force_n = output.command.force_n();
  state_.hand.force_n = {force_n.x, force_n.y, force_n.z};
  state_.acknowledged.hand_script = hand.finished_script;
  publish_events(now_ns);
  publish(now_ns, wake_us);
  previous_ns_ = now_ns;
  change_model();
}

// While the scan leads the hand, the force law is silent and waits for a lift.
ServoLoop::Wanted ServoLoop::meet_sample(double elapsed_s) noexcept {
  touch_ = {};
  Wanted wanted{.hand_height_m = glm::dot(hand_.from_contact_m, sample_.normal()), .energy = {}};
  if (model_ == nullptr) return wanted;
  const ScanGuide::Pull pull = guide_.step({.hand_m = hand_.from_contact_m,
                                            .target = guide_target(),
                                            .force_on = governor_.state() == scene::ServoState::Running,
                                            .turn_on = hand_.turn_on && hand_.healthy,
                                            .elapsed_s = elapsed_s});
  if (pull.leads) model_->wait_for_lift();
  touch_ = model_->step(sample_.in_sample(hand_.from_contact_m),
                        {.on = scan_.hand == scene::ScanHand::Scans && scan_.feedback != 0,
                         .gain_per_s = scan_.gain_per_s,
                         .elapsed_s = elapsed_s,
                         .without_force = governor_.released()});
  wanted = {.force_n = sample_.in_device(touch_.hand_force_n),
            .hand_height_m = model_->scaling().hand_height_m(touch_.z_m),
            .energy = model_->energy(touch_),
            .led = pull.leads,
            .damping_n_s_per_m = touch_.map.damping_n_s_per_m};
  if (!pull.leads) return wanted;
  wanted.force_n = pull.force_n;
  wanted.damping_n_s_per_m = ScanGuide::kDampingNSPerM;
  wanted.energy = {.stored_j = pull.stored_j, .stiffness_n_per_m = pull.stiffness_n_per_m, .given_j = pull.given_j};
  return wanted;
}

// Puts particles elsewhere, only without force, so that none jumps at a tip that is felt; an order that comes too
// early is dropped. A look needs only a tip that is off them; one with a load that is not gentle moves them.
void ServoLoop::put_particles(double elapsed_s) noexcept {
  if (particles() == nullptr || model_ == nullptr) return;
  if (heard_.look && particles()->may_look()) touch_.push.add({.kind = physics::EventKind::LookedAgain});
  particles()->sweep(scan_, elapsed_s, touch_.push);
  if (!governor_.released()) return;
  if (heard_.put_back && particles()->put_back()) {
    touch_.push.add({.kind = physics::EventKind::ParticlesPutBack});
  } else if (heard_.take_back && particles()->take_back()) {
    touch_.push.add({.kind = physics::EventKind::PushTakenBack});
  }
}

// Position of the scan's tip for the hand. A hand that feels the sample is not pulled off it.
std::optional<ScanGuide::Target> ServoLoop::guide_target() const noexcept {
  const glm::dvec2 apex_m(scan_.apex_xy_m[0], scan_.apex_xy_m[1]);
  if (scan_.hand != scene::ScanHand::Led || model_->phase() == physics::Phase::Attached) return std::nullopt;
  if (!model_->surface().covers(apex_m)) return std::nullopt;
  const Scaling& scaling = model_->scaling();
  const glm::dvec3 place_m(scaling.lateral_m_per_m() * apex_m, scaling.hand_height_m(scan_.height_m));
  return ScanGuide::Target{.time_ns = scan_.time_ns, .in_sample_m = place_m, .in_device_m = sample_.in_device(place_m)};
}

void ServoLoop::read_shared_blocks(std::int64_t now_ns) noexcept {
  heard_.take_back = heard_.put_back = heard_.look = false;
  if (const auto heartbeat = shared_.new_heartbeat()) {
    // the time of arrival counts, not the time in the heartbeat
    heard_.seen_ns = now_ns;
    heard_.leaving = heard_.leaving || heartbeat->leaving != 0;
    // a renderer that replaces another counts from zero
    heard_.take_back = heard_.heartbeat && heartbeat->take_back > heard_.heartbeat->take_back;
    heard_.put_back = heard_.heartbeat && heartbeat->put_back > heard_.heartbeat->put_back;
    heard_.look = heard_.heartbeat && heartbeat->look > heard_.heartbeat->look;
    heard_.heartbeat = heartbeat;
  }
  if (const auto transforms = shared_.new_transforms()) {
    const SampleAxes before = sample_;
    if (!sample_.set_orientation(transforms->room_from_node[sample_node_])) ++refused_transforms_;
    sample_moved_ = sample_moved_ || sample_ != before;
  }
  if (const auto selection = shared_.new_selection()) chosen_ = *selection;
  if (const auto script = shared_.new_hand_script()) device_.follow(*script);
  if (const auto scan = shared_.new_scan_lead()) newest_scan_ = *scan;
  if (const auto plan = shared_.new_plan(); plan && particles() != nullptr) particles()->groove().follow(*plan);
  const std::int64_t age_ns = now_ns - newest_scan_.time_ns;
  const bool fresh = age_ns >= 0 && age_ns <= scene::kScanLeadLastsNs;
  scan_ = fresh && newest_scan_.hand != scene::ScanHand::Apart ? newest_scan_ : scene::ScanLead{};
}

// Follows the paper's procedure: choose, lift, press Turn-On. A selection, or an edit of the material under the tip,
// waits until the tip is off the sample and its particles; then the force is removed, and only without force do law,
// scale and settings change. Edits of other materials are not felt. A release removes the force at once.
void ServoLoop::change_model() noexcept {
  for (std::size_t i = 0; i < exchange_.size(); ++i) {
    if (static_cast<std::int32_t>(i) != state_.material && exchange_.has_offer(i)) exchange_.adopt(i);
  }
  const bool valid = chosen_.material >= 0 && static_cast<std::size_t>(chosen_.material) < exchange_.size();
  const bool newer = valid && chosen_.revision != state_.acknowledged.selection;
  const bool adjusted = valid && swap_->changes(chosen_.settings);
  const bool other =
      adjusted || (newer && (chosen_.material != state_.material || chosen_.scale_mode != state_.active.scale_mode));
  const bool edited = model_ != nullptr && exchange_.has_offer(static_cast<std::size_t>(state_.material));
  changing_ = false;
  if (const bool release = newer && chosen_.release != 0; other || edited || release) {
    const bool pushes = touch_.push.touches && touch_.push.push_n != glm::dvec3(0.0);
    if (!release && model_ != nullptr && (pushes || model_->phase() == physics::Phase::Attached)) return;
    governor_.disarm();
    changing_ = !governor_.released();
    if (changing_) return;
    if (edited) exchange_.adopt(static_cast<std::size_t>(state_.material));
    if (adjusted) swap_->change();
    if (other) {
      select_material(static_cast<std::size_t>(chosen_.material), chosen_.scale_mode);
    } else if (edited) {
      select_material(static_cast<std::size_t>(state_.material), state_.active.scale_mode);
    }
  }
  if (valid) state_.acknowledged.selection = chosen_.revision;
}

void ServoLoop::select_material(std::size_t material, scene::ScaleMode mode) noexcept {
  model_ = &exchange_.current(material);
  model_->wait_for_lift();
  governor_.forget_motion();
  guide_.reset();
  if (particles() != nullptr) {
    particles()->drop();
    particles()->end_sweep();  // particles at rest at the beginning of a session
  }
  if (marks_) marks_->lift();
  model_->use(mode, particles(), marks_.get());
  const Scaling& scaling = model_->scaling();
  governor_.set_release_height(scaling.release_height_m());
  state_.material = static_cast<std::int32_t>(material);
  state_.active = {.scale = {.hand_m_per_m = scaling.hand_m_per_m(), .hand_n_per_n = scaling.hand_n_per_n()},
                   .release_z_m = scaling.release_z_m(),
                   .slow_motion = model_->slow_motion(),
                   .scale_mode = mode,
                   .edit_revision = model_->edit_revision()};
}

RendererLink ServoLoop::renderer_link(std::int64_t now_ns) const noexcept {
  if (presence_.load(std::memory_order_relaxed) != Presence::Here) return RendererLink::Died;
  if (heard_.leaving || stop_.load(std::memory_order_relaxed)) return RendererLink::Leaving;
  if (!heard_.heartbeat) return RendererLink::Absent;
  if (heard_.heartbeat->stop != 0) return RendererLink::Stopped;
  if (now_ns - heard_.seen_ns > SafetyGovernor::kHangNs) return RendererLink::Hung;
  return heard_.heartbeat->unseen != 0 ? RendererLink::Unseen : RendererLink::Alive;
}

bool ServoLoop::finished() const noexcept {
  const bool ending = heard_.leaving || presence_.load(std::memory_order_relaxed) == Presence::Died ||
                      stop_.load(std::memory_order_relaxed);
  return ending && governor_.released();
}

ServoExit ServoLoop::run(const core::MonotonicClock& clock) noexcept {
  const std::uint64_t ticks_per_store =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(timing_.rate_hz) / kTimingStoresPerSecond);
  std::int64_t deadline_ns = clock.now_ns() + period_ns_;
  do {
    sleep_then_spin_until(deadline_ns, settings_.spin_ns, clock);
    const std::int64_t woke_ns = clock.now_ns();
    const std::int64_t missed = std::max<std::int64_t>(0, woke_ns - deadline_ns) / period_ns_;
    const std::uint32_t wake_us = microseconds(woke_ns - deadline_ns);
    tick(woke_ns, wake_us);
    deadline_ns += (missed + 1) * period_ns_;

    ++timing_.ticks;
    timing_.missed += static_cast<std::uint64_t>(missed);
    count(timing_.wake_us, timing_.wake_max_us, wake_us);
    count(timing_.work_us, timing_.work_max_us, microseconds(clock.now_ns() - woke_ns));

    // in the slack before the next deadline: about 16 KB, a few microseconds
    if (timing_.ticks % ticks_per_store == 0) shared_.store(timing_);
  } while (!finished());

  shared_.store(timing_);
  if (heard_.leaving) return ServoExit::RendererLeft;
  return presence_.load(std::memory_order_relaxed) == Presence::Here ? ServoExit::Stopped : ServoExit::RendererDied;
}

}  // namespace afm::haptics
