// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

// Kinds of file that people bring and that no reader here takes, so that a refusal can name the file and the remedy.
// Any thread.
namespace afm::core {

enum class FileRole : std::uint8_t {
  Archive,
  LfsPointer,
  WebPage,
  OtherText,
  Picture,
  Model,
  LabFile,
  Document,
  Spreadsheet,
  Empty
};

struct FileKind {
  std::string_view name;  // words after "it is", such as "a gzip file"
  FileRole role;
};

// Bytes of a file's beginning that file_kind() looks at.
inline constexpr std::size_t kFileKindBytes = 4096;

// Kind of a file by the signatures in each format's specification; a binary STL has none and is recognised by its size.
// Empty for any other file.
std::optional<FileKind> file_kind(std::string_view beginning, std::uint64_t file_size);

// Advice for a file of a role, whatever was to be read from it: "unpack it first". Empty where that depends on the
// reader.
std::string_view remedy_of(FileRole role);

}  // namespace afm::core
