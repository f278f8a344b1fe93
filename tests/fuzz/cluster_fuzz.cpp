// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cluster/document.h"
#include "cluster/frame_message.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/cluster/wall_history.h"
#include "exhibit/cluster/wall_model.h"
#include "fuzz/accepted.h"

namespace {

using namespace afm::exhibit;
using namespace afm::cluster;

// An accepted message is equal to the received bytes, and everything derived from it can be computed.
template <class Message>
bool take(std::span<const std::byte> datagram) {
  const auto message = decode<Message>(datagram);
  if (!message) return false;
  const auto again = encode(*message);
  if (!std::equal(again.begin(), again.end(), datagram.begin(), datagram.end())) std::abort();
  if constexpr (std::is_same_v<Message, FrameMessage>) {
    const Moment moment = moment_of(*message);
    if (!std::isfinite(moment.wall.navigation[3][3]) || caption_of(*message).size() > ShownTexts::kBytes) std::abort();
  }
  if constexpr (std::is_same_v<Message, JournalBatch>) {
    WallHistory history(3);
    for (std::uint32_t i = 0; i < message->count; ++i) {
      if (is_applicable(message->records[i])) history.apply(message->records[i]);
    }
    const auto document = save_history(history.journal, history.cycles, history.friction, history.edits, history.scan,
                                       history.pages, history.push, history.score, history.plan, history.tiles);
    if (!load_history(document, 3)) std::abort();
  }
  if constexpr (std::is_same_v<Message, DocumentPiece>) {
    DocumentReader reader;
    reader.add(*message);
  }
  return true;
}

}  // namespace

// The first byte chooses the topic; then whatever comes from the network.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const auto datagram = std::as_bytes(std::span(bytes + 1, size - 1));
  bool taken = false;
  switch (bytes[0] % 7) {
    case 0:
      taken = take<FrameMessage>(datagram);
      break;
    case 1:
      taken = take<JournalBatch>(datagram);
      break;
    case 2:
      taken = take<DocumentPiece>(datagram);
      break;
    case 3:
      taken = take<ReadyMessage>(datagram);
      break;
    case 4:
      taken = take<SwapMessage>(datagram);
      break;
    case 5:
      taken = load_history(datagram, 3).has_value();
      break;
    default:
      taken = read_wall_model(datagram).has_value();
  }
  if (taken) ++afm::fuzz::accepted_inputs;
  return 0;
}
