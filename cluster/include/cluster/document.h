// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cluster/messages.h"

namespace afm::cluster {

// Pieces of a document; `header.number` identifies it within the session.
std::vector<DocumentPiece> pieces_of(std::span<const std::byte> document, const ClusterHeader& header);

// Reassembles documents. Ignores pieces of an earlier document of the session, and pieces without room; pieces of a
// later document or of another session replace it.
class DocumentReader {
 public:
  // Returns the document after its last piece.
  std::optional<std::vector<std::byte>> add(const DocumentPiece& piece);

  // Header of the document being received.
  const ClusterHeader& header() const { return header_; }

 private:
  ClusterHeader header_{};
  std::vector<std::byte> bytes_;
  std::vector<bool> came_;
  std::size_t left_ = 0;
};

}  // namespace afm::cluster
