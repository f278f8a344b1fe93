// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cluster/messages.h"

namespace afm::cluster {

// The pieces of a document; `header.number` names it among those of the session.
std::vector<DocumentPiece> pieces_of(std::span<const std::byte> document, const ClusterHeader& header);

// Puts documents together again. Pieces of an earlier document of the session, or for which there is no room, are
// ignored; those of a later one, or of another session, replace it.
class DocumentReader {
 public:
  // The document, once its last piece has come.
  std::optional<std::vector<std::byte>> add(const DocumentPiece& piece);

  // Of the document that is read.
  const ClusterHeader& header() const { return header_; }

 private:
  ClusterHeader header_{};
  std::vector<std::byte> bytes_;
  std::vector<bool> came_;
  std::size_t left_ = 0;
};

}  // namespace afm::cluster
