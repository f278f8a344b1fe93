// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "models.h"

namespace afm::generate {
namespace {

constexpr double kNm = 1e-9, kUm = 1e-6;
constexpr int kRound = 4;  // number of halvings: 64 points around

// Each at its true size, so far from the contact point that it is beside the tip at its own scale. Sizes of a textbook:
// R. Milo and R. Phillips, "Cell Biology by the Numbers".
constexpr double kHairRadius = 40 * kUm, kHairHalfLength = 900 * kUm;
constexpr double kCellRadius = 4 * kUm;
constexpr double kVirusRadius = 38 * kNm, kSpikeLength = 12 * kNm;
constexpr double kDnaRadius = 1.0 * kNm, kDnaLength = 16 * kNm;

// A scaly shaft that lies across the view.
NodeSpec hair() {
  Surface shaft;
  std::vector<ProfilePoint> profile;
  constexpr int kScales = 60;
  const double step = 2 * kHairHalfLength / kScales;
  for (int i = 0; i < kScales; ++i) {
    const double low = -kHairHalfLength + i * step;
    const double rim = kHairRadius * mix(0.97, 1.0, random_unit(i, 0, 101));
    profile.push_back({0.93 * kHairRadius, low, 1, 0});
    profile.push_back({rim, low + 0.86 * step, 1, 0.04});
    profile.push_back({rim, low + 0.88 * step, 0.3, 1});
  }
  add_lathe(shaft, profile, 3);
  Surface placed;
  const V3 along = unit(V3{0.82, -0.57, 0});
  add_placed(placed, shaft, {{560 * kUm, 300 * kUm, 0.9 * kHairRadius}, cross({0, 0, 1}, along), {0, 0, 1}, along});
  return {.name = "hair",
          .parent = 0,
          .parts = {{std::move(placed), {.name = "hair", .base_color = {0.16, 0.085, 0.045}, .roughness = 0.38}}}};
}

// Thickness at a fraction of the radius: E. Evans and Y. C. Fung, Microvasc. Res. 4 (1972) 335, for 7.8 um.
double cell_half_thickness(double part) {
  const double p2 = part * part;
  return 0.5 * kCellRadius * std::sqrt(std::fmax(0.0, 1 - p2)) * (0.207 + 2.003 * p2 - 1.123 * p2 * p2);
}

Surface red_cell() {
  constexpr int kRings = 18;
  std::vector<ProfilePoint> profile;
  const auto at = [&](double part, double side) {
    const double step = 1e-4, low = std::fmax(0.0, part - step), high = std::fmin(1.0, part + step);
    const double slope = (cell_half_thickness(high) - cell_half_thickness(low)) / (kCellRadius * (high - low));
    if (part >= 1) return ProfilePoint{kCellRadius, 0, 1, 0};
    return ProfilePoint{kCellRadius * part, side * cell_half_thickness(part), -slope, side};
  };
  // finer where the rim turns
  const auto part_of = [](int i) {
    const double t = static_cast<double>(kRings - i) / kRings;
    return 1 - t * t;
  };
  for (int i = 0; i <= kRings; ++i) profile.push_back(at(part_of(i), -1));
  for (int i = kRings - 1; i >= 0; --i) profile.push_back(at(part_of(i), 1));
  Surface cell;
  add_lathe(cell, profile, kRound - 1);
  return cell;
}

NodeSpec red_cells() {
  Surface cells;
  const Surface cell = red_cell();
  const V3 up = unit(V3{0.28, -0.42, 0.86});
  const V3 x = unit(cross({0, 1, 0}, up));
  add_placed(cells, cell, {{-9.5 * kUm, 0.5 * kUm, 2.6 * kUm}, x, cross(up, x), up});
  add_placed(cells, cell, {{-16 * kUm, 7 * kUm, 1.1 * kUm}});
  return {.name = "red-cell",
          .parent = 0,
          .parts = {{std::move(cells), {.name = "red cell", .base_color = {0.50, 0.020, 0.018}, .roughness = 0.30}}}};
}

// An enveloped virus: a ball with spikes, evenly spread by the golden angle.
NodeSpec virus() {
  constexpr int kSpikes = 44;
  Surface ball, spikes;
  std::vector<ProfilePoint> circle_profile;
  for (const V2 p : arc({0, -1}, {1, 0}, 3))
    circle_profile.push_back({kVirusRadius * p.x, kVirusRadius * p.y, p.x, p.y});
  for (const V2 p : arc({1, 0}, {0, 1}, 3))
    circle_profile.push_back({kVirusRadius * p.x, kVirusRadius * p.y, p.x, p.y});
  add_lathe(ball, circle_profile, kRound - 1);
  Surface spike;
  const double root = 0.97 * kVirusRadius, neck = kVirusRadius + 0.6 * kSpikeLength, top = kVirusRadius + kSpikeLength;
  add_lathe(spike,
            {{1.3 * kNm, root, 1, 0}, {1.3 * kNm, neck, 1, -0.3}, {3.6 * kNm, top - 2 * kNm, 1, 0}, {0, top, 0, 1}}, 1);
  // the golden angle: its cosine and sine
  const V2 golden{-0.7373688780783197, 0.6754902942615238};
  V2 turn{1, 0};
  for (int i = 0; i < kSpikes; ++i) {
    const double height = 1 - (2.0 * i + 1) / kSpikes, across = std::sqrt(1 - height * height);
    const V3 out{across * turn.x, across * turn.y, height};
    const V3 x = unit(cross(std::abs(out.z) < 0.9 ? V3{0, 0, 1} : V3{1, 0, 0}, out));
    add_placed(spikes, spike, {{}, x, cross(out, x), out});
    turn = {turn.x * golden.x - turn.y * golden.y, turn.x * golden.y + turn.y * golden.x};
  }
  const Placement place{{-118 * kNm, 10 * kNm, kVirusRadius + 6 * kNm}};
  Surface placed_ball, placed_spikes;
  add_placed(placed_ball, ball, place);
  add_placed(placed_spikes, spikes, place);
  return {
      .name = "virus",
      .parent = 0,
      .parts = {{std::move(placed_ball), {.name = "envelope", .base_color = {0.20, 0.26, 0.36}, .roughness = 0.5}},
                {std::move(placed_spikes), {.name = "spikes", .base_color = {0.62, 0.12, 0.06}, .roughness = 0.4}}}};
}

// Two strands and the pairs between them, ten and a half to a turn; it lies along the view's right.
NodeSpec dna() {
  constexpr double kPairRise = 0.34 * kNm, kStrand = 0.30 * kNm, kPair = 0.13 * kNm;
  // the turn from a pair to the next, 2 pi / 10.5, and the angle of the minor groove, 150 degrees
  const V2 step{0.82623877431599468, 0.56332005806362206}, groove{-0.86602540378443871, 0.49999999999999994};
  const auto turned = [](V2 a, V2 b) { return V2{a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; };
  const V3 along = unit(V3{0.93, -0.37, 0});
  const Placement lies{{-21 * kNm, -1 * kNm, 1.2 * kNm}, cross({0, 0, 1}, along), {0, 0, 1}, along};
  std::array<Surface, 3> surfaces;  // two strands and their pairs
  const auto rod = [&](Surface& into, V3 from, V3 to, double radius) {
    const V3 way = to - from;
    const double length = std::sqrt(dot(way, way));
    const V3 z = way * (1 / length);
    const V3 x = unit(cross(std::abs(z.z) < 0.9 ? V3{0, 0, 1} : V3{1, 0, 0}, z));
    Surface piece, placed;
    add_prism(piece, circle(radius, 1), 0, length, 0.3 * radius);
    add_placed(placed, piece, {from, x, cross(z, x), z});
    add_placed(into, placed, lies);
  };
  V2 turn{1, 0};
  const int pairs = static_cast<int>(kDnaLength / kPairRise);
  for (int i = 0; i < pairs; ++i) {
    const V2 next = turned(turn, step);
    const double z = (i - 0.5 * pairs) * kPairRise;
    const auto at = [&](V2 direction, double height) {
      return V3{kDnaRadius * direction.x, kDnaRadius * direction.y, height};
    };
    rod(surfaces[0], at(turn, z), at(next, z + kPairRise), kStrand);
    rod(surfaces[1], at(turned(turn, groove), z), at(turned(next, groove), z + kPairRise), kStrand);
    rod(surfaces[2], at(turn, z), at(turned(turn, groove), z), kPair);
    turn = next;
  }
  return {
      .name = "dna",
      .parent = 0,
      .parts = {{std::move(surfaces[0]), {.name = "strand", .base_color = {0.10, 0.30, 0.62}, .roughness = 0.35}},
                {std::move(surfaces[1]), {.name = "other strand", .base_color = {0.72, 0.28, 0.05}, .roughness = 0.35}},
                {std::move(surfaces[2]), {.name = "pairs", .base_color = {0.62, 0.62, 0.58}, .roughness = 0.45}}}};
}

}  // namespace

Model companions() {
  Model model{"companions", {}};
  model.nodes.push_back({.name = "companions", .placement = kYUpFromZUp});
  for (NodeSpec node : {hair(), red_cells(), virus(), dna()}) model.nodes.push_back(std::move(node));
  return model;
}

}  // namespace afm::generate
