// SPDX-License-Identifier: Apache-2.0
#include "cluster/master_link.h"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "cluster/document.h"
#include "core/latest_value.h"
#include "core/spsc_ring.h"
#include "transport.h"

namespace afm::cluster {

namespace {

constexpr std::uint64_t kFramesOfCount = 16;
constexpr int kIdleMs = 100;                 // interval at which the thread checks for its end
constexpr std::size_t kRecordsRing = 16384;  // 16 s of the servo's records
constexpr std::size_t kPiecesRing = 2048;    // number of pieces of a history
constexpr std::size_t kPiecesAtOnce = 32;    // limit before other messages get their turn
constexpr std::size_t kBatchesAtOnce = 64;

// A rival has been heard for this long, with this many frames; a stray frame is none. It is gone after a silence.
constexpr std::int64_t kRivalNs = 500'000'000;
constexpr std::uint64_t kRivalFrames = 5;
constexpr std::int64_t kRivalGoneNs = 1'000'000'000;

// Masters that know nothing of one another compare these numbers: the time of the start, then chance.
std::uint64_t new_session() {
  std::random_device chance;
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_1970).count();
  return (static_cast<std::uint64_t>(seconds) << 32U) | chance();
}

}  // namespace

struct MasterLink::Parts {
  explicit Parts(const core::Clock& of_program) : clock(of_program) {}

  // Another master, as described by its frames.
  struct OtherMaster {
    std::uint64_t session = 0;  // session of the other master; 0: none
    std::int64_t first_ns = 0, newest_ns = 0;
    std::uint64_t frames = 0;

    void hear(std::uint64_t of_session, std::int64_t now_ns) {
      if (of_session != session) *this = {.session = of_session, .first_ns = now_ns};
      newest_ns = now_ns;
      ++frames;
    }
    bool drives() const { return frames >= kRivalFrames && newest_ns - first_ns >= kRivalNs; }
  };

  void run(const std::stop_token& stop);
  void write_model();
  void write_journal();
  void write_history();
  void take();
  void watch_rival();
  bool send_piece();

  template <class Message>
  void write(Transport::Topic topic, std::uint32_t key, const Message& message) {
    if (!transport->write(topic, key, encode(message))) unwritten.fetch_add(1, std::memory_order_relaxed);
  }

  const core::Clock& clock;
  std::uint64_t session = 0;
  Doorbell for_thread, for_frames;
  std::unique_ptr<Transport> transport;  // used by the thread only
  std::vector<DocumentPiece> model;      // used by the thread only

  // newest frame, from the frame loop to the thread
  core::LatestValue<FrameMessage> frame;
  core::LatestValue<SwapMessage> swap;
  core::SpscRing<JournalRecord, kRecordsRing> records;
  core::SpscRing<DocumentPiece, kPiecesRing> history;
  // answers, from the thread to the frame loop
  core::SpscRing<Answer, 1024> answers;
  std::atomic<std::uint64_t> refused{0}, unwritten{0}, resent{0};
  std::atomic<Rival> rival{Rival::None};

  // frame loop only
  std::uint64_t recorded = 0, documents = 0;
  std::vector<DocumentPiece> pieces;  // pieces of a history not yet queued
  std::size_t next_piece = 0;

  // thread only
  OtherMaster other;
  std::uint64_t seen_frame = 0, seen_swap = 0, written_records = 0;

  std::jthread thread;  // last member: it ends before the members it uses
};

void MasterLink::Parts::run(const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), kThreadName);
  transport->belong_to_this_thread();
  write_model();
  while (!stop.stop_requested()) {
    for_thread.wait(kIdleMs);
    if (const auto newest = swap.try_load_newer(seen_swap)) write(Transport::Topic::Swap, 0, *newest);
    write_journal();
    if (const auto newest = frame.try_load_newer(seen_frame)) {
      write(Transport::Topic::Frame, 0, *newest);
      if (newest->header.number % kFramesOfCount == 0)
        resent.store(transport->resent_bytes(), std::memory_order_relaxed);
    }
    write_history();
    take();
    watch_rival();
  }
}

// Watches a rival. The nodes have followed the newer wall, and come back to this one when it is described again.
void MasterLink::Parts::watch_rival() {
  if (other.session == 0) return;
  if (clock.now_ns() - other.newest_ns > kRivalGoneNs) {
    other = {};
    rival.store(Rival::None, std::memory_order_relaxed);
    return write_model();
  }
  if (other.drives()) rival.store(other.session < session ? Rival::Earlier : Rival::Later, std::memory_order_relaxed);
}

void MasterLink::Parts::write_model() {
  for (const DocumentPiece& piece : model) write(Transport::Topic::Model, piece.index, piece);
}

void MasterLink::Parts::write_journal() {
  for (std::size_t sent = 0; sent < kBatchesAtOnce; ++sent) {
    JournalBatch batch;
    batch.header.session = session;
    batch.header.number = written_records + 1;
    while (batch.count < JournalBatch::kMost) {
      const auto next = records.pop();
      if (!next) break;
      batch.records[batch.count++] = *next;
    }
    if (batch.count == 0) return;
    written_records += batch.count;
    write(Transport::Topic::Journal, 0, batch);
  }
}

void MasterLink::Parts::write_history() {
  for (std::size_t sent = 0; sent < kPiecesAtOnce; ++sent) {
    const auto piece = history.pop();
    if (!piece) return;
    write(Transport::Topic::History, 0, *piece);
  }
  for_thread.ring();
}

void MasterLink::Parts::take() {
  bool came = false;
  transport->take(Transport::Topic::Ready, [&](std::span<const std::byte> datagram) {
    const auto ready = decode<ReadyMessage>(datagram);
    if (!ready) {
      refused.fetch_add(1, std::memory_order_relaxed);
    } else if (ready->header.session == session) {
      came = answers.push({*ready, clock.now_ns()}) || came;
    }
  });
  transport->take(Transport::Topic::Frame, [&](std::span<const std::byte> datagram) {
    const auto heard = decode<FrameMessage>(datagram);
    if (heard && heard->header.session != session) other.hear(heard->header.session, clock.now_ns());
  });
  if (came) for_frames.ring();
}

bool MasterLink::Parts::send_piece() {
  if (next_piece == pieces.size() || !history.push(pieces[next_piece])) return false;
  ++next_piece;
  return true;
}

MasterLink::MasterLink(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
MasterLink::~MasterLink() = default;

core::Result<std::unique_ptr<MasterLink>> MasterLink::open(const ClusterNetwork& network,
                                                           std::span<const std::byte> model, int listen_ms,
                                                           const core::Clock& clock) {
  auto parts = std::make_unique<Parts>(clock);
  for (Doorbell* bell : {&parts->for_thread, &parts->for_frames}) {
    auto created = Doorbell::create();
    if (!created) return tl::unexpected(created.error());
    *bell = std::move(*created);
  }
  parts->session = new_session();
  parts->model = pieces_of(model, {.session = parts->session, .number = 1});
  auto transport = Transport::open(network, ClusterRole::Master, parts->for_thread);
  if (!transport) return tl::unexpected(transport.error());
  parts->transport = std::move(*transport);

  const std::int64_t listened_ns = clock.now_ns() + std::int64_t{listen_ms} * 1'000'000;
  while (clock.now_ns() < listened_ns && parts->other.session == 0) {
    parts->for_thread.wait(10);
    parts->take();
  }
  if (parts->other.session != 0) {
    return core::wrong_usage(
        "another master already drives a wall in this network and domain: end it first, or give "
        "one of the two another --domain");
  }
  Parts& running = *parts;
  parts->thread = std::jthread([&running](const std::stop_token& stop) { running.run(stop); });
  return std::unique_ptr<MasterLink>(new MasterLink(std::move(parts)));
}

std::uint64_t MasterLink::session() const { return parts_->session; }

void MasterLink::send(std::uint64_t number, FrameMessage& frame) {
  frame.header = {.session = parts_->session, .number = number};
  frame.journal = parts_->recorded;
  frame.sent_ns = parts_->clock.now_ns();
  parts_->frame.store(frame);
  while (parts_->send_piece()) {
  }
  parts_->for_thread.ring();
}

void MasterLink::swap(std::uint64_t number) {
  parts_->swap.store({.header = {.session = parts_->session, .number = number}});
  parts_->for_thread.ring();
}

void MasterLink::record(const JournalRecord& record) {
  if (parts_->records.push(record)) ++parts_->recorded;
}

std::uint64_t MasterLink::recorded() const { return parts_->recorded; }

void MasterLink::send_history(std::span<const std::byte> history) {
  parts_->pieces = pieces_of(history, {.session = parts_->session, .number = ++parts_->documents});
  parts_->next_piece = 0;
}

bool MasterLink::sending_history() const { return parts_->next_piece < parts_->pieces.size(); }

std::optional<MasterLink::Answer> MasterLink::answer() { return parts_->answers.pop(); }

void MasterLink::wait(int timeout_ms) { parts_->for_frames.wait(timeout_ms); }

MasterLink::Rival MasterLink::rival() const { return parts_->rival.load(std::memory_order_relaxed); }

std::uint64_t MasterLink::refused() const { return parts_->refused.load(std::memory_order_relaxed); }

std::uint64_t MasterLink::lost() const {
  return parts_->records.dropped() + parts_->unwritten.load(std::memory_order_relaxed);
}

std::uint64_t MasterLink::resent_bytes() const { return parts_->resent.load(std::memory_order_relaxed); }

}  // namespace afm::cluster
