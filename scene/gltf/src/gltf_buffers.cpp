// SPDX-License-Identifier: Apache-2.0
#include "gltf_buffers.h"

#include <fmt/core.h>
#include <meshoptimizer.h>

#include "gltf_error.h"

namespace afm::scene {
namespace {

constexpr std::uint64_t kMostDecompressedBytes = 256ULL << 20U;

enum class Mode { Attributes, Triangles, Indices };
enum class Filter { None, Octahedral, Quaternion, Exponential };

Mode mode_of(const std::string& mode) {
  if (mode == "ATTRIBUTES") return Mode::Attributes;
  return mode == "TRIANGLES" ? Mode::Triangles : Mode::Indices;
}

Filter filter_of(const std::string& filter) {
  if (filter == "OCTAHEDRAL") return Filter::Octahedral;
  if (filter == "QUATERNION") return Filter::Quaternion;
  return filter == "EXPONENTIAL" ? Filter::Exponential : Filter::None;
}

// Checks the extension's requirements on a stream, which the decoder relies on.
bool is_consistent(Mode mode, Filter filter, std::uint64_t count, std::uint64_t stride) {
  if (mode != Mode::Attributes) {
    return (stride == 2 || stride == 4) && filter == Filter::None && (mode != Mode::Triangles || count % 3 == 0);
  }
  if (stride == 0 || stride % 4 != 0 || stride > 256) return false;
  if (filter == Filter::Octahedral) return stride == 4 || stride == 8;
  return filter != Filter::Quaternion || stride == 8;
}

void undo(Filter filter, std::vector<std::uint8_t>& bytes, std::size_t count, std::size_t stride) {
  switch (filter) {
    case Filter::None:
      break;
    case Filter::Octahedral:
      meshopt_decodeFilterOct(bytes.data(), count, stride);
      break;
    case Filter::Quaternion:
      meshopt_decodeFilterQuat(bytes.data(), count, stride);
      break;
    case Filter::Exponential:
      meshopt_decodeFilterExp(bytes.data(), count, stride);
      break;
  }
}

[[noreturn]] void fail(std::size_t view, const char* reason) {
  throw GltfError(fmt::format("/bufferViews/{} {}", view, reason));
}

std::span<const std::uint8_t> range(const tinygltf::Model& model, std::size_t view, std::size_t buffer,
                                    std::uint64_t offset, std::uint64_t length) {
  const std::span<const std::uint8_t> bytes(model.buffers[buffer].data);
  if (bytes.empty()) fail(view, "refers to a buffer without data");
  if (offset > bytes.size() || length > bytes.size() - offset) fail(view, "reaches past the end of its buffer");
  return bytes.subspan(offset, length);
}

}  // namespace

GltfBuffers::GltfBuffers(const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = model.bufferViews[i];
    if (view.byteLength == 0) {
      views_.emplace_back();  // empty view, refused where it is used
    } else if (const auto* compression = find_extension(view.extensions, "EXT_meshopt_compression")) {
      views_.push_back(decompress(model, i, *compression));
    } else {
      const auto bytes = range(model, i, static_cast<std::size_t>(view.buffer), view.byteOffset, view.byteLength);
      views_.push_back({bytes, view.byteStride});
    }
  }
}

BufferView GltfBuffers::decompress(const tinygltf::Model& model, std::size_t view, const tinygltf::Value& compression) {
  const auto size = [&](const char* key) { return static_cast<std::uint64_t>(number_or(compression, key, 0)); };
  const auto source = range(model, view, size("buffer"), size("byteOffset"), size("byteLength"));
  const std::uint64_t count = size("count"), stride = size("byteStride");
  const Mode mode = mode_of(text_or(compression, "mode", ""));
  const Filter filter = filter_of(text_or(compression, "filter", ""));
  if (!is_consistent(mode, filter, count, stride) || model.bufferViews[view].byteLength != count * stride) {
    fail(view, "has an inconsistent count, byteStride and filter of EXT_meshopt_compression");
  }
  decompressed_bytes_ += count * stride;
  if (decompressed_bytes_ > kMostDecompressedBytes) {
    throw GltfError(fmt::format("its compressed buffer views expand to more than {} MiB; make it smaller",
                                kMostDecompressedBytes >> 20U));
  }
  auto& bytes = decompressed_.emplace_back(count * stride);
  const int fault = mode == Mode::Attributes
                        ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, source.data(), source.size())
                    : mode == Mode::Triangles
                        ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, source.data(), source.size())
                        : meshopt_decodeIndexSequence(bytes.data(), count, stride, source.data(), source.size());
  if (fault != 0) fail(view, "contains a corrupt compressed stream");
  undo(filter, bytes, count, stride);
  return {bytes, mode == Mode::Attributes ? stride : 0};
}

}  // namespace afm::scene
