// SPDX-License-Identifier: Apache-2.0
#include "gltf_file.h"

#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace afm::scene {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

tl::unexpected<core::Error> refused(std::string reason) {
  return core::failure(core::ErrorCategory::BadInputFile, std::move(reason));
}

// The whole of a plain file of at most `most_bytes`.
core::Result<Bytes> read_plain_file(const fs::path& path, std::uint64_t most_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return refused("there is no such file; check the path");
  if (!fs::is_regular_file(status)) return refused("it is not a plain file; give the path of a .glb or .gltf file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return refused(fmt::format("its size cannot be read ({}); check the path", error.message()));
  if (size > most_bytes) {
    return refused(fmt::format("it has {} MiB and {} MiB are left of the {} MiB that a model may take; make it smaller",
                               size >> 20U, most_bytes >> 20U, kLargestGltfBytes >> 20U));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return refused(fmt::format("it cannot be opened ({}); check its permissions", std::strerror(errno)));
  Bytes bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (file.gcount() != static_cast<std::streamsize>(size))
    return refused("it cannot be read to its end; copy it again");
  return bytes;
}

// Looks at the JSON text as a stream of tokens, in constant memory, for what tinygltf's model no longer shows.
class TextScan : public nlohmann::json_sax<Json> {
 public:
  const std::string& complaint() const { return complaint_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool start_object(std::size_t) override { return enter(); }
  bool start_array(std::size_t) override { return enter(); }

  bool key(string_t& name) override {
    key_ = name;
    if (depth_ == 1) section_ = name;
    return true;
  }

  bool number_integer(number_integer_t value) override {
    const bool is_size = depth_ == 3 && (section_ == "accessors" || section_ == "bufferViews") &&
                         (key_ == "byteOffset" || key_ == "byteLength" || key_ == "byteStride" || key_ == "count");
    return !is_size || complain(fmt::format("'{}' is {}, a negative size; export it again", key_, value));
  }

  // each buffer is copied before its length can be compared with anything
  bool number_unsigned(number_unsigned_t value) override {
    if (section_ != "buffers" || depth_ != 3 || key_ != "byteLength") return true;
    if (value > kLargestGltfBytes - buffer_bytes_) {
      return complain(fmt::format("its buffers are longer than {} MiB; make it smaller", kLargestGltfBytes >> 20U));
    }
    buffer_bytes_ += value;
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
    return complain(fmt::format("its JSON is broken at byte {}; export it again", position));
  }

 private:
  static constexpr int kDeepestNesting = 64;

  bool enter() {
    return ++depth_ <= kDeepestNesting ||
           complain(fmt::format("its JSON is nested deeper than {} levels; export it again", kDeepestNesting));
  }
  bool leave() {
    --depth_;
    return true;
  }
  bool complain(std::string text) {
    if (complaint_.empty()) complaint_ = std::move(text);
    return false;
  }

  int depth_ = 0;
  std::uint64_t buffer_bytes_ = 0;
  std::string key_, section_, complaint_;
};

std::uint32_t little_endian(const Bytes& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8U * i);
  return value;
}

bool is_binary(const Bytes& bytes) { return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0; }

// The JSON chunk of a binary glTF file whose header and chunks agree with its size (glTF 2.0, section 4.4).
core::Result<std::string_view> json_chunk(const Bytes& bytes) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  constexpr std::uint32_t kJson = 0x4E4F534A;
  if (bytes.size() < kHeader + kChunkHeader) return refused("it ends inside its header; copy it again");
  if (const std::uint32_t version = little_endian(bytes, 4); version != 2) {
    return refused(fmt::format("it is binary glTF of version {}, not 2; export it as glTF 2.0", version));
  }
  if (little_endian(bytes, 8) != bytes.size()) {
    return refused(
        fmt::format("its header says {} bytes but it has {}; copy it again", little_endian(bytes, 8), bytes.size()));
  }
  std::string_view json;
  for (std::size_t offset = kHeader; offset < bytes.size();) {
    if (bytes.size() - offset < kChunkHeader) return refused("a chunk ends inside its header; copy it again");
    const std::uint32_t length = little_endian(bytes, offset);
    const std::uint32_t type = little_endian(bytes, offset + 4);
    if (length > bytes.size() - offset - kChunkHeader) return refused("a chunk reaches past its end; copy it again");
    if (offset == kHeader) {
      if (type != kJson) return refused("its first chunk is not JSON; export it again");
      json = {reinterpret_cast<const char*>(bytes.data()) + offset + kChunkHeader, length};
    }
    offset += kChunkHeader + length;
  }
  return json;
}

// What tinygltf may read beside the model: plain files in its folder or below, no links that lead out of it.
struct SideFiles {
  fs::path folder;
  std::uint64_t bytes_left = 0;

  std::optional<fs::path> resolve(const std::string& uri) const {
    const fs::path relative(uri);
    if (uri.empty() || relative.is_absolute() || uri.find('\0') != std::string::npos) return std::nullopt;
    for (const fs::path& part : relative) {
      if (part == "..") return std::nullopt;
    }
    std::error_code error;
    const fs::path root = fs::canonical(folder, error);
    if (error) return std::nullopt;
    fs::path file = fs::canonical(root / relative, error);
    if (error || !fs::is_regular_file(file, error)) return std::nullopt;
    const fs::path inside = file.lexically_relative(root);
    if (inside.empty() || *inside.begin() == "..") return std::nullopt;
    return file;
  }
};

bool side_file_exists(const std::string& uri, void* user) {
  return static_cast<const SideFiles*>(user)->resolve(uri).has_value();
}

std::string keep_path(const std::string& uri, void*) { return uri; }

bool read_side_file(std::vector<unsigned char>* out, std::string* error, const std::string& uri, void* user) {
  auto& side_files = *static_cast<SideFiles*>(user);
  const std::optional<fs::path> file = side_files.resolve(uri);
  core::Result<Bytes> bytes = file ? read_plain_file(*file, side_files.bytes_left) : refused("it has left the folder");
  if (!bytes) {
    if (error != nullptr) *error += bytes.error().message;
    return false;
  }
  side_files.bytes_left -= bytes->size();
  *out = std::move(*bytes);
  return true;
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

// Textures are not used, so no decoder ever sees a stranger's image.
bool skip_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

// tinygltf writes sentences over several lines.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, std::min<std::size_t>(text.find('\n'), 160));
  return line.empty() ? std::string("no reason given") : line;
}

core::Result<tinygltf::Model> parse(const Bytes& bytes, SideFiles& side_files) {
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({side_file_exists, keep_path, read_side_file, write_nothing, &side_files});
  parser.SetImageLoader(skip_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  bool parsed = false;
  try {
    parsed = is_binary(bytes) ? parser.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size)
                              : parser.LoadASCIIFromString(&model, &error, &warning,
                                                           reinterpret_cast<const char*>(bytes.data()), size, "");
  } catch (const std::exception& exception) {
    error = exception.what();
  }

  // it drops primitives that it cannot read and says so only here
  if (!parsed || !error.empty()) {
    return refused(fmt::format("the glTF parser says \"{}\"; correct the file or export it again", first_line(error)));
  }
  if (model.asset.version.rfind("2.", 0) != 0 || (!model.asset.minVersion.empty() && model.asset.minVersion != "2.0")) {
    return refused(fmt::format("it is glTF of version '{}'; export it as glTF 2.0", model.asset.version));
  }
  return model;
}

}  // namespace

core::Result<tinygltf::Model> read_gltf_file(const std::string& path) {
  const core::Result<Bytes> bytes = read_plain_file(path, kLargestGltfBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return refused("it is empty; export it again");

  const core::Result<std::string_view> json =
      is_binary(*bytes) ? json_chunk(*bytes)
                        : std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (!json) return tl::unexpected(json.error());
  TextScan scan;
  if (!Json::sax_parse(json->begin(), json->end(), &scan)) return refused(scan.complaint());

  SideFiles side_files{fs::path(path).parent_path(), kLargestGltfBytes - bytes->size()};
  if (side_files.folder.empty()) side_files.folder = ".";
  return parse(*bytes, side_files);
}

}  // namespace afm::scene
