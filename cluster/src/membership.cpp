// SPDX-License-Identifier: Apache-2.0
#include "cluster/membership.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace afm::cluster {

Membership::Membership(std::vector<std::string> names) : sent_(kRemembered) {
  nodes_.resize(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) nodes_[i].name = std::move(names[i]);
  lines_.reserve(4 * nodes_.size());
}

std::int64_t Membership::Sent::patience_ns(std::int64_t least_ns) const {
  return std::clamp(drawn_ns - begun_ns, least_ns, kMostTimes * least_ns);
}

void Membership::begin(std::uint64_t number, std::uint64_t digest, std::int64_t now_ns) {
  number_ = number;
  sent_[number % kRemembered] = {.number = number, .digest = digest, .begun_ns = now_ns};
  for (Node& node : nodes_) node.ready = false;
}

void Membership::drawn(std::int64_t now_ns) { sent_[number_ % kRemembered].drawn_ns = now_ns; }

const Membership::Sent* Membership::sent(std::uint64_t number) const {
  const Sent& slot = sent_[number % kRemembered];
  return number != 0 && slot.number == number ? &slot : nullptr;
}

// Counts the answers of a node that is not awaited: they arrive after the frame was shown, and may skip frames.
void Membership::count_in_time(Node& node, const Sent& frame, std::int64_t came_ns) {
  const bool in_time = frame.drawn_ns == 0 || came_ns - frame.drawn_ns <= frame.patience_ns(kPatienceNs);
  node.in_time = in_time ? node.in_time + 1 : 0;
  if (node.in_time < kLeastInTime) return;
  node.awaited = true;
  node.in_time = node.missed = 0;
  lines_.push_back(fmt::format("cluster: node {} shows the wall", node.name));
}

void Membership::answer(const ReadyMessage& ready, std::int64_t came_ns) {
  if (ready.header.node >= nodes_.size()) return;
  Node& node = nodes_[ready.header.node];
  if (std::exchange(node.state, ready.state) != ready.state || !node.heard) {
    if (ready.state == NodeState::OtherBuild) {
      lines_.push_back(fmt::format("cluster: node {} was refused: it is another build, {:016x}; install the same one",
                                   node.name, ready.digest));
    }
    if (ready.state == NodeState::OtherScene) {
      lines_.push_back(
          fmt::format("cluster: node {} was refused: it has other models, {:016x}", node.name, ready.digest));
    }
  }
  node.heard = true;
  node.newest = ready;
  if (ready.state != NodeState::Drawing) return;
  const std::uint64_t number = ready.header.number;
  const Sent* frame = sent(number);
  if (frame == nullptr || number <= node.last_ready) return;
  if (frame->digest != ready.digest && node.other_frames++ == 0) {
    lines_.push_back(fmt::format("cluster: node {} built frame {} otherwise: {:016x} there, {:016x} here", node.name,
                                 number, ready.digest, frame->digest));
  }
  if (number == number_) node.ready = true;
  if (!node.awaited) count_in_time(node, *frame, came_ns);
  node.last_ready = number;
}

bool Membership::complete(std::int64_t now_ns) const {
  const Sent& frame = sent_[number_ % kRemembered];
  const std::int64_t waited_ns = now_ns - frame.drawn_ns;
  return std::all_of(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return !node.awaited || node.ready ||
           waited_ns >= frame.patience_ns(node.missed == 0 ? kPatienceNs : kShortPatienceNs);
  });
}

std::vector<std::string> Membership::end() {
  for (Node& node : nodes_) {
    if (!node.awaited) continue;
    if (node.ready) {
      node.missed = 0;
      continue;
    }
    ++node.timeouts;
    if (++node.missed < kMostMissed) continue;
    node.awaited = false;
    node.missed = node.in_time = 0;
    lines_.push_back(fmt::format("cluster: node {} is missing: {} frames without it", node.name, kMostMissed));
  }
  return std::exchange(lines_, {});
}

std::uint64_t Membership::missing() const {
  std::uint64_t mask = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i].awaited) mask |= std::uint64_t{1} << i;
  }
  return mask;
}

}  // namespace afm::cluster
