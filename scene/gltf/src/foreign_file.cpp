// SPDX-License-Identifier: Apache-2.0
#include "foreign_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace afm::scene {
namespace {

using namespace std::string_view_literals;

enum class Remedy { Export, Unpack, Download, Lfs, Utf8, Image };

// A kind of file and the bytes that it has at `offset`.
struct ForeignKind {
  std::string_view bytes;
  std::size_t offset;
  std::string_view name;
  Remedy remedy;
};

// The signatures of each format's specification; the longer of two that begin alike comes first.
constexpr std::array kKinds{
    ForeignKind{"version https://git-lfs.github.com/spec/"sv, 0, "a Git LFS pointer", Remedy::Lfs},
    ForeignKind{"\x1F\x8B"sv, 0, "a gzip file", Remedy::Unpack},
    ForeignKind{"\x28\xB5\x2F\xFD"sv, 0, "a Zstandard file", Remedy::Unpack},
    ForeignKind{"\xFD\x37zXZ\0"sv, 0, "an XZ file", Remedy::Unpack},
    ForeignKind{"BZh"sv, 0, "a bzip2 file", Remedy::Unpack},
    ForeignKind{"7z\xBC\xAF\x27\x1C"sv, 0, "a 7-Zip archive", Remedy::Unpack},
    ForeignKind{"Rar!\x1A\x07"sv, 0, "a RAR archive", Remedy::Unpack},
    ForeignKind{"PK\x03\x04"sv, 0, "a ZIP archive, such as .usdz, .3mf or a download", Remedy::Unpack},
    ForeignKind{"ustar"sv, 257, "a tar archive", Remedy::Unpack},
    ForeignKind{"\xFF\xFE"sv, 0, "a text in UTF-16", Remedy::Utf8},
    ForeignKind{"\xFE\xFF"sv, 0, "a text in UTF-16", Remedy::Utf8},
    ForeignKind{"{\0"sv, 0, "a text in UTF-16", Remedy::Utf8},
    ForeignKind{"\0{"sv, 0, "a text in UTF-16", Remedy::Utf8},
    ForeignKind{"Kaydara FBX Binary"sv, 0, "an FBX file", Remedy::Export},
    ForeignKind{"; FBX"sv, 0, "an FBX file", Remedy::Export},
    ForeignKind{"ply\n"sv, 0, "a PLY file", Remedy::Export},
    ForeignKind{"ply\r"sv, 0, "a PLY file", Remedy::Export},
    ForeignKind{"OFF\n"sv, 0, "an OFF file", Remedy::Export},
    ForeignKind{"ISO-10303-21"sv, 0, "a STEP file", Remedy::Export},
    ForeignKind{"#VRML"sv, 0, "a VRML file", Remedy::Export},
    ForeignKind{"#X3D"sv, 0, "an X3D file", Remedy::Export},
    ForeignKind{"#usda"sv, 0, "a USD file", Remedy::Export},
    ForeignKind{"PXR-USDC"sv, 0, "a USD file", Remedy::Export},
    ForeignKind{"BLENDER"sv, 0, "a Blender file", Remedy::Export},
    ForeignKind{"DRACO"sv, 0, "a bare Draco stream", Remedy::Export},
    ForeignKind{"b3dm"sv, 0, "a tile of Cesium's 3D Tiles", Remedy::Export},
    ForeignKind{"i3dm"sv, 0, "a tile of Cesium's 3D Tiles", Remedy::Export},
    ForeignKind{"pnts"sv, 0, "a tile of Cesium's 3D Tiles", Remedy::Export},
    ForeignKind{"LASF"sv, 0, "a LAS point cloud", Remedy::Export},
    ForeignKind{"ASTM-E57"sv, 0, "an E57 point cloud", Remedy::Export},
    ForeignKind{"# .PCD"sv, 0, "a PCD point cloud", Remedy::Export},
    ForeignKind{"# vtk DataFile"sv, 0, "a VTK file", Remedy::Export},
    ForeignKind{"%PDF"sv, 0, "a PDF file", Remedy::Export},
    ForeignKind{"\xABKTX 20\xBB"sv, 0, "a KTX2 image", Remedy::Image},
    ForeignKind{"\xABKTX 11\xBB"sv, 0, "a KTX image", Remedy::Image},
    ForeignKind{"WEBP"sv, 8, "a WebP image", Remedy::Image},
    ForeignKind{"DDS "sv, 0, "a DDS image", Remedy::Image},
    ForeignKind{"GIF8"sv, 0, "a GIF image", Remedy::Image},
    ForeignKind{"II*\0"sv, 0, "a TIFF image", Remedy::Image},
    ForeignKind{"MM\0*"sv, 0, "a TIFF image", Remedy::Image},
    ForeignKind{"ftypavif"sv, 4, "an AVIF image", Remedy::Image},
    ForeignKind{"ftyphei"sv, 4, "an HEIF image", Remedy::Image},
    ForeignKind{"ftypmif1"sv, 4, "an HEIF image", Remedy::Image},
    ForeignKind{"\x76\x2F\x31\x01"sv, 0, "an OpenEXR image", Remedy::Image},
    ForeignKind{"#?RADIANCE"sv, 0, "a Radiance image", Remedy::Image},
    ForeignKind{"8BPS"sv, 0, "a Photoshop image", Remedy::Image},
    ForeignKind{"\x89PNG\r\n\x1A\n"sv, 0, "a PNG image", Remedy::Image},
    ForeignKind{"\xFF\xD8\xFF"sv, 0, "a JPEG image", Remedy::Image},
    ForeignKind{"BM"sv, 0, "a BMP image", Remedy::Image},
};

std::string lower_text(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// Text without a byte-order mark and leading blanks.
std::string_view beginning(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text.substr(0, 4096);
}

// Kinds without a signature of their own: mark-up, STL, OBJ.
const ForeignKind* kind_of_text(std::string_view bytes) {
  static constexpr ForeignKind kHtml{"", 0, "an HTML page, probably in place of a download", Remedy::Download};
  static constexpr ForeignKind kCollada{"", 0, "a COLLADA file", Remedy::Export};
  static constexpr ForeignKind kSvg{"", 0, "an SVG image", Remedy::Image};
  static constexpr ForeignKind kXml{"", 0, "an XML file, such as X3D or VTK", Remedy::Export};
  static constexpr ForeignKind kStl{"", 0, "an STL file", Remedy::Export};
  static constexpr ForeignKind kObj{"", 0, "an OBJ file", Remedy::Export};
  const std::string text = lower_text(beginning(bytes));
  const auto begins = [&](std::string_view with) { return text.compare(0, with.size(), with) == 0; };
  const auto has = [&](std::string_view part) { return text.find(part) != std::string::npos; };
  if (begins("<!doctype html") || begins("<html")) return &kHtml;
  if (begins("<") && has("<collada")) return &kCollada;
  if (begins("<") && has("<svg")) return &kSvg;
  if (begins("<") && has("<html")) return &kHtml;
  if (begins("<?xml") || begins("<x3d") || begins("<vtkfile")) return &kXml;
  if (begins("solid") && (has("facet") || has("endsolid"))) return &kStl;
  // binary STL: 80 bytes of any text, a count, 50 bytes a triangle
  constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;
  if (bytes.size() > kStlHeader) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) count |= std::uint64_t{static_cast<unsigned char>(bytes[80 + i])} << (8 * i);
    if (count > 0 && bytes.size() == kStlHeader + kStlTriangle * count) return &kStl;
  }
  // the first line of an OBJ that is no comment
  std::string_view rest = text;
  while (!rest.empty() && (rest.front() == '#' || rest.front() == '\r' || rest.front() == '\n')) {
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  }
  for (const std::string_view word : {"mtllib ", "v ", "vn ", "vt ", "o ", "g ", "usemtl ", "f "}) {
    if (rest.substr(0, word.size()) == word) return &kObj;
  }
  return nullptr;
}

const ForeignKind* kind_of(std::span<const std::uint8_t> data) {
  const std::string_view bytes(reinterpret_cast<const char*>(data.data()), data.size());
  for (const ForeignKind& kind : kKinds) {
    if (bytes.size() >= kind.offset && bytes.substr(kind.offset, kind.bytes.size()) == kind.bytes) return &kind;
  }
  return kind_of_text(bytes);
}

}  // namespace

std::string foreign_kind(std::span<const std::uint8_t> bytes) {
  const ForeignKind* const kind = kind_of(bytes);
  if (kind == nullptr) return "";
  const auto remedy = [&] {
    switch (kind->remedy) {
      case Remedy::Unpack:
        return "unpack it, and give the .glb or .gltf in it";
      case Remedy::Download:
        return "download the file itself";
      case Remedy::Lfs:
        return "run git lfs pull in its repository";
      case Remedy::Utf8:
        return "save it in UTF-8";
      case Remedy::Image:
      case Remedy::Export:
        break;
    }
    return "export glTF 2.0 (.glb) from the program that made it";
  };
  return fmt::format("it is {}, not glTF; {}", kind->name, remedy());
}

std::string foreign_image(std::span<const std::uint8_t> bytes) {
  const ForeignKind* const kind = kind_of(bytes);
  return kind == nullptr ? "" : std::string(kind->name);
}

}  // namespace afm::scene
