// SPDX-License-Identifier: Apache-2.0
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace material_test {

using scene::TextureSlot;

// The wall's middle is at (0, 0); a metre is 84 pixels.
constexpr std::uint32_t kMiddleX = 128, kMiddleY = 96;

// A square of two metres that fills the picture's middle, its material unlit unless a test says otherwise: colours are
// then what the texture holds.
class Materials : public VulkanTest {
 protected:
  Materials() {
    material_.unlit = true;
    square_ = quad(0);
    for (const scene::Vertex& vertex : square_.vertices) {
      const glm::vec2 place(vertex.position.x + 0.5F, 0.5F - vertex.position.y);  // v runs downwards
      square_.texture_coordinates.push_back({place, place});
    }
  }

  // Two by two pixels: red, green; blue, grey of 128 that is half seen through.
  void add_image(scene::TextureFilter filter) {
    scene_.images.push_back({.name = "four",
                             .width = 2,
                             .height = 2,
                             .rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 128, 128, 128, 128}});
    scene_.textures.push_back({.image = 0, .magnified = filter, .minified = filter, .between_mips = {}});
  }

  render::Image see(const glm::dmat4& room_from_node = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0))) {
    scene_.materials = {material_};
    scene_.nodes.clear();
    scene_.meshes.clear();
    add(scene_, "square", square_, room_from_node);
    render::FrameState frame = bare_frame(scene_);
    frame.lights = lights_;
    return draw(scene_, frame, small()).left;
  }

  // Left or right of the middle, above or below it.
  static Pixel at(const render::Image& image, int right, int down) {
    return pixel(image, static_cast<std::uint32_t>(static_cast<int>(kMiddleX) + 40 * right),
                 static_cast<std::uint32_t>(static_cast<int>(kMiddleY) + 40 * down));
  }

  scene::Scene scene_;
  scene::PbrMaterial material_;
  scene::Primitive square_;
  std::vector<render::PlacedLight> lights_;
};

void expect_color(const Pixel& pixel, int r, int g, int b) {
  EXPECT_NEAR(pixel.r, r, 3);
  EXPECT_NEAR(pixel.g, g, 3);
  EXPECT_NEAR(pixel.b, b, 3);
}

TEST_F(Materials, IgnoreTheirVerticesAlphaUnlessTheyBlend) {
  square_.texture_coordinates.clear();
  for (scene::Vertex& vertex : square_.vertices) vertex.color = glm::vec4(1.0F, 0.0F, 0.0F, 0.0F);
  expect_color(at(see(), 0, 0), 255, 0, 0);
}

TEST_F(Materials, ShareOnePipelineThatShowTheSameKindsOfTexture) {
  add_image(scene::TextureFilter::Nearest);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    material_.roughness = static_cast<float>(i) / 2000.0F;
    material_.texture(TextureSlot::BaseColor).texture = 0;
    scene_.materials.push_back(material_);
    square_.material = i;
    scene_.meshes.push_back({.name = "square", .primitives = {square_}});
  }
  scene_.nodes.push_back({"one", std::nullopt, 0U, glm::dmat4(1.0)});
  EXPECT_TRUE(render::Renderer::create(context_, scene_, small()));
}

TEST_F(Materials, AreRefusedWhereTheyNeedTooManyPipelines) {
  add_image(scene::TextureFilter::Nearest);
  for (std::uint32_t i = 1; i <= 300; ++i) {
    scene::PbrMaterial& material = scene_.materials.emplace_back();
    for (std::uint32_t slot = 0; slot < scene::kTextureSlots; ++slot) {
      if ((i >> slot & 1U) != 0) material.textures[slot].texture = 0;
    }
    square_.material = i - 1;
    scene_.meshes.push_back({.name = "square", .primitives = {square_}});
  }
  const auto renderer = render::Renderer::create(context_, scene_, small());
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_NE(renderer.error().message.find("300 combinations of textures"), std::string::npos)
      << renderer.error().message;
}

TEST_F(Materials, ShowATextureTheRightWayUpInItsOwnColours) {
  add_image(scene::TextureFilter::Nearest);
  material_.texture(TextureSlot::BaseColor).texture = 0;
  const render::Image image = see();
  expect_color(at(image, -1, -1), 255, 0, 0);
  expect_color(at(image, 1, -1), 0, 255, 0);
  expect_color(at(image, -1, 1), 0, 0, 255);
  expect_color(at(image, 1, 1), 128, 128, 128);
}

TEST_F(Materials, MoveATextureAsItsTransformSays) {
  add_image(scene::TextureFilter::Nearest);
  auto& use = material_.texture(TextureSlot::BaseColor);
  use.texture = 0;
  use.offset = {0.5F, 0.0F};
  expect_color(at(see(), -1, -1), 0, 255, 0);
  use.offset = {0.0F, 1.0F};
  use.rotation_rad = 1.5707963F;  // (u, v) becomes (v, 1 - u)
  expect_color(at(see(), -1, -1), 0, 0, 255);
  expect_color(at(see(), -1, 1), 128, 128, 128);
  use.coordinates = 1;
  for (auto& coordinates : square_.texture_coordinates) coordinates.set_0 = glm::vec2(0.0F);
  expect_color(at(see(), -1, -1), 0, 0, 255);
}

TEST_F(Materials, MixColoursOfATextureAsLight) {
  add_image(scene::TextureFilter::Linear);
  scene_.images[0].rgba = {255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255};
  material_.texture(TextureSlot::BaseColor).texture = 0;
  const Pixel middle = pixel(see(), kMiddleX, kMiddleY);
  EXPECT_NEAR(middle.g, 188, 6) << "half the light is 188 of 255 in sRGB, not 128";
}

TEST_F(Materials, LeaveOutWhatAMaskSaysIsNotThere) {
  add_image(scene::TextureFilter::Nearest);
  material_.texture(TextureSlot::BaseColor).texture = 0;
  material_.alpha_cutoff = 0.6F;
  const render::Image image = see();
  expect_color(at(image, 1, -1), 0, 255, 0);
  EXPECT_LT(at(image, 1, 1).r, 110) << "the background is seen";
  material_.alpha_cutoff = 0.4F;
  expect_color(at(see(), 1, 1), 128, 128, 128);
}

TEST_F(Materials, BlendByTheAlphaOfATexture) {
  add_image(scene::TextureFilter::Nearest);
  material_.texture(TextureSlot::BaseColor).texture = 0;
  const Pixel background = at(see(glm::translate(glm::dmat4(1.0), glm::dvec3(50, 0, 0))), 1, 1);
  material_.blended = true;
  const Pixel half = at(see(), 1, 1);
  EXPECT_NEAR(half.g, (128 + background.g) / 2, 4);
}

TEST_F(Materials, ShowTheFrontOfANodeThatMirrors) {
  material_.base_color = glm::vec4(1.0F);
  const glm::dmat4 mirrored = glm::scale(glm::dmat4(1.0), glm::dvec3(-2.0, 2.0, 2.0));
  expect_color(at(see(mirrored), -1, -1), 255, 255, 255);
  const glm::dmat4 turned = glm::scale(glm::dmat4(1.0), glm::dvec3(-2.0, 2.0, -2.0));
  EXPECT_LT(at(see(turned), -1, -1).r, 110) << "the back of a single-sided material";
}

TEST_F(Materials, AreLitAlikeOnBothSides) {
  add_image(scene::TextureFilter::Nearest);
  scene_.images[0].rgba.assign(16, 255);
  material_.unlit = false;
  material_.double_sided = true;
  material_.metallic = 0.0F;
  const glm::dmat4 front = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0));
  const glm::dmat4 back = glm::rotate(glm::dmat4(1.0), glm::pi<double>(), glm::dvec3(0.0, 1.0, 0.0)) * front;
  EXPECT_LE(difference(see(back), see(front), 3).share_beyond, 0.001) << "plain";
  material_.texture(TextureSlot::BaseColor).texture = 0;
  EXPECT_LE(difference(see(back), see(front), 3).share_beyond, 0.001) << "with a texture";
}

// A small square before the large one, up and to the left, whose shadow falls down and to the right.
TEST_F(Materials, CastShadowsWhereTheirFrontSeesTheLight) {
  material_.unlit = false;
  material_.metallic = 0.0F;
  const auto shaded = [&](double turn_rad) {
    scene_ = {};
    scene_.materials = {material_};
    add(scene_, "floor", square_, glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(-0.26, 0.37, 0.6));
    const glm::dmat4 turned = glm::rotate(place, turn_rad, glm::dvec3(0.0, 1.0, 0.0));
    add(scene_, "sheet", square_, glm::scale(turned, glm::dvec3(0.4)));
    return pixel(draw(scene_, bare_frame(scene_), small()).left, kMiddleX + 22, kMiddleY + 31).g;
  };
  const auto lit = shaded(glm::pi<double>());
  EXPECT_LT(shaded(0.0), lit - 30);
  material_.double_sided = true;
  EXPECT_LT(shaded(glm::pi<double>()), lit - 30);
}

TEST_F(Materials, DrawLinesAndPoints) {
  const render::Image bare = see(glm::translate(glm::dmat4(1.0), glm::dvec3(50, 0, 0)));
  const auto drawn = [&] { return difference(see(), bare, 8).share_beyond * bare.width * bare.height; };
  square_.indices = {0, 2};
  square_.topology = scene::Topology::Lines;
  EXPECT_GT(drawn(), 100.0);
  EXPECT_LT(drawn(), 800.0) << "no more than a diagonal";
}

// 6 mm in the room, but at least two pixels each way: a distant point is not lost on a fine wall.
TEST_F(Materials, DrawPointsWithTheirSizeInTheRoom) {
  const render::Image bare = see(glm::translate(glm::dmat4(1.0), glm::dvec3(50, 0, 0)));
  square_.indices = {0, 2};
  square_.topology = scene::Topology::Points;
  const auto pixels_of_one = [&](double nearer_m) {
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, nearer_m));
    const auto image = see(glm::scale(place, glm::dvec3(nearer_m > 0.0 ? 0.01 : 1.0)));
    return 0.5 * difference(image, bare, 8).share_beyond * bare.width * bare.height;
  };
  EXPECT_GE(pixels_of_one(0.0), 4.0);
  EXPECT_LE(pixels_of_one(0.0), 16.0) << "two pixels, smoothed";
  EXPECT_GT(pixels_of_one(2.4), 60.0) << "0.1 m before the eyes";
  EXPECT_LE(pixels_of_one(2.4), 18.0 * 18.0);
}

TEST_F(Materials, TakeLightFromItsPlace) {
  material_.unlit = false;
  material_.metallic = 0.0F;
  material_.base_color = glm::vec4(0.1F, 0.1F, 0.1F, 1.0F);
  scene_.lights.resize(1);
  const Pixel dark = at(see(), -1, 0);
  scene::PunctualLight light;
  light.intensity = glm::vec3(3.0F);
  lights_ = {{light, {-0.5F, 0.0F, 0.3F}}};
  const render::Image image = see();
  EXPECT_GT(at(image, -1, 0).g, at(image, 1, 0).g + 20) << "nearer is brighter";
  EXPECT_GT(at(image, -1, 0).g, dark.g + 20);
  lights_[0].light.kind = scene::PunctualLight::Kind::Spot;
  lights_[0].light.outer_cone_rad = 0.3F;
  lights_[0].direction = {0.0F, 0.0F, 1.0F};
  EXPECT_NEAR(at(see(), -1, 0).g, dark.g, 2) << "turned away";
  lights_[0].direction = {0.0F, 0.0F, -1.0F};
  EXPECT_GT(at(see(), -1, 0).g, dark.g + 20);
}

// A normal map of two by two pixels, each of which leans outwards, and a sun.
class NormalMaps : public Materials {
 protected:
  NormalMaps() {
    add_image(scene::TextureFilter::Nearest);
    scene_.images[0].rgba = {55, 201, 201, 255, 201, 201, 201, 255, 55, 55, 201, 255, 201, 55, 201, 255};
    material_.unlit = false;
    material_.double_sided = true;
    material_.metallic = 0.0F;
    material_.roughness = 1.0F;
    material_.texture(TextureSlot::Normal).texture = 0;
    scene_.lights.resize(1);
  }

  void shine(const glm::vec3& along) {
    scene::PunctualLight sun;
    sun.kind = scene::PunctualLight::Kind::Directional;
    sun.intensity = glm::vec3(3.0F);
    lights_ = {{sun, glm::vec3(0.0F), glm::normalize(along)}};
  }

  // Image without tangents, after a check that it looks the same with them.
  render::Image see_both(const glm::dmat4& room_from_node) {
    square_.tangents.clear();
    render::Image derived = see(room_from_node);
    square_.tangents.assign(square_.vertices.size(), glm::vec4(1, 0, 0, 1));
    EXPECT_LE(difference(see(room_from_node), derived, 3).share_beyond, 0.01);
    return derived;
  }

  enum class Sense { Inwards = -1, Outwards = 1 };
  void expect_leaning(Sense sense, const glm::dmat4& room_from_node) {
    const int out = static_cast<int>(sense);
    shine({1.0F, 0.0F, -1.0F});
    const render::Image from_left = see_both(room_from_node);
    EXPECT_GT(at(from_left, -out, 1).g, at(from_left, out, 1).g + 30);
    shine({0.0F, -1.0F, -1.0F});
    const render::Image from_above = see_both(room_from_node);
    EXPECT_GT(at(from_above, 1, -out).g, at(from_above, 1, out).g + 30);
  }
};

TEST_F(NormalMaps, BendLightAlikeWithAndWithoutTangents) {
  expect_leaning(Sense::Outwards, glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
}

TEST_F(NormalMaps, LeanOutwardsInANodeThatMirrorsToo) {
  expect_leaning(Sense::Outwards, glm::scale(glm::dmat4(1.0), glm::dvec3(-2.0, 2.0, 2.0)));
  expect_leaning(Sense::Outwards, glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, -2.0, 2.0)));
}

// A bump that leans outwards in front is a dent from behind, so everything leans inwards.
TEST_F(NormalMaps, AreReversedOnTheBack) {
  expect_leaning(Sense::Inwards, glm::rotate(glm::dmat4(1.0), glm::pi<double>(), glm::dvec3(0.0, 1.0, 0.0)) *
                                     glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
}

TEST_F(Materials, EmitWhatTheirTextureSays) {
  add_image(scene::TextureFilter::Nearest);
  material_.unlit = false;
  material_.emissive = glm::vec3(0.5F);
  material_.texture(TextureSlot::Emissive).texture = 0;
  const render::Image image = see();
  EXPECT_GT(at(image, -1, -1).r, at(image, 1, -1).r + 30);
  EXPECT_GT(at(image, 1, -1).g, at(image, -1, -1).g + 30);
}

}  // namespace material_test
}  // namespace afm::test
