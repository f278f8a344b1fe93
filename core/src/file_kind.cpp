// SPDX-License-Identifier: Apache-2.0
#include "core/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace afm::core {
namespace {

using namespace std::string_view_literals;

// The bytes that a kind of file has at `offset`. The longer of two that begin alike comes first.
struct Signature {
  std::string_view bytes;
  std::size_t offset;
  FileKind kind;
};

constexpr std::array kSignatures{
    Signature{"version https://git-lfs.github.com/spec/"sv, 0, {"a Git LFS pointer", FileRole::LfsPointer}},
    Signature{"\x1F\x8B"sv, 0, {"a gzip file", FileRole::Archive}},
    Signature{"\x28\xB5\x2F\xFD"sv, 0, {"a Zstandard file", FileRole::Archive}},
    Signature{"\xFD\x37zXZ\0"sv, 0, {"an XZ file", FileRole::Archive}},
    Signature{"BZh"sv, 0, {"a bzip2 file", FileRole::Archive}},
    Signature{"7z\xBC\xAF\x27\x1C"sv, 0, {"a 7-Zip archive", FileRole::Archive}},
    Signature{"Rar!\x1A\x07"sv, 0, {"a RAR archive", FileRole::Archive}},
    Signature{"[Content_Types].xml"sv, 30, {"a file of Excel or another Office program", FileRole::Spreadsheet}},
    Signature{"mimetypeapplication/vnd.oasis.opendocument"sv, 30, {"a file of LibreOffice", FileRole::Spreadsheet}},
    Signature{"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv, 0, {"a file of an old Office program", FileRole::Spreadsheet}},
    Signature{"PK\x03\x04"sv, 0, {"a ZIP archive, such as .usdz, .3mf or a download", FileRole::Archive}},
    Signature{"ustar"sv, 257, {"a tar archive", FileRole::Archive}},
    Signature{"\xFF\xFE"sv, 0, {"a text in UTF-16", FileRole::OtherText}},
    Signature{"\xFE\xFF"sv, 0, {"a text in UTF-16", FileRole::OtherText}},
    Signature{"{\0"sv, 0, {"a text in UTF-16", FileRole::OtherText}},
    Signature{"\0{"sv, 0, {"a text in UTF-16", FileRole::OtherText}},
    Signature{"Kaydara FBX Binary"sv, 0, {"an FBX file", FileRole::Model}},
    Signature{"; FBX"sv, 0, {"an FBX file", FileRole::Model}},
    Signature{"ply\n"sv, 0, {"a PLY file", FileRole::Model}},
    Signature{"ply\r"sv, 0, {"a PLY file", FileRole::Model}},
    Signature{"OFF\n"sv, 0, {"an OFF file", FileRole::Model}},
    Signature{"ISO-10303-21"sv, 0, {"a STEP file", FileRole::Model}},
    Signature{"#VRML"sv, 0, {"a VRML file", FileRole::Model}},
    Signature{"#X3D"sv, 0, {"an X3D file", FileRole::Model}},
    Signature{"#usda"sv, 0, {"a USD file", FileRole::Model}},
    Signature{"PXR-USDC"sv, 0, {"a USD file", FileRole::Model}},
    Signature{"BLENDER"sv, 0, {"a Blender file", FileRole::Model}},
    Signature{"DRACO"sv, 0, {"a bare Draco stream", FileRole::Model}},
    Signature{"b3dm"sv, 0, {"a tile of Cesium's 3D Tiles", FileRole::Model}},
    Signature{"i3dm"sv, 0, {"a tile of Cesium's 3D Tiles", FileRole::Model}},
    Signature{"pnts"sv, 0, {"a tile of Cesium's 3D Tiles", FileRole::Model}},
    Signature{"LASF"sv, 0, {"a LAS point cloud", FileRole::Model}},
    Signature{"ASTM-E57"sv, 0, {"an E57 point cloud", FileRole::Model}},
    Signature{"# .PCD"sv, 0, {"a PCD point cloud", FileRole::Model}},
    Signature{"# vtk DataFile"sv, 0, {"a VTK file", FileRole::Model}},
    Signature{"%PDF"sv, 0, {"a PDF document", FileRole::Document}},
    Signature{"\xABKTX 20\xBB"sv, 0, {"a KTX2 image", FileRole::Picture}},
    Signature{"\xABKTX 11\xBB"sv, 0, {"a KTX image", FileRole::Picture}},
    Signature{"WEBP"sv, 8, {"a WebP image", FileRole::Picture}},
    Signature{"DDS "sv, 0, {"a DDS image", FileRole::Picture}},
    Signature{"GIF8"sv, 0, {"a GIF image", FileRole::Picture}},
    Signature{"II*\0"sv, 0, {"a TIFF image", FileRole::Picture}},
    Signature{"MM\0*"sv, 0, {"a TIFF image", FileRole::Picture}},
    Signature{"ftypavif"sv, 4, {"an AVIF image", FileRole::Picture}},
    Signature{"ftyphei"sv, 4, {"an HEIF image", FileRole::Picture}},
    Signature{"ftypmif1"sv, 4, {"an HEIF image", FileRole::Picture}},
    Signature{"\x76\x2F\x31\x01"sv, 0, {"an OpenEXR image", FileRole::Picture}},
    Signature{"#?RADIANCE"sv, 0, {"a Radiance image", FileRole::Picture}},
    Signature{"8BPS"sv, 0, {"a Photoshop image", FileRole::Picture}},
    Signature{"\x89PNG\r\n\x1A\n"sv, 0, {"a PNG image", FileRole::Picture}},
    Signature{"\xFF\xD8\xFF"sv, 0, {"a JPEG image", FileRole::Picture}},
    Signature{"BM"sv, 0, {"a BMP image", FileRole::Picture}},
    Signature{"\x01\xB0\x93\xFF"sv, 0, {"a file of NT-MDT (.mdt)", FileRole::LabFile}},
    Signature{"[DataSet]"sv, 0, {"a file of Nanosurf (.nid)", FileRole::LabFile}},
    Signature{":NANONIS_VERSION:"sv, 0, {"a scan of Nanonis (.sxm)", FileRole::LabFile}},
    Signature{"WSxM file"sv, 0, {"a file of WSxM", FileRole::LabFile}},
    Signature{"S\0T\0i\0M\0a\0g\0e\0"sv, 2, {"a file of RHK (.sm4)", FileRole::LabFile}},
    Signature{"IGOR\n"sv, 0, {"a text wave of Igor (.itx)", FileRole::LabFile}},
    Signature{"IGOR\r"sv, 0, {"a text wave of Igor (.itx)", FileRole::LabFile}},
    Signature{"DIGITAL SURF"sv, 0, {"a surface of Mountains (.sur)", FileRole::LabFile}},
    Signature{"DSCOMPRESSED"sv, 0, {"a surface of Mountains (.sur)", FileRole::LabFile}},
    Signature{"aISO-1.0"sv, 0, {"a surface of ISO 25178 (.sdf)", FileRole::LabFile}},
    Signature{"bISO-1.0"sv, 0, {"a surface of ISO 25178 (.sdf)", FileRole::LabFile}},
    Signature{"AliconaImaging"sv, 0, {"a surface of Alicona (.al3d)", FileRole::LabFile}},
    Signature{"fileformat = bcr"sv, 0, {"a file of Image Metrology (.bcr)", FileRole::LabFile}},
    Signature{"# File Format = ASCII"sv, 0, {"a text file of SPIP", FileRole::LabFile}},
    Signature{"MATLAB 5.0"sv, 0, {"a file of MATLAB", FileRole::LabFile}},
    Signature{"\x93NUMPY"sv, 0, {"an array of NumPy, without units", FileRole::LabFile}},
    Signature{"ONTMATRX"sv, 0, {"a file of Omicron (.mtrx)", FileRole::LabFile}},
    Signature{"Gwyddion Simple Field 1.0\r"sv, 0, {"a .gsf that was copied as a text", FileRole::LabFile}},
    Signature{"AFMS"sv, 0, {"a session of TouchAFM (.afms)", FileRole::LabFile}}};

constexpr bool all_within_the_beginning() {
  return std::all_of(kSignatures.begin(), kSignatures.end(),
                     [](const Signature& row) { return row.offset + row.bytes.size() <= kFileKindBytes; });
}
static_assert(all_within_the_beginning());

std::string lower_text(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// Text after a byte-order mark and leading blanks.
std::string_view beginning(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

// True for UTF-16 without a byte-order mark: letters, digits and blanks with every other byte zero.
bool is_utf16(std::string_view bytes) {
  constexpr std::size_t kLetters = 16;
  if (bytes.size() < 2 * kLetters) return false;
  for (const std::size_t low : {0U, 1U}) {
    bool all = true;
    for (std::size_t i = 0; all && i < 2 * kLetters; i += 2) {
      const auto letter = static_cast<unsigned char>(bytes[i + low]);
      all = bytes[i + 1 - low] == '\0' && (std::isprint(letter) != 0 || std::isspace(letter) != 0);
    }
    if (all) return true;
  }
  return false;
}

// Kind of a file without a signature: mark-up, STL, OBJ.
std::optional<FileKind> kind_of_text(std::string_view bytes, std::uint64_t file_size) {
  constexpr FileKind kHtml{"an HTML page, probably in place of a download", FileRole::WebPage};
  constexpr FileKind kCollada{"a COLLADA file", FileRole::Model};
  constexpr FileKind kSvg{"an SVG image", FileRole::Picture};
  constexpr FileKind kXml{"an XML file, such as X3D or VTK", FileRole::Model};
  constexpr FileKind kStl{"an STL file", FileRole::Model};
  constexpr FileKind kObj{"an OBJ file", FileRole::Model};
  const std::string text = lower_text(beginning(bytes));
  const auto begins = [&](std::string_view with) { return text.compare(0, with.size(), with) == 0; };
  const auto has = [&](std::string_view part) { return text.find(part) != std::string::npos; };
  if (begins("<!doctype html") || begins("<html")) return kHtml;
  if (begins("<") && has("<collada")) return kCollada;
  if (begins("<") && has("<svg")) return kSvg;
  if (begins("<") && has("<html")) return kHtml;
  if (begins("<?xml") || begins("<x3d") || begins("<vtkfile")) return kXml;
  if (begins("solid") && (has("facet") || has("endsolid"))) return kStl;
  // binary STL: 80 bytes of any text, a count, 50 bytes a triangle
  constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;
  if (file_size > kStlHeader && bytes.size() >= kStlHeader) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) count |= std::uint64_t{static_cast<unsigned char>(bytes[80 + i])} << (8 * i);
    if (count > 0 && file_size == kStlHeader + kStlTriangle * count) return kStl;
  }
  // the first line of an OBJ that is no comment
  std::string_view rest = text;
  while (!rest.empty() && (rest.front() == '#' || rest.front() == '\r' || rest.front() == '\n')) {
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  }
  for (const std::string_view word : {"mtllib ", "v ", "vn ", "vt ", "o ", "g ", "usemtl ", "f "}) {
    if (rest.substr(0, word.size()) == word) return kObj;
  }
  return std::nullopt;
}

}  // namespace

std::optional<FileKind> file_kind(std::string_view beginning, std::uint64_t file_size) {
  for (const Signature& row : kSignatures) {
    if (beginning.size() > row.offset && beginning.substr(row.offset).starts_with(row.bytes)) return row.kind;
  }
  if (file_size == 0) return FileKind{"an empty file", FileRole::Empty};
  if (is_utf16(beginning)) return FileKind{"a text in UTF-16", FileRole::OtherText};
  return kind_of_text(beginning, file_size);
}

std::string_view remedy_of(FileRole role) {
  switch (role) {
    case FileRole::Archive:
      return "unpack it first";
    case FileRole::LfsPointer:
      return "run git lfs pull in its repository";
    case FileRole::WebPage:
      return "download the file itself";
    case FileRole::OtherText:
      return "save it in UTF-8";
    case FileRole::Spreadsheet:
      return "save its table as .csv";
    case FileRole::Empty:
      return "copy or export it again";
    case FileRole::Picture:
    case FileRole::Model:
    case FileRole::LabFile:
    case FileRole::Document:
      break;
  }
  return "";
}

}  // namespace afm::core
