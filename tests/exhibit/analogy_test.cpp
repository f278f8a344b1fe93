// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "exhibit/scenery/wall_scene.h"
#include "support/paper_wall.h"

namespace afm::exhibit {
namespace analogy_test {

class AnalogyTest : public test::PaperWall {
 protected:
  render::FrameState frame(const scene::Tip& tip) const {
    render::FrameState state;
    scene_.update({.material = 0, .tip = tip, .centerpiece = Centerpiece::Analogy}, state);
    return state;
  }
  // Height over the plate along its normal, metres of the wall.
  double height(const scene::Tip& tip, const std::string& part) const {
    const render::FrameState state = frame(tip);
    const auto place = [&](const std::string& name) {
      return glm::dvec3(state.room_from_node[scene_.scene().find_node(name).value()][3]);
    };
    return glm::dot(place("analogy/" + part) - place("analogy/plate"), scene_.sample_normal());
  }
};

TEST_F(AnalogyTest, TheHandFollowsZAndTheMagnetTheTip) {
  const scene::Tip rest{.z_m = 0.0, .deflection_m = 0.0};
  const double hand_at_rest = height(rest, "hand");
  const double unit = height({.z_m = 1e-9, .deflection_m = 0.0}, "magnet") / 1e-9;
  EXPECT_GT(unit, 0.0);
  EXPECT_NEAR(height(rest, "magnet"), 0.0, 1e-12);
  for (const double z_m : {-3e-9, 1e-9, 9e-9}) {
    for (const double deflection_m : {-2e-9, 0.0, 0.8e-9, 9e-9}) {
      const scene::Tip tip{.z_m = z_m, .deflection_m = deflection_m};
      EXPECT_NEAR(height(tip, "magnet"), (z_m - deflection_m) * unit, 1e-9);
      EXPECT_NEAR(height(tip, "hand") - hand_at_rest, z_m * unit, 1e-6);
    }
  }
}

TEST_F(AnalogyTest, TheSpringReachesFromTheMagnetToTheHand) {
  for (const double deflection_m : {-2e-9, 0.0, 9e-9}) {
    const scene::Tip tip{.z_m = 9e-9, .deflection_m = deflection_m};
    const render::FrameState state = frame(tip);
    const scene::NodeIndex spring = scene_.scene().find_node("analogy/spring").value();
    double low = 1e9, high = -1e9;
    for (const scene::Primitive& primitive : scene_.scene().meshes[*scene_.scene().nodes[spring].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        const glm::dvec3 place(state.room_from_node[spring] * glm::dvec4(glm::dvec3(vertex.position), 1.0));
        const double above = glm::dot(place, scene_.sample_normal());
        low = std::min(low, above);
        high = std::max(high, above);
      }
    }
    const glm::dvec3 panel_background(state.room_from_node[scene_.scene().find_node("analogy/plate").value()][3]);
    const double plate_height = glm::dot(panel_background, scene_.sample_normal());
    EXPECT_NEAR(high - plate_height, height(tip, "hand"), 1e-6);
    EXPECT_NEAR(low - plate_height, height(tip, "magnet") + 0.17, 0.02);
  }
}

TEST_F(AnalogyTest, ReplacesTheInstrumentWithItsPartsNamed) {
  const render::FrameState state = frame({.z_m = 5e-9});
  const auto visible = [&](const std::string& name) {
    return state.visible[scene_.scene().find_node(name).value()] != 0;
  };
  EXPECT_TRUE(visible("analogy/magnet"));
  EXPECT_FALSE(visible("probe/cantilever"));
  EXPECT_FALSE(visible("sample-mica/surface"));
  std::string text;
  for (const render::Label& label : state.labels) text += label.text + "; ";
  EXPECT_NE(text.find("spring = cantilever; magnet = tip; iron plate = sample; "), std::string::npos) << text;
}

// The displayed analogy has no effect on the force of the servo.
TEST_F(AnalogyTest, TheServoFeelsTheSameSampleWhateverIsShown) {
  using enum Centerpiece;
  const std::size_t sample = scene_.sample_node();
  const auto shown = scene_.node_transforms({.material = 0, .tip = {.z_m = 4e-9}});
  for (const auto centerpiece : {Plot, Analogy, Journey}) {
    const auto other = scene_.node_transforms(
        {.material = 0, .tip = {.z_m = 4e-9}, .centerpiece = centerpiece, .journey_orders = 6.5});
    EXPECT_EQ(other[sample], shown[sample]);
  }
}

}  // namespace analogy_test
}  // namespace afm::exhibit
