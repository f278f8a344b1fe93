// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/journey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

#include "exhibit/scenery/wall_layout.h"

namespace afm::exhibit {

namespace {

using glm::dmat4;
using glm::dvec3;

// Seen from above, like the sample on the wall; at scales at which the ball of the tip would hide the view or enclose
// the viewer, from so little above the ground.
constexpr double kLowViewRad = 0.13, kLeastTiltRad = -0.25, kLowFromOrders = 6.0, kLowAtOrders = 7.5;

constexpr double kBeyondFog = 20.0;     // layout units beyond the fog
constexpr double kBelowPixel = 0.0015;  // size in layout units

// Scales between which the tip's soft shade replaces the shadows of the triangles.
constexpr double kMapToOrders = 4.25, kConeFromOrders = 4.85;
// Scales at which the sample's atoms come out of its ground, once those up to this distance from the contact
// point fill the view: farther ones are drawn with few corners (assets/generate/journey_ground.cpp).
constexpr double kAtomsRange = 0.3, kAtomsAtOrders = 8.5, kAtomsAtLast = 8.95, kAtomsReachM = 6.45e-9;
constexpr double kAtomsHiddenM = 0.36e-9;
// Those of the tip, from the scale at which one is as wide as two pixels.
constexpr double kTipAtomsAtOrders = 7.6;

// Light among the atoms, where everything is in the tip's shade.
constexpr double kLightFromOrders = 7.5, kShadeOfAtoms = 0.55;

constexpr double kWidestShade = 0.4;  // in layout units

constexpr double kVeilS = 0.5, kTravelS = 20.0;
constexpr double kWholeS = 2.0 * kVeilS + kTravelS;
constexpr double kStepS = kTravelS / (kJourneyOrders + 1.0);  // time at each power of ten
static_assert(kStepS > 2.0 * kVeilS);

double eased(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

// Calls `visit` with each vertex of a node, in the frame.
template <class Visit>
void for_each_place(const scene::Scene& scene, scene::NodeIndex frame, scene::NodeIndex node, const Visit& visit) {
  const dmat4 frame_from_node = ancestor_from_node(scene, frame, node);
  for (const scene::Primitive& primitive : scene.meshes[*scene.nodes[node].mesh].primitives) {
    for (const scene::Vertex& vertex : primitive.vertices) {
      visit(dvec3(frame_from_node * glm::dvec4(dvec3(vertex.position), 1.0)));
    }
  }
}

double tilt_under_tip(const Journey::View& view) {
  return std::clamp(kLowViewRad - std::atan2(view.eye.y, view.eye.z), kLeastTiltRad, kSampleTiltRad);
}

// Distance from the contact point, in layout units, of the farthest ground seen at the screen's lower border.
double ground_at_border(const Journey::View& view, double tilt_rad) {
  const dvec3 up(0.0, std::cos(tilt_rad), std::sin(tilt_rad));
  double farthest = 0.0;
  for (const dvec3& corner : view.lower_corners) {
    const double above = glm::dot(up, view.eye), falls = above - glm::dot(up, corner);
    if (falls > 0.0) farthest = std::max(farthest, glm::length(view.eye + (corner - view.eye) * (above / falls)));
  }
  return farthest;
}

double scale_of(double orders) { return std::pow(10.0, std::clamp(orders, 0.0, kJourneyOrders)); }

}  // namespace

Phrase journey_place(double orders) {
  // upper limits of the places
  static constexpr std::array kEnds{0.7, 1.7, 2.6, 3.5, 4.7, 6.2, 7.6, 8.3};
  static_assert(after(Phrase::PlaceBench, kEnds.size()) == Phrase::PlaceAtoms);
  const auto* const end = std::find_if(kEnds.begin(), kEnds.end(), [&](double e) { return orders < e; });
  return after(Phrase::PlaceBench, static_cast<std::size_t>(end - kEnds.begin()));
}

Journey::Journey(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex layout, const View& view)
    : low_tilt_rad_(tilt_under_tip(view)),
      atoms_at_orders_(std::clamp(std::log10(std::max(ground_at_border(view, low_tilt_rad_), 1e-9) / kAtomsReachM),
                                  kAtomsAtOrders, kAtomsAtLast)) {
  frame_ = build.frame("journey-frame", layout, dmat4(1.0));
  const scene::NodeIndex root = build.model_in_frame_of("journey", "journey.glb", "journey", frame_);
  measure(scene, root, std::nullopt);
  if (!build.error()) measure_tip(scene, build);
  measure(scene, build.model_in_frame_of("companions", "companions.glb", "companions", frame_), std::nullopt);
}

std::size_t Journey::add_ground(ModelBuilder& build, scene::Scene& scene, const std::string& look) {
  const auto known = std::find(grounds_.begin(), grounds_.end(), look);
  if (known != grounds_.end()) return static_cast<std::size_t>(known - grounds_.begin());
  const std::string name = "ground-" + look;
  grounds_.push_back(look);
  measure(scene, build.model_in_frame_of("ground", name + ".glb", name, frame_), grounds_.size() - 1);
  return grounds_.size() - 1;
}

void Journey::measure(const scene::Scene& scene, scene::NodeIndex first, std::optional<std::size_t> ground) {
  for (scene::NodeIndex i = first; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].mesh) continue;
    Part part{.node = i, .ground = ground, .nearest_m = std::numeric_limits<double>::infinity(), .farthest_m = 0.0};
    for_each_place(scene, frame_, i, [&](const dvec3& place) {
      part.nearest_m = std::min(part.nearest_m, glm::length(place));
      part.farthest_m = std::max(part.farthest_m, glm::length(place));
    });
    parts_.push_back(part);
    if (!scene.nodes[i].name.ends_with("atoms")) continue;
    if (!scene.nodes[i].name.ends_with("far-atoms")) atoms_.push_back(i);
    if (ground) ground_atoms_.push_back(i);
  }
}

void Journey::measure_tip(const scene::Scene& scene, ModelBuilder& build) {
  const auto lowest = [&](const char* node) {
    double low = std::numeric_limits<double>::infinity();
    for_each_place(scene, frame_, build.node(node), [&](const dvec3& place) { low = std::min(low, place.z); });
    return low;
  };
  tip_atoms_ = build.node("journey/tip-atoms");
  tip_.gap_m = lowest("journey/tip-atoms");
  // a ball about the axis goes through the lowest place of the apex and through its widest
  glm::dvec2 low(0.0, std::numeric_limits<double>::infinity()), wide(0.0);
  for_each_place(scene, frame_, build.node("journey/apex"), [&](const dvec3& place) {
    const glm::dvec2 seen(glm::length(glm::dvec2(place)), place.z);  // distance from the axis, and height
    if (seen.y < low.y) low = seen;
    if (seen.x > wide.x) wide = seen;
  });
  const double center_m = 0.5 * (glm::dot(wide, wide) - glm::dot(low, low)) / (wide.y - low.y);
  tip_.radius_m = glm::distance(low, glm::dvec2(0.0, center_m));
  tip_.lowest_m = center_m - tip_.radius_m;
  double edge = 0.0;
  for_each_place(scene, frame_, build.node("journey/tip"), [&](const dvec3& place) {
    tip_.height_m = std::max(tip_.height_m, place.z - tip_.lowest_m);
    edge = std::max(edge, glm::length(glm::dvec2(place)));
  });
  const double face = edge / std::sqrt(2.0);  // distance of a face; the pyramid is square
  tip_.slope = 0.5 * (edge + face) / tip_.height_m;
}

void Journey::place(double orders, std::vector<dmat4>& local) const {
  const double low = eased((orders - kLowFromOrders) / (kLowAtOrders - kLowFromOrders));
  const double tilt = kSampleTiltRad + (low_tilt_rad_ - kSampleTiltRad) * low;
  const double c = std::cos(tilt), s = std::sin(tilt);
  local[frame_] = glm::scale(frame_matrix({1, 0, 0}, {0, s, -c}, {0, c, s}, dvec3(0.0)), dvec3(scale_of(orders)));
  const double risen = eased((orders - atoms_at_orders_ + kAtomsRange) / kAtomsRange);
  for (const scene::NodeIndex atoms : ground_atoms_) {
    local[atoms] = glm::translate(local[atoms], dvec3(0.0, 0.0, -kAtomsHiddenM * (1.0 - risen)));
  }
  const double out = eased((orders - kTipAtomsAtOrders + kAtomsRange) / kAtomsRange);
  local[tip_atoms_] = glm::translate(local[tip_atoms_], dvec3(0.0, 0.0, kAtomsHiddenM * (1.0 - out)));
}

bool Journey::shows(scene::NodeIndex node, double orders, std::size_t ground) const {
  const auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.node == node; });
  if (part == parts_.end() || part->ground.value_or(ground) != ground) return false;
  const bool of_ground = std::find(ground_atoms_.begin(), ground_atoms_.end(), node) != ground_atoms_.end();
  if (of_ground && orders <= atoms_at_orders_ - kAtomsRange) return false;
  if (node == tip_atoms_ && orders <= kTipAtomsAtOrders - kAtomsRange) return false;
  const double scale = scale_of(orders);
  return part->nearest_m * scale < kBeyondFog && part->farthest_m * scale > kBelowPixel;
}

void Journey::shade(double orders, const dmat4& room_from_frame, double unit_m, render::FrameState& frame) const {
  const double cone = eased((orders - kMapToOrders) / (kConeFromOrders - kMapToOrders));
  const double close = eased((orders - kLightFromOrders) / (kJourneyOrders - kLightFromOrders));
  frame.key_light.map_share = static_cast<float>(1.0 - cone);
  const double per_m = glm::length(dvec3(room_from_frame[2]));
  const dvec3 axis = dvec3(room_from_frame[2]) / per_m;
  const dvec3 apex = dvec3(room_from_frame[3]) + tip_.lowest_m * dvec3(room_from_frame[2]);
  frame.cone = {.apex_m = glm::vec3(apex),
                .axis = glm::vec3(axis),
                .radius_m = static_cast<float>(tip_.radius_m * per_m),
                .slope = static_cast<float>(tip_.slope),
                .height_m = static_cast<float>(tip_.height_m * per_m),
                .share = static_cast<float>(cone * (1.0 - (1.0 - kShadeOfAtoms) * close))};
  const double radius = std::clamp(tip_.radius_m * per_m, kShadeRadius * unit_m, kWidestShade * unit_m);
  frame.outlined = atoms_;
  frame.contact = {.place_m = glm::vec3(apex), .shade_radius_m = static_cast<float>(cone * radius)};
}

std::optional<Journey::Companion> Journey::companion(double orders) const {
  // above their highest points, in metres (assets/generate/companions.cpp)
  static constexpr std::array<Companion, 4> kCompanions{{{Phrase::CompanionHair, {560e-6, 300e-6, 95e-6}},
                                                         {Phrase::CompanionCell, {-9.5e-6, 0.5e-6, 6e-6}},
                                                         {Phrase::CompanionVirus, {-118e-9, 10e-9, 105e-9}},
                                                         {Phrase::CompanionDna, {-21e-9, -1e-9, 3.2e-9}}}};
  constexpr double kNearest = 0.25, kFarthest = 1.15;  // layout units from the tip, for full visibility
  for (const Companion& companion : kCompanions) {
    const dvec3 place = companion.place * scale_of(orders);
    if (std::abs(place.x) > kNearest && std::abs(place.x) < kFarthest) return Companion{companion.name, place};
  }
  return std::nullopt;
}

void JourneyTravel::turn_round(std::int64_t now_ns) {
  update(now_ns);
  direction_ = -direction_;
}

void JourneyTravel::update(std::int64_t now_ns) {
  const double passed_s = static_cast<double>(now_ns - std::exchange(updated_ns_, now_ns)) * 1e-9;
  progress_s_ = std::clamp(progress_s_ + direction_ * passed_s, 0.0, kWholeS);
}

double JourneyTravel::fade() const {
  const auto veil = [&](double at_s) { return std::max(0.0, 1.0 - std::abs(progress_s_ - at_s) / kVeilS); };
  if (motion_ == Motion::Glide) return veil(kVeilS);
  const double nearest = std::clamp(std::round((progress_s_ - 2.0 * kVeilS) / kStepS), 1.0, kJourneyOrders);
  return std::max(veil(kVeilS), veil(2.0 * kVeilS + nearest * kStepS));
}

std::optional<double> JourneyTravel::orders() const {
  if (progress_s_ <= kVeilS) return std::nullopt;
  const double travelled_s = progress_s_ - 2.0 * kVeilS;
  if (motion_ == Motion::Steps) return std::clamp(std::floor(travelled_s / kStepS), 0.0, kJourneyOrders);
  return kJourneyOrders * eased(travelled_s / kTravelS);
}

}  // namespace afm::exhibit
