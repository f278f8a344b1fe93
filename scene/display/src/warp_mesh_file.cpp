// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>

#include "core/whole_file.h"
#include "scene/display/warp_mesh.h"

namespace afm::scene {

namespace {

constexpr std::size_t kLargestMeshFile = 64U << 20U;
constexpr double kFarthest = 10.0;      // from the centre of the output, whose upper edge is at distance 1
constexpr double kFarthestTexel = 4.0;  // largest distance from the picture, in multiples of its size
constexpr double kSmallestAspect = 0.1, kLargestAspect = 10.0;
constexpr double kLeastArea = 1e-12;  // area below which triangles are degenerate; the output has area 1
constexpr double kMostDrawn = 64.0;  // summed area of all bounding rectangles, which limits the time for drawing a mesh

struct MeshFault {
  std::size_t line;
  std::string what;
};

// Reads lines of numbers separated by spaces. Skips a byte order mark, empty lines, and comments from # to the line's
// end.
class MeshLines {
 public:
  explicit MeshLines(std::string_view text) : rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  std::size_t number() const { return number_; }

  [[noreturn]] void fail(std::string what) const { throw MeshFault{number_, std::move(what)}; }

  // Next line, with exactly `Count` numbers.
  template <std::size_t Count>
  std::array<double, Count> next(const char* meaning) {
    std::string_view line = next_line();
    if (line.empty()) fail(fmt::format("the file ends here; expected {}", meaning));
    std::array<double, Count> values{};
    for (double& value : values) {
      skip_blanks(line);
      const auto [after, error] = std::from_chars(line.data(), line.data() + line.size(), value);
      if (error != std::errc() || !std::isfinite(value)) fail(fmt::format("expected {}", meaning));
      line.remove_prefix(static_cast<std::size_t>(after - line.data()));
      if (!line.empty() && !is_blank(line.front())) fail(fmt::format("expected {}", meaning));
    }
    skip_blanks(line);
    if (!line.empty()) fail(fmt::format("expected {}, and nothing more", meaning));
    return values;
  }

  void expect_end() {
    if (!next_line().empty()) fail("there are more lines than nodes; check the columns and rows in its second line");
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  static void skip_blanks(std::string_view& line) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  }

  // The next line with anything but blanks, without them at its beginning, and without its comment; empty at the end.
  std::string_view next_line() {
    while (!rest_.empty()) {
      ++number_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      line = line.substr(0, line.find('#'));
      skip_blanks(line);
      if (!line.empty()) return line;
    }
    ++number_;
    return {};
  }

  std::string_view rest_;
  std::size_t number_ = 0;  // number of the newest line
};

// Coordinates as in the file: x to the right, y and v up.
WarpNode read_node(MeshLines& lines) {
  const auto [x, y, u, v, intensity] = lines.next<5>("five numbers: x y u v intensity");
  if (std::abs(x) > kFarthest || std::abs(y) > kFarthest) {
    lines.fail(fmt::format("x {:g}, y {:g} is too far from the output, whose y goes from -1 to 1", x, y));
  }
  for (const double texture : {u, v}) {
    if (texture < -kFarthestTexel || texture > 1.0 + kFarthestTexel) {
      lines.fail(fmt::format("u {:g}, v {:g} is too far from the picture, which goes from 0 to 1", u, v));
    }
  }
  if (intensity > 1.0) {
    lines.fail(fmt::format("the intensity {:g} is above 1; write 0 to 1, or -1 where nothing is drawn", intensity));
  }
  return {{x, y}, {u, v}, intensity};
}

double doubled_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Area of the bounding rectangle of a triangle within the output.
double drawn_area(const WarpNode& a, const WarpNode& b, const WarpNode& c) {
  const glm::dvec2 low = glm::min(a.output, glm::min(b.output, c.output));
  const glm::dvec2 high = glm::max(a.output, glm::max(b.output, c.output));
  const glm::dvec2 size = glm::clamp(high, 0.0, 1.0) - glm::clamp(low, 0.0, 1.0);
  return size.x * size.y;
}

// A picture that overlaps itself has two colours for one pixel; a mirrored one exchanges near and far.
// `lines` has the line of each node.
void check_cells(const WarpMesh& mesh, const std::vector<std::size_t>& lines) {
  double turn = 0.0;  // common orientation of all triangles: 1 or -1
  double drawn = 0.0;
  for (std::uint32_t row = 0; row + 1 < mesh.rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < mesh.columns; ++column) {
      const std::array cell{&mesh.node(column, row), &mesh.node(column + 1, row), &mesh.node(column + 1, row + 1),
                            &mesh.node(column, row + 1)};
      if (std::any_of(cell.begin(), cell.end(), [](const WarpNode* node) { return node->intensity < 0.0; })) continue;
      const std::size_t line = lines[std::size_t{row} * mesh.columns + column];
      for (const auto& [b, c] : {std::pair(cell[1], cell[2]), std::pair(cell[2], cell[3])}) {
        const double area = doubled_area(cell[0]->output, b->output, c->output);
        const double seen = doubled_area(cell[0]->picture, b->picture, c->picture);
        if (!(std::abs(area) > kLeastArea)) {
          throw MeshFault{line, "the cell that begins with this node has no area in x and y"};
        }
        if (turn == 0.0) turn = std::copysign(1.0, area);
        if (turn * area < 0.0) throw MeshFault{line, "the mesh folds over itself in x and y at this node"};
        if (area * seen < 0.0) {
          throw MeshFault{line,
                          "the mesh mirrors the picture at this node; set rear projection in the projector instead"};
        }
        drawn += drawn_area(*cell[0], *b, *c);
      }
    }
  }
  if (drawn > kMostDrawn) throw MeshFault{lines.front(), "the mesh lies over itself many times"};
  if (turn == 0.0) throw MeshFault{1, "no cell of the mesh is drawn: every one has a node of negative intensity"};
}

double largest_x(const WarpMesh& mesh) {
  double largest = 0.0;
  for (const WarpNode& node : mesh.nodes) largest = std::max(largest, std::abs(node.output.x));
  return largest;
}

WarpMesh read_mesh(std::string_view text, std::optional<double> aspect) {
  MeshLines lines(text);
  const auto [type] = lines.next<1>("the type of the mesh, 2");
  if (type == 1.0) lines.fail("the mesh is for a fisheye picture (type 1); TouchAFM draws flat pictures: use type 2");
  if (type != 2.0) lines.fail(fmt::format("{:g} is no type of a mesh; expected 2", type));
  const auto size = lines.next<2>("two whole numbers: columns and rows");
  for (const double count : size) {
    if (count != std::floor(count) || count < 2.0 || count > kMostMeshNodes) {
      lines.fail(fmt::format("the mesh has {:g} x {:g} nodes; it must have 2 to {} each way", size[0], size[1],
                             kMostMeshNodes));
    }
  }
  WarpMesh mesh{static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1]), {}};
  const std::size_t count = std::size_t{mesh.columns} * mesh.rows;
  mesh.nodes.reserve(count);
  std::vector<std::size_t> node_lines;
  node_lines.reserve(count);
  while (mesh.nodes.size() < count) {
    mesh.nodes.push_back(read_node(lines));
    node_lines.push_back(lines.number());
  }
  lines.expect_end();

  const double width = aspect.value_or(largest_x(mesh));
  if (width < kSmallestAspect || width > kLargestAspect) {
    throw MeshFault{node_lines.front(),
                    fmt::format("the largest x is {:g}; it must be the output's width divided by its height", width)};
  }
  for (WarpNode& node : mesh.nodes) {
    node.output = {0.5 * (node.output.x / width + 1.0), 0.5 * (1.0 - node.output.y)};
    node.picture.y = 1.0 - node.picture.y;
  }
  check_cells(mesh, node_lines);
  return mesh;
}

}  // namespace

core::Result<WarpMesh> load_warp_mesh(const std::string& path, std::optional<double> aspect) {
  const auto bad = [&](const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("warp mesh {}: {}", path, what));
  };
  const auto text = core::read_file(path);
  if (!text) return tl::unexpected(text.error());
  if (text->size() > kLargestMeshFile) return bad("is larger than 64 MiB; is it a warp mesh?");
  try {
    return read_mesh(*text, aspect);
  } catch (const MeshFault& fault) {
    return bad(fmt::format("line {}: {}", fault.line, fault.what));
  }
}

}  // namespace afm::scene
