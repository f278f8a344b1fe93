// SPDX-License-Identifier: Apache-2.0
#include "app/cluster/node_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "app/cluster/cluster_master.h"
#include "app/display/view_display.h"
#include "app/view/parameter_edits.h"
#include "app/view/view_panels.h"
#include "cluster/frame_message.h"
#include "core/interruption.h"
#include "core/log.h"
#include "exhibit/cluster/frame_digest.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/cluster/living_screens.h"
#include "exhibit/cluster/shared_picture.h"
#include "exhibit/cluster/wall_history.h"
#include "exhibit/frame/blank_picture.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"
#include "scene/samples/adjusted_set.h"
#include "scene/samples/particle_set.h"

namespace afm::app {

namespace {

constexpr std::int64_t kCatchUpNs = 40'000'000;        // longest wait of a frame for the samples before it
constexpr std::int64_t kSwapNs = 400'000'000;          // longest wait for the signal to show; exceeds the master's
constexpr std::int64_t kMasterGoneNs = 2'000'000'000;  // time without a frame after which the master counts as lost
constexpr std::size_t kMostRecords = 60'000;           // one minute of the servo
constexpr int kPauseMs = 10;                           // time between two checks of the windows

}  // namespace

NodeView::NodeView(const exhibit::Stage& stage, const std::vector<curves::SampleModel>& materials, ViewDisplay& display,
                   cluster::NodeLink& link, Place place, KeyList key_list, const core::Clock& clock)
    : stage_(stage),
      windows_(display.windows()),
      picture_(display.picture()),
      link_(link),
      place_(std::move(place)),
      clock_(clock),
      felt_(materials),
      frames_(std::make_unique<exhibit::FrameBuilder>(stage.wall_scene, felt_, stage.eyes)),
      panels_(std::make_unique<ViewPanels>(stage.wall_scene, materials, key_list)),
      history_(std::make_unique<exhibit::WallHistory>(materials.size())),
      sight_(display.windows().all(), clock) {
  panels_->set_friction(&history_->friction);
  if (stage.particles) adjusted_ = std::make_unique<scene::AdjustedSet>(*stage.particles);
}

NodeView::~NodeView() = default;

// Handles Stop and the staff keys that concern only this machine; returns whether to leave.
bool NodeView::leaves() {
  const ViewInput input = windows_.poll();
  bool leaves = input.close_requested;
  for (const ViewEvent& event : input.events) {
    if (event.event.kind != render::WindowEvent::Kind::KeyDown) continue;
    leaves = leaves || event.event.key == render::Key::Escape;
    if (event.event.key == render::Key::Enter) ++stops_;
    if (event.event.key == render::Key::F11) windows_.toggle_full_screen();
    if (event.event.key == render::Key::F12) picture_.save();
  }
  return leaves;
}

void NodeView::forget() {
  knows_history_ = false;
  records_.clear();
}

void NodeView::restore(std::span<const std::byte> document) {
  auto history = exhibit::load_history(document, felt_.size());
  if (!history) return core::log_line("the master sent a history that is not valid; asking again");
  // a number different from the one before, since the marks may differ
  history->marks += history_->marks + 1;
  *history_ = std::move(*history);
  knows_history_ = true;
  scan_.reset();
  while (!records_.empty() && records_.front().number <= history_->journal) records_.pop_front();
  for (const cluster::EditRecord& edit : history_->edits) panels_->edits().follow(edit);
}

// Applies the records in order. A record that cannot be applied leaves a gap, which the next history fills.
void NodeView::take_records() {
  while (const auto record = link_.record()) {
    if (record->session != place_.session || !exhibit::is_applicable(record->record)) continue;
    if (records_.size() == kMostRecords) records_.pop_front();
    records_.push_back(*record);
  }
}

// Takes all messages. Returns true if another wall is prepared.
bool NodeView::take(const Prepare& prepare) {
  if (const auto model = link_.model()) {
    if (model->bytes == place_.model) {
      place_.session = model->header.session;
      forget();
    } else if (model->bytes != refused_) {
      if (prepare(*model)) return true;
      refused_ = model->bytes;  // one log line for each description, however often it arrives
    }
  }
  take_records();
  if (const auto history = link_.history(); history && history->header.session == place_.session) {
    if (!knows_history_) restore(history->bytes);
  }
  if (auto frame = link_.frame()) next_ = frame;
  return false;
}

void NodeView::apply_until(std::uint64_t journal) {
  while (!records_.empty() && records_.front().number <= journal) {
    const cluster::NodeLink::Numbered next = records_.front();
    records_.pop_front();
    if (next.number <= history_->journal) continue;
    if (next.number != history_->journal + 1) {
      lost_records_ += next.number - history_->journal - 1;
      knows_history_ = false;
      records_.push_front(next);
      return;
    }
    history_->apply(next.record);
    apply_to_scan(next.record);
    if (next.record.kind() == cluster::JournalKind::Edit) panels_->edits().follow(next.record.edit());
  }
}

// Applies every sample to a scan that a hand paints; any other scan follows from the changes of its settings.
void NodeView::apply_to_scan(const cluster::JournalRecord& record) {
  using Kind = cluster::JournalKind;
  if (record.kind() == Kind::Sample && scan_) scan_->follow_hand(record.sample());
  if (record.kind() == Kind::ScanEnd) scan_.reset();
  if (record.kind() == Kind::ScanBegin && record.scan().material < felt_.size()) {
    const cluster::ScanRecord begin = record.scan();
    scan_.emplace(exhibit::scan_subject(stage_.wall_scene, begin.material, felt_[begin.material]),
                  exhibit::hand_of(begin));
    scan_->choose(exhibit::change_of(begin).choice);
  }
  if (record.kind() == Kind::ScanChange && scan_) {
    const exhibit::ScanChange change = exhibit::change_of(record.scan());
    if (!scan_->follow(change.frame, change.pixel)) return scan_.reset();
    scan_->choose(change.choice);
  }
}

// Recomputes a scan that began before this node joined, or that is far ahead.
void NodeView::follow_scan(const cluster::ShownMoment& shown) {
  if ((shown.flags & cluster::ShownMoment::kScan) == 0 || history_->scan.empty()) return scan_.reset();
  const bool truth = (shown.flags & cluster::ShownMoment::kTruth) != 0;
  if (!scan_ || !scan_->follow(shown.scan_frame, shown.scan_pixel)) {
    const cluster::ScanRecord& begin = history_->scan.front();
    exhibit::ScanProgress progress{.frame = shown.scan_frame,
                                   .pixel = shown.scan_pixel,
                                   .truth = truth,
                                   .changes = {},
                                   .hand = exhibit::hand_of(begin)};
    for (const cluster::ScanRecord& change : history_->scan) progress.changes.push_back(exhibit::change_of(change));
    if (begin.material >= felt_.size() || !exhibit::LiveScan::valid(progress)) return scan_.reset();
    scan_.emplace(exhibit::scan_subject(stage_.wall_scene, begin.material, felt_[begin.material]), progress);
  }
  if (scan_->progress().truth != truth) scan_->show_truth(truth);
}

// Applies the records that precede a frame. Returns false while some are missing.
bool NodeView::catch_up(std::uint64_t journal) {
  const std::int64_t until_ns = clock_.now_ns() + kCatchUpNs;
  for (;;) {
    if (knows_history_) apply_until(journal);
    if (!knows_history_ || history_->journal > journal) return false;
    if (history_->journal == journal) return true;
    if (clock_.now_ns() >= until_ns) {
      // the newest records are missing: a new history brings them
      knows_history_ = false;
      return false;
    }
    link_.wait(2);
    take_records();
  }
}

// Returns whether this wall has the message's materials.
bool NodeView::fits(const cluster::FrameMessage& message) const {
  const auto count = static_cast<std::int32_t>(felt_.size());
  return message.tip.material < count && message.moment.hovered < count;
}

cluster::ReadyMessage NodeView::answer_to(const cluster::FrameMessage& message, std::int64_t came_ns) const {
  cluster::ReadyMessage ready{.header = message.header};
  ready.header.node = place_.node;
  ready.wants_history = knows_history_ ? 0 : 1;
  ready.frame_sent_ns = message.sent_ns;
  ready.frame_came_ns = came_ns;
  ready.swapped_ns = swapped_ns_;
  ready.lost_records = lost_records_;
  ready.late_swaps = late_swaps_;
  ready.stops = stops_;
  ready.unseen = sight_.unseen_since_ns() ? 1 : 0;
  return ready;
}

void NodeView::show(const cluster::FrameMessage& message, bool master_gone,
                    const std::function<void(std::uint64_t)>& drawn) {
  const scene::TipState tip = exhibit::tip_of(message);
  panels_->edits().take_felt(tip, felt_);
  exhibit::Moment now = exhibit::moment_of(message);
  now.curves = history_->cycles.curves();
  const bool marks = stage_.particles && scene::leaves_marks(*stage_.particles);
  if (marks) history_->tiles.resize(scene::kMarkTiles);
  if (adjusted_) adjusted_->use(history_->push.settings);
  const auto picture =
      stage_.particles ? exhibit::picture_of(*history_, stage_.particles->particles.size()) : std::nullopt;
  const exhibit::ParticlesNow particles{
      .set = adjusted_ ? &adjusted_->set() : nullptr,
      .pages = history_->pages,
      .push = history_->push,
      .score = history_->score,
      .plan = history_->plan,
      .picture = picture ? &*picture : nullptr,
      .look_load_n = history_->picture.look_load_n,
      .tiles = marks ? std::span<const scene::MarkTile>(history_->tiles) : std::span<const scene::MarkTile>(),
      .marks = history_->marks,
      .limits = adjusted_ ? &adjusted_->limits() : nullptr};
  if (stage_.particles) now.wall.particles = &particles;
  follow_scan(message.moment);
  if (scan_) exhibit::show_scan(*scan_, now);
  panels_->set_scan(scan_ ? &*scan_ : nullptr);
  render::FrameState frame = frames_->build(now);
  const ViewPanels::Told told = panels_->follow(message.panels);
  add_panels(stage_, *panels_, now, {.pointed = told.pointed, .hand = told.hand, .tip = tip},
             exhibit::caption_of(message), frame);
  const bool blank = (message.moment.flags & cluster::ShownMoment::kBlank) != 0;
  if (blank) exhibit::blank(frame, stage_.phrases());
  auto& banner = frame.panels.banner;
  add_warning(missing_text(message.missing, stage_.wall, stage_.phrases()), banner.content);
  if (master_gone) add_warning(stage_.phrases()[exhibit::Phrase::MasterMissing], banner.content);
  banner.placement =
      exhibit::on_living_screens(banner.placement, stage_.wall, {.nodes = message.missing, .master = master_gone});
  picture_.follow(message.view);
  const std::uint64_t digest = exhibit::digest_of(frame, picture_.told());
  picture_.show(frame, exhibit::Relief::NarrowEyes, clock_.now_ns(), [] {}, [&] { drawn(digest); });
  shown_ns_ = clock_.now_ns();
}

// Waits for the signal to show, but not longer than until the master must have given up or continued.
void NodeView::wait_for_swap(const cluster::FrameMessage& message) {
  const std::int64_t until_ns = clock_.now_ns() + kSwapNs;
  for (;;) {
    const auto [session, number] = link_.swapped();
    if (session == message.header.session && number >= message.header.number) return;
    if (auto frame = link_.frame()) next_ = frame;
    const bool left_behind = next_ && next_->frame.header.number > message.header.number;
    if (left_behind || clock_.now_ns() >= until_ns) break;
    link_.wait(2);
  }
  ++late_swaps_;
}

void NodeView::draw(const cluster::NodeLink::Came& came) {
  const cluster::FrameMessage& message = came.frame;
  if (message.header.session != place_.session || !fits(message)) return;
  if (!catch_up(message.journal)) return link_.answer(answer_to(message, came.came_ns));
  show(message, false, [&](std::uint64_t digest) {
    cluster::ReadyMessage ready = answer_to(message, came.came_ns);
    ready.state = cluster::NodeState::Drawing;
    ready.digest = digest;
    ready.draw_us = static_cast<std::uint32_t>((clock_.now_ns() - came.came_ns) / 1000);
    link_.answer(ready);
    wait_for_swap(message);
    swapped_ns_ = clock_.now_ns();
  });
  shown_ = message;
}

bool NodeView::run(const Prepare& prepare) {
  while (!core::interrupted() && !leaves()) {
    if (take(prepare)) return true;
    picture_.fit(clock_.now_ns());
    if (next_) {
      draw(*std::exchange(next_, std::nullopt));
    } else {
      if (shown_ && clock_.now_ns() - shown_ns_ > kMasterGoneNs) show(*shown_, true, [](std::uint64_t) {});
      link_.wait(kPauseMs);
    }
  }
  picture_.finish();
  return false;
}

}  // namespace afm::app
