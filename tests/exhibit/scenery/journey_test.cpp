// SPDX-License-Identifier: Apache-2.0
// Invariant: the journey of scale is continuous, and the contact point does not move
#include "exhibit/scenery/journey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exhibit/scenery/wall_scene.h"
#include "support/paper_wall.h"

namespace afm::exhibit {
namespace journey_test {

class JourneyTest : public test::PaperWall {
 protected:
  render::FrameState frame(double orders, std::size_t material = 0) const {
    render::FrameState state;
    scene_.update({.material = material, .centerpiece = Centerpiece::Journey, .journey_orders = orders}, state);
    return state;
  }
  // The lowest and the highest z of a part, in the journey's frame, metres.
  std::pair<double, double> heights(const std::string& name) const {
    std::pair<double, double> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    const scene::NodeIndex part = node(name);
    const glm::dmat4 frame_from_node = ancestor_from_node(scene_.scene(), node("journey-frame"), part);
    for (const scene::Primitive& primitive : scene_.scene().meshes[*scene_.scene().nodes[part].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        const double z = (frame_from_node * glm::dvec4(glm::dvec3(vertex.position), 1.0)).z;
        range = {std::min(range.first, z), std::max(range.second, z)};
      }
    }
    return range;
  }
};

TEST_F(JourneyTest, LeavesTheContactPointWhereItIs) {
  render::FrameState still;
  scene_.update({.material = 0}, still);
  const glm::dvec3 contact(still.room_from_node[node("sample")][3]);
  for (double orders = 0.0; orders <= kJourneyOrders; orders += 0.01) {
    // matrix as passed to the renderer
    const glm::mat4 room_from_frame(frame(orders).room_from_node[node("journey-frame")]);
    EXPECT_LT(glm::distance(glm::dvec3(room_from_frame[3]), contact), 1e-6) << orders;
  }
}

TEST_F(JourneyTest, NamesAKnownThingOfTheScaleBesideTheTip) {
  const std::map<std::string, std::pair<double, std::string>> things{{"hair", {2.95, "human hair"}},
                                                                     {"red-cell", {4.8, "red blood cell"}},
                                                                     {"virus", {6.7, "virus"}},
                                                                     {"dna", {7.45, "DNA"}}};
  const double unit_m = scene_.panel_millimetre_m() * 1000.0;
  for (const auto& [thing, seen] : things) {
    const auto& [orders, name] = seen;
    const render::FrameState state = frame(orders);
    EXPECT_NE(state.visible[node("companions/" + thing)], 0) << thing;
    const auto label = std::find_if(state.labels.begin(), state.labels.end(),
                                    [&, wanted = name](const render::Label& l) { return l.text.starts_with(wanted); });
    ASSERT_NE(label, state.labels.end()) << thing;
    // over the thing, which reaches neither to the tip's axis nor up to its name
    const glm::dmat4 room_from_frame = state.room_from_node[node("journey-frame")];
    const auto [low, high] = heights("companions/" + thing);
    const glm::dvec3 middle = label->placement.lower_left_m + 0.5 * label->placement.right_m;
    const glm::dvec3 place(glm::inverse(room_from_frame) * glm::dvec4(middle, 1.0));
    EXPECT_GT(place.z, high) << thing;
    EXPECT_LT(place.z - high, 0.5 * unit_m / std::pow(10.0, orders)) << thing;
    EXPECT_GT(std::abs(place.x), 0.25 * unit_m / std::pow(10.0, orders)) << thing;
    for (const render::Label& other : state.labels) {
      if (other.text == label->text) continue;
      const glm::dvec3 apart = other.placement.lower_left_m - label->placement.lower_left_m;
      const bool beside =
          apart.x > glm::length(label->placement.right_m) || -apart.x > glm::length(other.placement.right_m);
      const bool above = apart.y > glm::length(label->placement.up_m) || -apart.y > glm::length(other.placement.up_m);
      EXPECT_TRUE(beside || above) << thing << ": " << other.text;
    }
  }
  for (const double orders : {0.0, 2.0, 4.0, 5.6, 7.76}) EXPECT_EQ(frame(orders).labels.size(), 11U) << orders;
}

TEST_F(JourneyTest, MarksItsRungOnALadderOfTenPowersAndNamesTheGap) {
  const auto marked = [&](double orders) {
    std::vector<std::string> texts;
    for (const render::Label& label : frame(orders).labels) {
      if (label.highlighted) texts.push_back(label.text);
    }
    return texts;
  };
  EXPECT_THAT(marked(0.0), testing::ElementsAre("1 m"));
  EXPECT_THAT(marked(2.6), testing::ElementsAre("1 mm"));
  EXPECT_THAT(marked(5.0), testing::ElementsAre("10 \u00b5m"));
  EXPECT_THAT(marked(9.0), testing::ElementsAre("1 nm"));
  const auto named = [&](double orders) {
    const std::vector<render::Label> labels = frame(orders).labels;
    return std::any_of(labels.begin(), labels.end(), [](const render::Label& l) { return l.text == "gap 0.6 nm"; });
  };
  EXPECT_FALSE(named(8.0));
  EXPECT_TRUE(named(9.0));
}

// The name of the gap was once beside the tip and pointed at nothing.
TEST_F(JourneyTest, DrawsTheGapThatItNames) {
  const double unit_m = scene_.panel_millimetre_m() * 1000.0;
  for (double orders = 7.95; orders <= kJourneyOrders; orders += 0.1) {
    const render::FrameState state = frame(orders);
    const auto label = std::find_if(state.labels.begin(), state.labels.end(),
                                    [](const render::Label& l) { return l.text == "gap 0.6 nm"; });
    for (const char* part : {"marks/gap", "marks/gap-low", "marks/gap-high"}) {
      EXPECT_EQ(state.visible[node(part)] != 0, label != state.labels.end()) << part << " at " << orders;
    }
    if (label == state.labels.end()) continue;
    const glm::dmat4& bar = state.room_from_node[node("marks/gap")];
    const glm::dvec3 low(bar[3]), high(bar[3] + bar[2]);
    const glm::dmat4 frame_from_room = glm::inverse(state.room_from_node[node("journey-frame")]);
    EXPECT_NEAR((frame_from_room * glm::dvec4(low, 1.0)).z, 0.0, 1e-13) << orders;
    EXPECT_NEAR((frame_from_room * glm::dvec4(high, 1.0)).z, heights("journey/tip-atoms").first, 1e-13) << orders;
    const glm::dvec3 right_end = label->placement.lower_left_m + label->placement.right_m + 0.5 * label->placement.up_m;
    EXPECT_GT(right_end.y, low.y) << orders;
    EXPECT_LT(right_end.y, high.y) << orders;
    EXPECT_LT(right_end.x, low.x - 0.02 * unit_m) << orders;
    EXPECT_GT(right_end.x, low.x - 0.08 * unit_m) << orders;
  }
}

TEST_F(JourneyTest, NamesTheApexWhileItsUndersideIsAllThatIsSeenOfIt) {
  for (double orders = 7.05; orders <= kJourneyOrders; orders += 0.1) {
    const std::vector<render::Label> labels = frame(orders).labels;
    const auto apex =
        std::find_if(labels.begin(), labels.end(), [](const render::Label& l) { return l.text.starts_with("apex"); });
    EXPECT_EQ(apex != labels.end(), orders > 7.8 && orders < 8.75) << orders;
    if (apex == labels.end()) continue;
    const render::PanelPlacement& place = apex->placement;
    for (const render::Label& other : labels) {
      if (other.text == apex->text) continue;
      const glm::dvec3 apart = other.placement.lower_left_m - place.lower_left_m;
      EXPECT_TRUE(apart.x > place.right_m.x || -apart.x > other.placement.right_m.x || apart.y > place.up_m.y ||
                  -apart.y > other.placement.up_m.y)
          << other.text << " at " << orders;
    }
  }
}

// The shade of the tip has the numbers of its model.
TEST_F(JourneyTest, ShadesWithTheBallAndThePyramidOfTheModel) {
  const render::FrameState state = frame(7.0);
  const double per_m = 1e7 * scene_.panel_millimetre_m() * 1000.0;
  EXPECT_NEAR(static_cast<double>(state.cone.radius_m) / per_m, 50e-9, 1e-9);
  EXPECT_NEAR(static_cast<double>(state.cone.height_m) / per_m, 6.2e-6, 0.1e-6);
  EXPECT_GT(state.cone.slope, 0.315F);  // a face at 17.5 degrees
  EXPECT_LT(state.cone.slope, 0.446F);  // an edge
}

// The shadow map covers 3.4 layout units: at the scales of the tip the shadow would end in mid-air.
TEST_F(JourneyTest, FadesFromTheShadowsOfTrianglesToTheTipsSoftShade) {
  double share = 1.0;
  for (double orders = 0.0; orders <= kJourneyOrders; orders += 0.05) {
    const render::FrameState state = frame(orders);
    if (orders < 7.0) {
      EXPECT_FLOAT_EQ(state.key_light.map_share + state.cone.share, 1.0F) << orders;
    }
    EXPECT_LE(static_cast<double>(state.key_light.map_share), share) << orders;
    EXPECT_LT(share - static_cast<double>(state.key_light.map_share), 0.2) << orders;
    share = static_cast<double>(state.key_light.map_share);
    // the cone's apex is near the contact point
    const glm::dvec3 contact(state.room_from_node[node("journey-frame")][3]);
    EXPECT_LT(glm::distance(glm::dvec3(state.cone.apex_m), contact), 0.71 * scene_.panel_millimetre_m() * 1000.0);
  }
  EXPECT_EQ(frame(4.0).cone.share, 0.0F);
  EXPECT_EQ(frame(5.0).key_light.map_share, 0.0F);
  EXPECT_NEAR(frame(8.0).cone.radius_m / frame(7.0).cone.radius_m, 10.0F, 1e-3F);
  render::FrameState instrument;
  scene_.update({.material = 0}, instrument);
  EXPECT_EQ(instrument.key_light.map_share, 1.0F);
  EXPECT_EQ(instrument.cone.share, 0.0F);
}

TEST_F(JourneyTest, ScalesByTheSameFactorOnEveryStepFromOneMetreToOneNanometre) {
  const auto scale = [&](double orders) {
    return glm::length(glm::dvec3(frame(orders).room_from_node[node("journey-frame")][0]));
  };
  EXPECT_NEAR(scale(0.0), 1.0, 1e-12);
  EXPECT_NEAR(scale(9.0) / 1e9, 1.0, 1e-12);
  const double step = std::pow(10.0, 0.05);
  for (double orders = 0.0; orders < 8.96; orders += 0.05) {
    EXPECT_NEAR(scale(orders + 0.05) / scale(orders), step, 1e-9 * step) << orders;
    EXPECT_NEAR(scale(orders) * scene_.journey_m_per_m(orders), 1.0, 1e-12);
  }
}

TEST_F(JourneyTest, HasFiniteTransformsAndSomethingToSeeEverywhere) {
  for (double orders = 0.0; orders <= kJourneyOrders; orders += 0.1) {
    const render::FrameState state = frame(orders);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < state.room_from_node.size(); ++i) {
      const glm::mat4 as_drawn(state.room_from_node[i]);
      for (glm::length_t column = 0; column < 4; ++column) {
        for (glm::length_t row = 0; row < 4; ++row) ASSERT_TRUE(std::isfinite(as_drawn[column][row])) << orders;
      }
      const bool part = is_below(scene_.scene(), node("journey-frame"), static_cast<scene::NodeIndex>(i));
      if (scene_.scene().nodes[i].mesh && state.visible[i] != 0 && part) ++shown;
    }
    EXPECT_GE(shown, 3U) << orders;
  }
}

TEST_F(JourneyTest, ShowsEachPartInItsTurn) {
  const std::map<std::string, std::pair<double, double>> seen{
      {"journey/bench", {0.0, 1.0}},     {"journey/instrument", {0.0, 2.0}}, {"journey/chip", {1.5, 4.0}},
      {"journey/lever", {3.0, 5.5}},     {"journey/tip", {4.0, 8.0}},        {"journey/apex", {6.0, 9.0}},
      {"journey/tip-atoms", {7.5, 9.0}}, {"ground-mica/atoms", {8.5, 9.0}}};
  for (const auto& [name, range] : seen) {
    for (double orders = range.first; orders <= range.second; orders += 0.25) {
      EXPECT_NE(frame(orders).visible[node(name)], 0) << name << " at " << orders;
    }
  }
  EXPECT_EQ(frame(6.0).visible[node("journey/bench")], 0);
  EXPECT_EQ(frame(1.0).visible[node("ground-mica/atoms")], 0);
}

// The atoms are below the ground while they fill only a part of the view; then all of them come out of it.
TEST_F(JourneyTest, LetsTheAtomsOutOfTheGroundOnceTheyFillTheView) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const std::string name = "ground-" + materials_.materials[material].name;
    const double top = heights(name + "/atoms").second;
    double before_m = -1.0;
    for (double orders = 7.5; orders <= kJourneyOrders; orders += 0.05) {
      const render::FrameState state = frame(orders, material);
      const glm::dmat4 room_from_frame = state.room_from_node[node("journey-frame")];
      const glm::dvec3 moved(glm::inverse(room_from_frame) * state.room_from_node[node(name + "/atoms")][3]);
      EXPECT_GE(moved.z, before_m - 1e-15) << name << " at " << orders;
      before_m = moved.z;
      if (orders < 8.3) {
        EXPECT_LT(top + moved.z, -0.25e-9) << name << " at " << orders;
      }
    }
    EXPECT_NEAR(before_m, 0.0, 1e-15) << name;
  }
}

TEST_F(JourneyTest, ShowsTheGroundOfTheMaterialAlone) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const render::FrameState state = frame(9.0, material);
    for (const scene::MaterialEntry& entry : materials_.materials) {
      const bool own = entry.name == materials_.materials[material].name;
      EXPECT_EQ(state.visible[node("ground-" + entry.name + "/atoms")] != 0, own) << entry.name;
    }
  }
}

// Half a nanometre lies between them, half a metre on the wall where it is largest: no depth buffer confuses them.
TEST_F(JourneyTest, TheTipAndTheSampleKeepTheirGap) {
  EXPECT_NEAR(heights("journey/apex").first, 0.7e-9, 0.02e-9);
  EXPECT_NEAR(heights("journey/tip-atoms").first, 0.6e-9, 0.05e-9);
  for (const scene::MaterialEntry& entry : materials_.materials) {
    for (const scene::Node& part : scene_.scene().nodes) {
      if (part.mesh && part.name.starts_with("ground-" + entry.name + "/")) {
        EXPECT_LT(heights(part.name).second, 0.1e-9) << part.name;
      }
    }
  }
}

// Two level faces at one height that overlap would flicker. Faces of one part never do; those of different parts must
// be apart by more than a part in ten thousand of the smaller one's size.
TEST_F(JourneyTest, NoTwoLevelFacesOfThePartsLieInOnePlane) {
  struct Face {
    std::size_t part = 0;
    double z = 0, size = 0;
    glm::dvec2 low{0.0}, high{0.0};
  };
  std::vector<Face> faces;
  for (scene::NodeIndex i = 0; i < scene_.scene().nodes.size(); ++i) {
    const scene::Node& part = scene_.scene().nodes[i];
    if (!part.mesh || !part.name.starts_with("journey/")) continue;
    const glm::dmat4 frame_from_node = ancestor_from_node(scene_.scene(), node("journey-frame"), i);
    for (const scene::Primitive& primitive : scene_.scene().meshes[*part.mesh].primitives) {
      for (std::size_t k = 0; k < primitive.indices.size(); k += 3) {
        glm::dvec3 p[3];
        for (std::size_t c = 0; c < 3; ++c) {
          p[c] = glm::dvec3(frame_from_node *
                            glm::dvec4(glm::dvec3(primitive.vertices[primitive.indices[k + c]].position), 1.0));
        }
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        if (std::abs(normal.z) < 0.99999 * glm::length(normal)) continue;
        Face face{.part = i, .z = p[0].z, .low = glm::dvec2(p[0]), .high = glm::dvec2(p[0])};
        for (const glm::dvec3& corner : p) {
          face.low = glm::min(face.low, glm::dvec2(corner));
          face.high = glm::max(face.high, glm::dvec2(corner));
        }
        face.size = glm::distance(face.low, face.high);
        faces.push_back(face);
      }
    }
  }
  std::size_t compared = 0;
  for (const Face& a : faces) {
    for (const Face& b : faces) {
      if (a.part >= b.part || a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y)
        continue;
      ++compared;
      EXPECT_GT(std::abs(a.z - b.z), 1e-4 * std::min(a.size, b.size))
          << scene_.scene().nodes[a.part].name << " and " << scene_.scene().nodes[b.part].name << " at " << a.z;
    }
  }
  EXPECT_GT(compared, 100U) << "looked at too little";
}

TEST(JourneyTravel, GoesThereAndBackWithoutACut) {
  JourneyTravel travel;
  std::int64_t now_ns = 5'000'000'000;
  travel.update(now_ns);
  EXPECT_FALSE(travel.away());
  travel.turn_round(now_ns);
  double before = 0.0;
  bool there = false;
  for (int i = 0; i < 2200; ++i) {
    now_ns += 10'000'000;
    travel.update(now_ns);
    if (travel.orders() && !there) {
      EXPECT_GT(travel.fade(), 0.97) << "what is shown changes where nothing can be seen";
      EXPECT_EQ(*travel.orders(), 0.0);
      there = true;
    }
    const double orders = travel.orders().value_or(0.0);
    EXPECT_GE(orders, before);
    EXPECT_LT(orders - before, 0.01);  // a fiftieth of the picture in a hundredth of a second
    before = orders;
  }
  EXPECT_EQ(before, kJourneyOrders);
  EXPECT_EQ(travel.fade(), 0.0);

  // turned round twice on the way back
  travel.turn_round(now_ns);
  for (const int steps : {700, 300, 2600}) {
    for (int i = 0; i < steps; ++i) {
      now_ns += 10'000'000;
      travel.update(now_ns);
      EXPECT_LT(std::abs(travel.orders().value_or(0.0) - before), 0.01);
      before = travel.orders().value_or(0.0);
    }
    if (steps != 2600) travel.turn_round(now_ns);
  }
  EXPECT_FALSE(travel.away());
  EXPECT_EQ(travel.orders(), std::nullopt);
}

TEST(JourneyTravel, InStepsChangesTheScaleOnlyWhereNothingIsSeen) {
  JourneyTravel travel(JourneyTravel::Motion::Steps);
  std::int64_t now_ns = 5'000'000'000;
  travel.update(now_ns);
  std::set<double> clear;  // scales at which everything was visible
  double before = 0.0;
  for (const int steps : {1210, 300, 2200, 3000}) {
    travel.turn_round(now_ns);
    for (int i = 0; i < steps; ++i) {
      now_ns += 10'000'000;
      travel.update(now_ns);
      const double orders = travel.orders().value_or(0.0);
      if (orders != before) {
        EXPECT_GT(travel.fade(), 0.97) << "at " << orders;
        EXPECT_EQ(std::abs(orders - before), 1.0);
      }
      before = orders;
      if (travel.fade() == 0.0) clear.insert(orders);
    }
  }
  EXPECT_EQ(clear.size(), 10U);
  EXPECT_EQ(*clear.rbegin(), kJourneyOrders);
  EXPECT_FALSE(travel.away());
}

}  // namespace journey_test
}  // namespace afm::exhibit
