// SPDX-License-Identifier: Apache-2.0
// The lever, its light and its marks, as the viewer of the paper's wall sees them.
// Invariant: the light hits the lever's upper face at every bend; the lifted tip stays below the banner
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <string>
#include <utility>

#include "exhibit/frame/frame_builder.h"
#include "exhibit/scenery/wall_scene.h"
#include "physics/beam_shape.h"
#include "physics/contact.h"
#include "support/paper_wall.h"
#include "support/sweet_spot.h"

namespace afm::exhibit {
namespace instrument_test {

constexpr double kLeastAbove = 0.1;  // sine of the light's angle with the lever's face

class InstrumentTest : public test::PaperWall {
 protected:
  double z_joc(std::size_t material) const {
    return physics::approach_retract_events(materials_.materials[material].contact).z_joc.si;
  }

  render::FrameState frame(const WallState& state) const {
    render::FrameState frame;
    scene_.update(state, frame);
    return frame;
  }

  glm::dvec3 seen_on_wall(const glm::dvec3& place) const {
    const glm::dvec3 eye = wall_.viewers.front().sweet_spot.position_m;
    return eye + (place - eye) * (eye.z / (eye.z - place.z));
  }

  // The highest place on the wall where a vertex below the node is seen that no panel in the wall's plane hides.
  double highest_before_wall(const render::FrameState& frame, const std::string& root) const {
    double highest = -1e9;
    for (scene::NodeIndex i = 0; i < scene_.scene().nodes.size(); ++i) {
      const auto& mesh = scene_.scene().nodes[i].mesh;
      if (!mesh || frame.visible[i] == 0 || !scene_.scene().nodes[i].name.starts_with(root)) continue;
      for (const scene::Primitive& primitive : scene_.scene().meshes[*mesh].primitives) {
        for (const scene::Vertex& vertex : primitive.vertices) {
          const glm::dvec3 place(frame.room_from_node[i] * glm::dvec4(glm::dvec3(vertex.position), 1.0));
          if (place.z > 0.0) highest = std::max(highest, seen_on_wall(place).y);
        }
      }
    }
    return highest;
  }

  // Expects no drawn object between an eye and the panel.
  void expect_before_all(const render::FrameState& frame, const render::PanelPlacement& panel, scene::Eye which,
                         double share) const {
    const scene::Viewer& viewer = wall_.viewers.front();
    const glm::dvec3 eye = scene::eye_position(viewer.sweet_spot, which, viewer.ipd_m);
    for (scene::NodeIndex i = 0; i < scene_.scene().nodes.size(); ++i) {
      const auto& mesh = scene_.scene().nodes[i].mesh;
      if (!mesh || frame.visible[i] == 0) continue;
      for (const scene::Primitive& primitive : scene_.scene().meshes[*mesh].primitives) {
        for (const scene::Vertex& vertex : primitive.vertices) {
          const glm::dvec3 place(frame.room_from_node[i] * glm::dvec4(glm::dvec3(vertex.position), 1.0));
          if (place.z <= panel.lower_left_m.z || place.z >= eye.z) continue;
          const glm::dvec3 seen = eye + (place - eye) * ((eye.z - panel.lower_left_m.z) / (eye.z - place.z));
          const glm::dvec3 from = seen - panel.lower_left_m;
          const bool covered = from.x > 0.0 && from.x < panel.right_m.x && from.y > 0.0 && from.y < panel.up_m.y;
          EXPECT_FALSE(covered) << scene_.scene().nodes[i].name << " at " << share;
          if (covered) return;
        }
      }
    }
  }

  glm::dvec3 origin(const render::FrameState& frame, const std::string& name) const {
    return glm::dvec3(frame.room_from_node[node(name)][3]);
  }
};

TEST_F(InstrumentTest, TheLiftedTipAndHandleStayBelowTheBanner) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const scene::Tip lifted{.z_m = 1.4 * z_joc(material)};
    const render::FrameState instrument = frame({.material = material, .tip = lifted});
    const double banner_y = instrument.panels.banner.placement.lower_left_m.y;
    EXPECT_LT(highest_before_wall(instrument, "probe/"), banner_y) << material;
    EXPECT_GT(highest_before_wall(instrument, "probe/"), banner_y - 0.3) << "the stroke uses the room that there is";
    const render::FrameState analogy =
        frame({.material = material, .tip = lifted, .centerpiece = Centerpiece::Analogy});
    EXPECT_LT(highest_before_wall(analogy, "analogy/"), banner_y) << material;
  }
}

// Bends from the deepest push to the pull-off; the tip is at the sample, and the lever bends by Z.
TEST_F(InstrumentTest, TheLightMeetsTheLeversUpperFaceAtEveryBend) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    for (double share = -0.6; share <= 1.0; share += 0.05) {
      const double z_m = share * z_joc(material);
      const render::FrameState state = frame({.material = material, .tip = {.z_m = z_m, .deflection_m = z_m}});
      const glm::dmat4& room_from_lever = state.room_from_node[node("probe/cantilever")];
      const glm::dmat4 lever_from_room = glm::inverse(room_from_lever);
      const double length = static_cast<double>(state.bends.front().length),
                   end_z = static_cast<double>(state.bends.front().end_deflection);
      const double slope = physics::beam_slope(1.0) * end_z / length;
      const glm::dvec3 face = glm::normalize(glm::dmat3(room_from_lever) * glm::dvec3(-slope, 0.0, 1.0));

      const glm::dvec3 lit = origin(state, "optics/beam-reflected");
      const glm::dvec3 on_lever(lever_from_room * glm::dvec4(lit, 1.0));
      EXPECT_NEAR(on_lever.x, length, 0.02 * length) << share;
      EXPECT_NEAR(on_lever.z, end_z, 0.02 * length) << share;
      for (const char* part : {"optics/laser", "optics/spot"}) {
        const glm::dvec3 to_part = origin(state, part) - lit;
        EXPECT_GT(glm::dot(face, glm::normalize(to_part)), kLeastAbove) << part << " " << share;
        // the light stays above the lever all the way, also where the lever bends up towards the chip
        for (double way = 0.1; way <= 1.0; way += 0.1) {
          const glm::dvec3 there(lever_from_room * glm::dvec4(lit + way * to_part, 1.0));
          const double along = std::clamp(there.x / length, 0.0, 1.0);
          EXPECT_GT(there.z, end_z * physics::beam_deflection(along)) << part << " " << share << " " << way;
        }
      }
    }
  }
}

// Above particles a raised hand lifts it beyond the banner: the laser shone upwards out of the picture.
TEST_F(InstrumentTest, NoLightFollowsALeverThatIsLiftedOutOfThePicture) {
  for (const double height : {1.3, 6.0}) {
    WallState state{.material = 0};
    state.tip.z_m = height * z_joc(0);
    const render::FrameState lifted = frame(state);
    const auto radius = [&](const char* part) { return glm::length(glm::dvec3(lifted.room_from_node[node(part)][0])); };
    for (const char* part : {"optics/beam", "optics/beam-reflected", "optics/spot"}) {
      EXPECT_EQ(radius(part) > 1e-4, height < 2.0) << part << " at " << height;
    }
    EXPECT_LT(lifted.room_from_node[node("optics/laser")][2].y, 0.0) << height;
  }
}

TEST_F(InstrumentTest, LaserAndPhotodiodeAreSeenBelowTheBannerAndBetweenThePanels) {
  const render::FrameState state = frame({.material = 0});
  for (const char* part : {"optics/laser", "optics/spot"}) {
    const glm::dvec3 seen = seen_on_wall(origin(state, part));
    EXPECT_LT(seen.y, state.panels.banner.placement.lower_left_m.y) << part;
    EXPECT_GT(seen.x, state.panels.force.placement.lower_left_m.x + state.panels.force.placement.right_m.x) << part;
    EXPECT_LT(seen.x, state.panels.data.placement.lower_left_m.x) << part;
  }
}

// At the height of the contact, the empty stage would cover the panels' lower corners.
TEST_F(InstrumentTest, TheEmptyStageIsWhereItIsBelowASample) {
  const auto stage_m = [&](std::optional<std::size_t> material) {
    render::FrameState state;
    scene_.update({.material = material}, state);
    return glm::dvec3(state.room_from_node[node("stage/stage")][3]);
  };
  EXPECT_EQ(stage_m(std::nullopt), stage_m(0));
  EXPECT_LT(stage_m(std::nullopt).y, scene_.contact_m().y - 0.1 * scene_.unit_m());
}

TEST_F(InstrumentTest, TheMarksOfTheUnbentLeverPassBesideTheTipAndOverTheSample) {
  const double tip_half_width = [&] {
    double widest = 0.0;
    const render::FrameState state = frame({.material = 0});
    const glm::dmat4 sample_from_room = glm::inverse(state.room_from_node[node("sample")]);
    for (const scene::Primitive& primitive :
         scene_.scene().meshes[*scene_.scene().nodes[node("probe/tip")].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        const glm::dvec4 place(glm::dvec3(vertex.position), 1.0);
        widest = std::max(widest,
                          glm::length(glm::dvec2(sample_from_room * state.room_from_node[node("probe/tip")] * place)));
      }
    }
    return widest;
  }();
  int shown = 0;
  for (double share = -0.6; share <= 1.0; share += 0.05) {
    const double z_m = share * z_joc(0);
    const render::FrameState state = frame({.material = 0, .tip = {.z_m = z_m, .deflection_m = z_m}});
    const glm::dmat4 sample_from_room = glm::inverse(state.room_from_node[node("sample")]);
    for (const char* mark : {"marks/unbent", "marks/push", "marks/pull", "marks/push-head", "marks/pull-head"}) {
      const glm::dmat4 sample_from_mark = sample_from_room * state.room_from_node[node(mark)];
      if (glm::length(glm::dvec3(sample_from_mark[2])) == 0.0) continue;  // hidden mark
      ++shown;
      for (double way = 0.0; way <= 1.0; way += 0.02) {
        const glm::dvec3 there(sample_from_mark * glm::dvec4(0.0, 0.0, way, 1.0));
        EXPECT_GT(glm::length(glm::dvec2(there)), tip_half_width) << mark << " " << share;
        EXPECT_GT(there.z, 0.0) << mark << " " << share;
      }
    }
  }
  EXPECT_GT(shown, 40);
}

// After a pull-off the former lever remains where the tip let go, and the word of the jump is clear of tip and sample.
TEST_F(InstrumentTest, AGhostOfTheLeverHangsWhereTheTipLetGo) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const double release_m = z_joc(material);
    const scene::Tip free{.z_m = release_m, .deflection_m = 0.0};
    WallState state{.material = material, .tip = free};
    EXPECT_EQ(frame(state).visible[node("probe-ghost")], 0) << "nothing has happened";
    state.cue = {.kind = physics::EventKind::JumpToContact, .force_n = -1e-10F, .age_s = 0.1};
    EXPECT_EQ(frame(state).visible[node("probe-ghost")], 0) << "it has snapped in";
    state.cue->kind = physics::EventKind::JumpOffContact;
    const render::FrameState shown = frame(state);
    ASSERT_EQ(shown.visible[node("probe-ghost")], 1);
    ASSERT_EQ(shown.bends.size(), 2U);
    EXPECT_EQ(shown.bends.back().node, node("probe-ghost"));
    // before the jump: the lever bent by all of the height
    const render::FrameState before =
        frame({.material = material, .tip = {.z_m = release_m, .deflection_m = release_m}});
    EXPECT_NEAR(shown.bends.back().end_deflection, before.bends.front().end_deflection,
                1e-3F * std::abs(before.bends.front().end_deflection));
    EXPECT_LT(glm::distance(origin(shown, "probe-ghost"), origin(before, "probe/cantilever")), 1e-3);
    state.centerpiece = Centerpiece::Analogy;
    EXPECT_EQ(frame(state).visible[node("probe-ghost")], 0);
  }
}

TEST_F(InstrumentTest, TheWordOfAJumpIsHiddenByNothingAtAnyHeight) {
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    std::optional<render::PanelPlacement> first;
    for (double share = -0.3; share <= 1.4; share += 0.1) {
      for (const double bent : {0.0, share}) {
        const double z_m = share * z_joc(material);
        const WallState state{
            .material = material,
            .tip = {.z_m = z_m, .deflection_m = bent * z_joc(material)},
            .cue = JumpCue{.kind = physics::EventKind::JumpOffContact, .force_n = -1e-9F, .age_s = 0.5}};
        const render::FrameState shown = frame(state);
        const render::PanelPlacement& word = shown.labels.back().placement;
        EXPECT_EQ(first.value_or(word), word) << "it moves with the tip";
        first = word;
        for (const scene::Eye eye : scene::kEyes) expect_before_all(shown, word, eye, share);
        const render::PanelPlacement& panel = shown.panels.force.placement;
        EXPECT_GT(word.lower_left_m.x, panel.lower_left_m.x + panel.right_m.x);
      }
    }
  }
}

TEST_F(InstrumentTest, TheArrowOfTheForcePointsAsTheForceActsAndIsAsLongAsTheBend) {
  const auto arrow = [&](double deflection_m, const std::string& name) {
    const render::FrameState state = frame({.material = 0, .tip = {.z_m = 5e-9, .deflection_m = deflection_m}});
    const glm::dmat4 sample_from_room = glm::inverse(state.room_from_node[node("sample")]);
    const auto along = [&](const std::string& part) {
      const glm::dmat4 sample_from_part = sample_from_room * state.room_from_node[node("marks/" + part)];
      return sample_from_part[2].z;
    };
    return along(name) + along(name + "-head");
  };
  for (const double bent_m : {2e-9, 4e-9}) {
    // a positive deflection is towards the sample
    EXPECT_LT(arrow(bent_m, "pull"), 0.0);
    EXPECT_EQ(arrow(bent_m, "push"), 0.0);
    EXPECT_GT(arrow(-bent_m, "push"), 0.0);
    EXPECT_EQ(arrow(-bent_m, "pull"), 0.0);
  }
  EXPECT_NEAR(arrow(4e-9, "pull") / arrow(2e-9, "pull"), 2.0, 0.1);
  for (const char* name : {"push", "pull"}) EXPECT_EQ(arrow(0.0, name), 0.0) << name;
}

// The band reaches as far as the tip swings, on the sample's scale.
class SwingTest : public InstrumentTest {
 protected:
  static constexpr double kSwingM = 2e-9;

  static WallState tapping(double z_m, double deflection_m = 0.1e-9) {
    return {.material = 0, .tip = {.z_m = z_m, .deflection_m = deflection_m}, .swing = {.amplitude_m = kSwingM}};
  }

  // Height of the apex of a node with the tip's mesh above the place below the tip, metres of the nanoworld.
  double apex_m(const render::FrameState& frame, const std::string& name) const {
    const glm::dmat4 sample_from_node =
        glm::inverse(frame.room_from_node[node("sample")]) * frame.room_from_node[node(name)];
    double lowest = HUGE_VAL;
    for (const scene::Primitive& primitive : scene_.scene().meshes[*scene_.scene().nodes[node(name)].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        lowest = std::min(lowest, (sample_from_node * glm::dvec4(glm::dvec3(vertex.position), 1.0)).z);
      }
    }
    return lowest * scene_.unit_m() * scene_.drawn_scale(0).sample_m_per_m;
  }
};

TEST_F(SwingTest, OfALeverThatDoesNotTapIsNotDrawn) {
  WallState still = tapping(6e-9);
  still.swing = {};
  WallState elsewhere = tapping(6e-9);
  elsewhere.centerpiece = Centerpiece::Analogy;
  for (const char* name : {"probe-band", "probe-turn-high", "probe-turn-low"}) {
    EXPECT_EQ(frame(still).visible[node(name)], 0) << name;
    EXPECT_EQ(frame(elsewhere).visible[node(name)], 0) << name;
    EXPECT_EQ(frame(tapping(6e-9)).visible[node(name)], 1) << name;
  }
  EXPECT_EQ(frame(still).bends.size(), 1U);
}

TEST_F(SwingTest, TurnsWhereTheTipTurns) {
  for (const double z_m : {2e-9, 4e-9, 6e-9}) {
    const render::FrameState shown = frame(tapping(z_m));
    // the tip's rounded end is lowest where the tip is upright
    EXPECT_NEAR(apex_m(shown, "probe-turn-high"), z_m - 0.1e-9 + kSwingM, 0.05e-9) << z_m;
    EXPECT_NEAR(apex_m(shown, "probe-turn-low"), z_m - 0.1e-9 - kSwingM, 0.05e-9) << z_m;
  }
}

TEST_F(SwingTest, IsSlowedDownByTheStroboscope) {
  for (const auto& [turns, way] : {std::pair{0.0, -1.0}, {0.25, 0.0}, {0.5, 1.0}, {0.75, 0.0}, {1.0, -1.0}}) {
    WallState state = tapping(5e-9);
    state.stroboscope = true;
    state.strobe_turns = turns;
    EXPECT_NEAR(apex_m(frame(state), "probe/tip"), 4.9e-9 + way * kSwingM, 0.05e-9) << turns;
    EXPECT_NEAR(apex_m(frame(state), "probe-turn-low"), 4.9e-9 - kSwingM, 0.05e-9) << turns;
    state.stroboscope = false;
    EXPECT_NEAR(apex_m(frame(state), "probe/tip"), 4.9e-9, 0.05e-9) << turns;
  }
}

TEST_F(SwingTest, LeavesTheArrowOfTheForceToTheMeanDeflection) {
  WallState state = tapping(5e-9, 1.5e-9);
  const auto pull = [&] {
    const render::FrameState shown = frame(state);
    return (glm::inverse(shown.room_from_node[node("sample")]) * shown.room_from_node[node("marks/pull")])[2].z;
  };
  const double mean = pull();
  EXPECT_LT(mean, 0.0);
  state.stroboscope = true;
  for (const double turns : {0.0, 0.3, 0.5}) {
    state.strobe_turns = turns;
    EXPECT_NEAR(pull(), mean, 1e-9) << turns;
  }
}

TEST_F(SwingTest, FillsABandBetweenTheTurns) {
  const render::FrameState shown = frame(tapping(5e-9));
  const auto bend = std::find_if(shown.bends.begin(), shown.bends.end(),
                                 [&](const render::BeamBend& one) { return one.node == node("probe-band"); });
  ASSERT_NE(bend, shown.bends.end());
  const auto length = static_cast<double>(bend->length), middle = static_cast<double>(bend->end_deflection);
  const glm::dmat4& room_from_band = shown.room_from_node[node("probe-band")];
  for (const auto& [name, side] : {std::pair{"probe-turn-high", 1.0}, std::pair{"probe-turn-low", -1.0}}) {
    const glm::dvec3 end(room_from_band * glm::dvec4(length, 0.0, middle + side, 1.0));
    EXPECT_LT(glm::distance(end, origin(shown, name)), 1e-6) << name;
  }
  // the outline of the lever, whose clamp does not move
  const scene::Mesh& band = scene_.scene().meshes[*scene_.scene().nodes[node("probe-band")].mesh];
  const scene::Mesh& lever = scene_.scene().meshes[*scene_.scene().nodes[node("probe/cantilever")].mesh];
  const auto span = [](const scene::Mesh& mesh) {
    glm::vec2 low(HUGE_VALF), high(-HUGE_VALF);
    for (const scene::Primitive& primitive : mesh.primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        low = glm::min(low, glm::vec2(vertex.position));
        high = glm::max(high, glm::vec2(vertex.position));
      }
    }
    return high - low;
  };
  EXPECT_NEAR(span(band).x / span(lever).x, 1.0F, 0.05F);
  EXPECT_NEAR(span(band).y / span(lever).y, 1.0F, 0.1F);
  for (const scene::Vertex& vertex : band.primitives.front().vertices) {
    const double shape = physics::beam_deflection(static_cast<double>(vertex.position.x) / length);
    EXPECT_NEAR(std::abs(static_cast<double>(vertex.position.z)), shape, 1e-6);
  }
}

// A closed surface, each triangle of which is seen from outside: its volume is that of the band.
TEST_F(SwingTest, HasABandWithoutHoles) {
  const scene::Primitive& band =
      scene_.scene().meshes[*scene_.scene().nodes[node("probe-band")].mesh].primitives.front();
  double volume = 0.0, sheets = 0.0;
  for (std::size_t i = 0; i + 2 < band.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(band.vertices[band.indices[i + k]].position); };
    const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    const double area = 0.5 * glm::cross(b - a, c - a).z;  // area seen from above
    if (area > 0.0) sheets += 2.0 * area * (a.z + b.z + c.z) / 3.0;
  }
  EXPECT_GT(sheets, 0.0);
  EXPECT_NEAR(volume / sheets, 1.0, 1e-3);
}

TEST_F(InstrumentTest, ATipWithoutForceRestsOnTheSampleUntilItIsLifted) {
  const curves::ContactSetup mica{materials_.materials[0], {}, {}};
  const std::vector<curves::SampleModel> felt{curves::make_sample_model(mica).value()};
  const FrameBuilder frames(scene_, felt, support::eyes_at_sweet_spot(wall_));
  Moment moment;
  moment.wall = {.material = 0, .tip = {.z_m = -5e-9}};
  moment.phase = physics::Phase::WaitForLift;
  EXPECT_NEAR(glm::distance(glm::dvec3(frames.build(moment).room_from_node[node("probe/apex")][3]), scene_.contact_m()),
              0.0, 1e-6);
}

}  // namespace instrument_test
}  // namespace afm::exhibit
