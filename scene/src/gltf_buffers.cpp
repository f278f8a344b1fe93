// SPDX-License-Identifier: Apache-2.0
#include "gltf_buffers.h"

#include <fmt/core.h>
#include <meshoptimizer.h>

#include "gltf_fault.h"

namespace afm::scene {
namespace {

constexpr std::uint64_t kMostDecompressedBytes = 256ULL << 20U;

enum class Mode { Attributes, Triangles, Indices };
enum class Filter { None, Octahedral, Quaternion, Exponential };

Mode mode_of(const JsonElement& compression) {
  const std::string mode = compression.required_text("mode");
  if (mode == "ATTRIBUTES") return Mode::Attributes;
  if (mode == "TRIANGLES") return Mode::Triangles;
  if (mode == "INDICES") return Mode::Indices;
  compression.fail("has a mode that EXT_meshopt_compression does not know");
}

Filter filter_of(const JsonElement& compression) {
  const std::string filter = compression.text("filter", "NONE");
  if (filter == "NONE") return Filter::None;
  if (filter == "OCTAHEDRAL") return Filter::Octahedral;
  if (filter == "QUATERNION") return Filter::Quaternion;
  if (filter == "EXPONENTIAL") return Filter::Exponential;
  compression.fail("has a filter that EXT_meshopt_compression does not know");
}

// What the extension demands of a stream, and the decoder relies on.
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

}  // namespace

GltfBuffers::GltfBuffers(GltfFile& file, const JsonElement& root) {
  read_buffers(file, root);
  for (const JsonElement& view : root.objects("bufferViews")) views_.push_back(read_view(view));
}

void GltfBuffers::read_buffers(GltfFile& file, const JsonElement& root) {
  for (const JsonElement& element : root.objects("buffers")) {
    const std::uint64_t length = element.required_size("byteLength", kLargestGltfBytes);
    auto& buffer = buffers_.emplace_back();
    if (element.has("uri")) {
      buffer = owned_.emplace_back(file.side_files.read(element.required_text("uri")));
    } else if (buffers_.size() == 1) {
      buffer = file.binary;
    }
    if (!buffer) continue;
    if (buffer->size() < length) {
      element.fail(fmt::format("says {} bytes but there are {}", length, buffer->size()));
    }
    buffer = buffer->first(length);
  }
}

// The bytes that an element with buffer, byteOffset and byteLength names.
std::span<const std::uint8_t> GltfBuffers::range(const JsonElement& element) const {
  const auto& buffer = buffers_[element.required_index("buffer", buffers_.size())];
  if (!buffer) element.fail("refers to a buffer without data");
  const std::uint64_t offset = element.size("byteOffset", 0, kLargestGltfBytes);
  const std::uint64_t length = element.required_size("byteLength", kLargestGltfBytes);
  if (length == 0) element.fail("is empty");
  if (offset > buffer->size() || length > buffer->size() - offset) element.fail("reaches past the end of its buffer");
  return buffer->subspan(offset, length);
}

BufferView GltfBuffers::read_view(const JsonElement& element) {
  BufferView view;
  view.stride = element.size("byteStride", 0, 252);
  if (element.has("byteStride") && (view.stride < 4 || view.stride % 4 != 0)) {
    element.fail("has a byteStride that is not a multiple of 4 from 4 to 252");
  }
  if (const auto compression = element.extension("EXT_meshopt_compression")) return decompress(element, *compression);
  view.bytes = range(element);
  return view;
}

BufferView GltfBuffers::decompress(const JsonElement& view, const JsonElement& compression) {
  const std::span<const std::uint8_t> source = range(compression);
  const std::uint64_t count = compression.required_size("count", kMostDecompressedBytes);
  const std::uint64_t stride = compression.required_size("byteStride", 256);
  const Mode mode = mode_of(compression);
  const Filter filter = filter_of(compression);
  if (count == 0 || !is_consistent(mode, filter, count, stride) ||
      view.required_size("byteLength", kLargestGltfBytes) != count * stride) {
    compression.fail("has a count, a byteStride and a filter that do not fit together");
  }
  decompressed_bytes_ += count * stride;
  if (decompressed_bytes_ > kMostDecompressedBytes) {
    view.fail(fmt::format("makes more than {} MiB of compressed data; make it smaller", kMostDecompressedBytes >> 20U));
  }
  auto& bytes = owned_.emplace_back(count * stride);
  const int fault = mode == Mode::Attributes
                        ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, source.data(), source.size())
                    : mode == Mode::Triangles
                        ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, source.data(), source.size())
                        : meshopt_decodeIndexSequence(bytes.data(), count, stride, source.data(), source.size());
  if (fault != 0) compression.fail("holds a compressed stream that is broken");
  undo(filter, bytes, count, stride);
  return {bytes, mode == Mode::Attributes ? stride : 0};
}

}  // namespace afm::scene
