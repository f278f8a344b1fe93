// SPDX-License-Identifier: Apache-2.0
#include "gltf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/system_error.h"
#include "foreign_file.h"
#include "gltf_error.h"
#include "gltf_uri.h"

namespace afm::scene {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestNesting = 64;
// Limit on the values in the text; each takes up to about a hundred bytes in a tree.
constexpr std::uint64_t kMostValues = 4'000'000;

// Reads a plain file of at most `most_bytes`.
Bytes read_plain_file(const fs::path& path, std::uint64_t most_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw GltfError("there is no such file; check the path");
  if (!fs::is_regular_file(status))
    throw GltfError("it is not a regular file; give the path of a file, not of a folder");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw GltfError(fmt::format("cannot read its size ({}); check the path", error.message()));
  if (size > most_bytes) {
    throw GltfError(fmt::format("it has {} MiB, but only {} MiB of the model limit of {} MiB remain; make it smaller",
                                size >> 20U, most_bytes >> 20U, kLargestGltfBytes >> 20U));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw GltfError(fmt::format("cannot open it ({}); check its permissions", core::system_error(errno)));
  Bytes bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (file.gcount() != static_cast<std::streamsize>(size)) {
    throw GltfError("cannot read it to the end; copy it again");
  }
  return bytes;
}

// Scans the text once, in constant memory, before a tree is built from it.
void check_text(std::string_view text) {
  int depth = 0;
  std::uint64_t values = 1;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (in_string) {
      if (letter == '\\') ++i;
      if (letter == '"') in_string = false;
      continue;
    }
    in_string = letter == '"';
    if (letter == ',') ++values;
    if (letter == ']' || letter == '}') --depth;
    if (letter != '[' && letter != '{') continue;
    ++values;
    if (++depth > kDeepestNesting) {
      throw GltfError(fmt::format("its JSON is nested deeper than {} levels; export it again", kDeepestNesting));
    }
  }
  if (values > kMostValues) {
    throw GltfError(fmt::format("its JSON has more than {} values; make it smaller", kMostValues));
  }
}

// Removes nulls, which some exporters write for a member without a value. Other viewers ignore them. Extras stay.
void leave_out_nulls(Json& value) {
  if (value.is_object()) {
    for (auto member = value.begin(); member != value.end();) {
      if (member->is_null()) {
        member = value.erase(member);
        continue;
      }
      if (member.key() != "extras") leave_out_nulls(*member);
      ++member;
    }
  } else if (value.is_array()) {
    for (Json& element : value) leave_out_nulls(element);
  }
}

// A glTF text is one JSON object, so that its first letter distinguishes it from other texts.
void check_beginning(std::string_view text) {
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
  if (text.substr(0, kUtf8Mark.size()) == kUtf8Mark) text.remove_prefix(kUtf8Mark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) throw GltfError("it has only blanks; export it again");
  if (text[first] == '{' || text[first] == '[') return;
  const std::string_view beginning = text.substr(first, 12);
  throw GltfError(fmt::format(
      "it is not glTF: it begins with '{}', neither with '{{' nor with the header of a .glb; export glTF 2.0 (.glb) "
      "from the program that made it",
      beginning.substr(0, beginning.find_first_of("\r\n"))));
}

Json parse_text(std::string_view text) {
  check_beginning(text);
  check_text(text);
  try {
    Json document = Json::parse(text.begin(), text.end());
    leave_out_nulls(document);
    return document;
  } catch (const Json::parse_error& error) {
    throw GltfError(fmt::format("its JSON is invalid at byte {}; export it again", error.byte));
  } catch (const Json::exception&) {  // number too large for a double
    throw GltfError("its JSON is invalid: a number is out of range; export it again");
  }
}

std::uint32_t little_endian(const Bytes& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8U * i);
  return value;
}

bool is_binary(const Bytes& bytes) { return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0; }

struct Chunks {
  std::string_view text;
  std::optional<std::pair<std::size_t, std::size_t>> binary;  // offset and length of the binary chunk
};

// Chunks of a binary glTF file whose header agrees with its size (glTF 2.0, section 4.4).
Chunks split(const Bytes& bytes) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  if (bytes.size() < kHeader + kChunkHeader) throw GltfError("it ends inside its header; copy it again");
  if (const std::uint32_t version = little_endian(bytes, 4); version != 2) {
    throw GltfError(fmt::format("it is binary glTF of version {}, not 2; export it as glTF 2.0", version));
  }
  // bytes behind the announced end are ignored, as other readers do
  const std::size_t end = little_endian(bytes, 8);
  if (end < kHeader + kChunkHeader) throw GltfError(fmt::format("its header announces {} bytes; export it again", end));
  const std::string disagreement =
      end == bytes.size() ? "" : fmt::format("its header announces {} bytes but it has {}: ", end, bytes.size());
  if (end > bytes.size()) throw GltfError(disagreement + "it is cut off; copy it again");
  Chunks chunks;
  int chunk = 0;
  for (std::size_t offset = kHeader; offset < end; ++chunk) {
    if (end - offset < kChunkHeader) throw GltfError(disagreement + "a chunk ends inside its header; copy it again");
    const std::uint32_t length = little_endian(bytes, offset);
    const std::uint32_t type = little_endian(bytes, offset + 4);
    offset += kChunkHeader;
    if (length > end - offset) throw GltfError(disagreement + "a chunk extends past its end; copy it again");
    if (chunk == 0 && type != kJson) throw GltfError("its first chunk is not JSON; export it again");
    if (chunk == 0) chunks.text = {reinterpret_cast<const char*>(bytes.data()) + offset, length};
    if (chunk == 1 && type == kBinary) chunks.binary.emplace(offset, length);
    offset += length;
  }
  return chunks;
}

// Name with slashes, for programs on Windows, which write backslashes.
std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

}  // namespace

std::optional<fs::path> SideFiles::resolve(const std::string& uri) const {
  const fs::path relative(uri);
  if (uri.empty() || relative.is_absolute() || uri.find('\0') != std::string::npos) return std::nullopt;
  for (const fs::path& part : relative) {
    if (part == "..") return std::nullopt;
  }
  std::error_code error;
  const fs::path root = fs::canonical(folder_, error);
  if (error) return std::nullopt;
  fs::path file = fs::canonical(root / relative, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  const fs::path inside = file.lexically_relative(root);
  if (inside.empty() || *inside.begin() == "..") return std::nullopt;
  return file;
}

Bytes SideFiles::read(const std::string& uri) {
  if (is_data_uri(uri)) return decode_data_uri(uri);
  const std::string name = decode_percent(uri);
  std::optional<fs::path> file = resolve(name);
  if (!file) file = resolve(with_slashes(name));
  if (!file) {
    throw GltfMissingFile(fmt::format(
        "it refers to '{}', which is not a regular file in the model's folder; put it there", uri.substr(0, 80)));
  }
  Bytes bytes = read_plain_file(*file, bytes_left_);
  bytes_left_ -= bytes.size();
  return bytes;
}

GltfFile read_gltf_file(const std::string& path) {
  GltfFile file;
  Bytes bytes = read_plain_file(path, kLargestGltfBytes);
  if (bytes.empty()) throw GltfError("it is empty; export it again");
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  file.side_files = SideFiles(std::move(folder), kLargestGltfBytes - bytes.size());
  if (!is_binary(bytes)) {
    if (const std::string kind = foreign_kind(bytes); !kind.empty()) throw GltfError(kind);
    file.document = parse_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return file;
  }
  const Chunks chunks = split(bytes);
  file.document = parse_text(chunks.text);
  if (chunks.binary) {
    const auto [offset, length] = *chunks.binary;
    bytes.resize(offset + length);
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
    file.binary = std::move(bytes);
  }
  return file;
}

}  // namespace afm::scene
