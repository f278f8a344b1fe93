// SPDX-License-Identifier: Apache-2.0
#include "cluster/document.h"

#include <algorithm>
#include <utility>

#include "core/check.h"

namespace afm::cluster {

std::vector<DocumentPiece> pieces_of(std::span<const std::byte> document, const ClusterHeader& header) {
  AFM_CHECK(!document.empty() && document.size() <= kMostDocumentBytes);
  std::vector<DocumentPiece> pieces;
  for (std::size_t at = 0; at < document.size(); at += DocumentPiece::kBytes) {
    DocumentPiece& piece = pieces.emplace_back();
    piece.header = header;
    piece.index = static_cast<std::uint32_t>(pieces.size() - 1);
    piece.total_bytes = static_cast<std::uint32_t>(document.size());
    const auto part = document.subspan(at, std::min(DocumentPiece::kBytes, document.size() - at));
    std::copy(part.begin(), part.end(), piece.bytes.begin());
  }
  return pieces;
}

std::optional<std::vector<std::byte>> DocumentReader::add(const DocumentPiece& piece) {
  const std::size_t pieces = (piece.total_bytes + DocumentPiece::kBytes - 1) / DocumentPiece::kBytes;
  const bool same = piece.header.session == header_.session && piece.header.number == header_.number &&
                    piece.total_bytes == bytes_.size();
  if (!same) {
    if (piece.header.session == header_.session && piece.header.number <= header_.number) return std::nullopt;
    header_ = piece.header;
    bytes_.assign(piece.total_bytes, std::byte{0});
    came_.assign(pieces, false);
    left_ = pieces;
  }
  if (left_ == 0 || came_[piece.index]) return std::nullopt;
  came_[piece.index] = true;
  const std::size_t at = piece.index * DocumentPiece::kBytes;
  std::copy_n(piece.bytes.begin(), std::min(DocumentPiece::kBytes, bytes_.size() - at),
              bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  if (--left_ > 0) return std::nullopt;
  return bytes_;
}

}  // namespace afm::cluster
