// SPDX-License-Identifier: Apache-2.0
#include "cluster/node_link.h"

#include <pthread.h>

#include <atomic>
#include <thread>
#include <utility>

#include "cluster/document.h"
#include "core/latest_value.h"
#include "core/spsc_ring.h"
#include "transport.h"

namespace afm::cluster {

namespace {

constexpr int kPauseMs = 100;  // interval at which the thread checks for its end

}  // namespace

struct NodeLink::Parts {
  explicit Parts(const core::Clock& of_program) : clock(of_program) {}

  void run(const std::stop_token& stop);
  void take();

  template <class Message>
  void take(Transport::Topic topic, const std::function<void(const Message&)>& each) {
    transport->take(topic, [&](std::span<const std::byte> datagram) {
      if (const auto message = decode<Message>(datagram)) {
        each(*message);
      } else {
        refused.fetch_add(1, std::memory_order_relaxed);
      }
    });
  }

  // Reassembles the received pieces of a document; main thread only.
  static std::optional<Document> read(core::SpscRing<DocumentPiece, 2048>& pieces, DocumentReader& reader);

  const core::Clock& clock;
  Doorbell for_thread, for_frames;
  std::unique_ptr<Transport> transport;  // used by the thread only

  // newest frame, from the thread to the main thread
  core::LatestValue<Came> frame;
  core::LatestValue<SwapMessage> swap;
  core::SpscRing<Numbered, 16384> records;
  core::SpscRing<DocumentPiece, 2048> model, history;
  std::atomic<std::uint64_t> refused{0};
  // newest answer, from the main thread to the thread
  core::LatestValue<ReadyMessage> answer;

  // main thread only
  DocumentReader model_reader, history_reader;
  std::uint64_t seen_frame = 0;
  // thread only
  std::uint64_t seen_answer = 0;

  std::jthread thread;  // last member: it ends before the members it uses
};

void NodeLink::Parts::run(const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), kThreadName);
  transport->belong_to_this_thread();
  while (!stop.stop_requested()) {
    for_thread.wait(kPauseMs);
    if (const auto newest = answer.try_load_newer(seen_answer)) {
      transport->write(Transport::Topic::Ready, newest->header.node, encode(*newest));
    }
    take();
  }
}

void NodeLink::Parts::take() {
  bool came = false;
  take<SwapMessage>(Transport::Topic::Swap, [&](const SwapMessage& message) {
    swap.store(message);
    came = true;
  });
  take<JournalBatch>(Transport::Topic::Journal, [&](const JournalBatch& batch) {
    for (std::uint32_t i = 0; i < batch.count; ++i)
      records.push({batch.header.session, batch.header.number + i, batch.records[i]});
    came = true;
  });
  take<FrameMessage>(Transport::Topic::Frame, [&](const FrameMessage& message) {
    frame.store({message, clock.now_ns()});
    came = true;
  });
  take<DocumentPiece>(Transport::Topic::Model, [&](const DocumentPiece& piece) {
    model.push(piece);
    came = true;
  });
  take<DocumentPiece>(Transport::Topic::History, [&](const DocumentPiece& piece) {
    history.push(piece);
    came = true;
  });
  if (came) for_frames.ring();
}

std::optional<NodeLink::Document> NodeLink::Parts::read(core::SpscRing<DocumentPiece, 2048>& pieces,
                                                        DocumentReader& reader) {
  std::optional<Document> newest;
  while (const auto piece = pieces.pop()) {
    if (auto whole = reader.add(*piece)) newest = Document{reader.header(), std::move(*whole)};
  }
  return newest;
}

NodeLink::NodeLink(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
NodeLink::~NodeLink() = default;

core::Result<std::unique_ptr<NodeLink>> NodeLink::open(const ClusterNetwork& network, const core::Clock& clock) {
  auto parts = std::make_unique<Parts>(clock);
  for (Doorbell* bell : {&parts->for_thread, &parts->for_frames}) {
    auto created = Doorbell::create();
    if (!created) return tl::unexpected(created.error());
    *bell = std::move(*created);
  }
  auto transport = Transport::open(network, ClusterRole::Node, parts->for_thread);
  if (!transport) return tl::unexpected(transport.error());
  parts->transport = std::move(*transport);
  Parts& running = *parts;
  parts->thread = std::jthread([&running](const std::stop_token& stop) { running.run(stop); });
  return std::unique_ptr<NodeLink>(new NodeLink(std::move(parts)));
}

std::optional<NodeLink::Came> NodeLink::frame() { return parts_->frame.try_load_newer(parts_->seen_frame); }

std::pair<std::uint64_t, std::uint64_t> NodeLink::swapped() const {
  const auto newest = parts_->swap.load();
  return newest ? std::pair(newest->header.session, newest->header.number) : std::pair<std::uint64_t, std::uint64_t>();
}

std::optional<NodeLink::Numbered> NodeLink::record() { return parts_->records.pop(); }

std::optional<NodeLink::Document> NodeLink::model() { return Parts::read(parts_->model, parts_->model_reader); }

std::optional<NodeLink::Document> NodeLink::history() { return Parts::read(parts_->history, parts_->history_reader); }

void NodeLink::answer(ReadyMessage ready) {
  ready.header.version = kClusterVersion;
  ready.ready_sent_ns = parts_->clock.now_ns();
  parts_->answer.store(ready);
  parts_->for_thread.ring();
}

void NodeLink::wait(int timeout_ms) { parts_->for_frames.wait(timeout_ms); }

std::uint64_t NodeLink::refused() const { return parts_->refused.load(std::memory_order_relaxed); }

}  // namespace afm::cluster
