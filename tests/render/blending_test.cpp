// SPDX-License-Identifier: Apache-2.0
// Invariant: blended pictures add up to one within the rounding of 8 bits, in every mode
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "support/anaglyph.h"
#include "support/deep.h"
#include "support/pictures.h"
#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

// Overlapping projectors show together what a single one would.
namespace afm::test {
namespace blending_test {

using scene::EyeOrder;
using scene::StereoMode;

constexpr unsigned kWallPx = 320, kHighPx = 192;
constexpr int kFrustumSteps = 2;  // tolerance as between a tile and a whole wall

// Light of an encoded value, as a projector shows it.
double light_of(double value, std::optional<double> gamma) {
  return gamma ? std::pow(value, *gamma) : linear_from_srgb(value);
}

// Half of the 8-bit step at this value, in light.
double half_step(int value, std::optional<double> gamma) {
  return light_of((value + 0.5) / 255.0, gamma) - light_of(value / 255.0, gamma);
}

// Light and half step of every 8-bit value.
class Levels {
 public:
  explicit Levels(std::optional<double> gamma) {
    for (std::size_t value = 0; value < light_.size(); ++value) {
      light_[value] = light_of(static_cast<double>(value) / 255.0, gamma);
      half_step_[value] = half_step(static_cast<int>(value), gamma);
    }
  }
  double light(int value) const { return light_.at(static_cast<std::size_t>(value)); }
  double half(int value) const { return half_step_.at(static_cast<std::size_t>(value)); }

 private:
  std::array<double, 256> light_{}, half_step_{};
};

// One of the projectors on the wall, or the one that shows all of it.
struct Part {
  unsigned begin_px, end_px;
  std::optional<render::Renderer> renderer{};
  std::shared_ptr<const scene::Blend> blend{};

  unsigned width_px() const { return end_px - begin_px; }
  scene::Screen screen() const {
    const scene::Screen whole = paper_screen();
    const glm::dvec3 right = whole.lower_right - whole.lower_left;
    const auto at = [&](unsigned px, const glm::dvec3& corner) {
      return corner + double(px) / double{kWallPx} * right;
    };
    return {"part", at(begin_px, whole.lower_left), at(end_px, whole.lower_left), at(begin_px, whole.upper_left)};
  }
};

class Blended : public VulkanTest {
 protected:
  // Two projectors that overlap by an even number of pixels; `keys` are those of the left screen and of both outputs.
  void set_up(unsigned overlap_px, const std::string& screen_keys, const std::string& output_keys) {
    const unsigned width_px = (kWallPx + overlap_px) / 2;
    if (parts_.empty() || parts_[0].width_px() != width_px) {
      parts_.clear();
      parts_.push_back({0, width_px});
      parts_.push_back({kWallPx - width_px, kWallPx});
    }
    std::string screens, outputs;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const scene::Screen screen = parts_[i].screen();
      const auto corner = [](const glm::dvec3& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); };
      screens += fmt::format("[[screen]]\nname = \"{}\"\nlower_left = {}\nlower_right = {}\nupper_left = {}\n{}", i,
                             corner(screen.lower_left), corner(screen.lower_right), corner(screen.upper_left),
                             i == 0 ? screen_keys : "");
      outputs +=
          fmt::format("[[output]]\nname = \"{0}\"\nscreen = \"{0}\"\nmode = \"mono\"\nrect = [{1}, 0, 9, 9]\n{2}", i,
                      10 * i, output_keys);
    }
    const support::ScratchFolder folder;
    const auto wall = scene::load_wall(folder.write(
        "wall.toml", screens + outputs + "[[viewer]]\nname = \"v\"\nipd = \"63 mm\"\nsweet_spot = [0, 0, 2.5]\n"));
    ASSERT_TRUE(wall) << wall.error().message;
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].blend = wall->outputs[i].blend;
  }

  void render(Part& part, const scene::Scene& scene, render::FrameState frame) {
    auto options = small(1);
    options.eye_width = part.width_px();
    options.eye_height = kHighPx;
    part.renderer.emplace(make_renderer(scene, options));
    for (std::size_t eye = 0; eye < 2; ++eye) {
      frame.eyes.at(eye) = scene::off_axis_view(part.screen(), frame.eyes.at(eye).eye_position_m,
                                                scene::DepthConvention::VulkanReversedInfinite, scene::kNearM, 0.0)
                               .value();
    }
    part.renderer->render(frame);
  }

  static render::Image read(Part& part, render::Composition composition) {
    return part.renderer->read_composed(composition, {.screen_px = glm::ivec2(part.begin_px, 0)});
  }

  std::vector<Part> parts_;
};

// A picture of two eyes: how wide and high the part of each is, and where the second begins.
struct Regions {
  unsigned count = 1;
  glm::uvec2 size{0}, step{0};
};
Regions regions_of(StereoMode mode, const render::Image& picture) {
  const bool beside = scene::traits_of(mode).arrangement == scene::EyeArrangement::SideBySide;
  const bool above = scene::traits_of(mode).arrangement == scene::EyeArrangement::TopBottom;
  const glm::uvec2 size(picture.width / (beside ? 2 : 1), picture.height / (above ? 2 : 1));
  return {beside || above ? 2U : 1U, size, {beside ? size.x : 0, above ? size.y : 0}};
}

// The sum of both projectors' light is that of the one, within what each output's and the one's rounding is and, where
// a part's own frustum draws a step or two brighter or darker than the whole's, that. Of a few pixels on edges it draws
// something else; they do not count. Returns their share.
double sum_differs(StereoMode mode, std::optional<double> gamma, const render::Image& whole,
                   const std::vector<std::array<render::Image, 2>>& plain_and_blended,
                   const std::vector<unsigned>& begins_px, double& worst) {
  const bool exact = !scene::anaglyph_matrices(mode) && !scene::traits_of(mode).squeezed;
  const Regions regions = regions_of(mode, whole);
  const Levels levels(gamma);
  const unsigned squeeze = kWallPx / regions.size.x;
  std::size_t odd = 0, all = 0;
  for (unsigned eye = 0; eye < regions.count; ++eye) {
    for (unsigned y = 0; y < regions.size.y; ++y) {
      for (unsigned x = 0; x < regions.size.x; ++x) {
        const auto one = rgb_at(whole, x + eye * regions.step.x, y + eye * regions.step.y);
        std::array<double, 3> sum{}, bound{};
        bool same = true;
        double drawn_otherwise = 0.0;
        for (std::size_t i = 0; i < plain_and_blended.size(); ++i) {
          const Regions own = regions_of(mode, plain_and_blended[i][0]);
          const unsigned begin = begins_px[i] / squeeze;
          if (x < begin || x >= begin + own.size.x) continue;
          const glm::uvec2 at(x - begin + eye * own.step.x, y + eye * own.step.y);
          const auto plain = rgb_at(plain_and_blended[i][0], at.x, at.y);
          const auto shown = rgb_at(plain_and_blended[i][1], at.x, at.y);
          for (std::size_t c = 0; c < 3; ++c) {
            same = same && std::abs(plain.at(c) - one.at(c)) <= kFrustumSteps;
            drawn_otherwise = std::max(drawn_otherwise, std::abs(levels.light(plain.at(c)) - levels.light(one.at(c))));
            sum.at(c) += levels.light(shown.at(c));
            bound.at(c) += levels.half(shown.at(c));
          }
        }
        ++all;
        odd += same ? 0U : 1U;
        if (!same) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          // a filtered or mixed value was not rounded before blending
          const double own = exact ? 0.0 : 1.4 * levels.half(one.at(c));
          const double allowed = bound.at(c) + own + drawn_otherwise + 2e-6;
          worst = std::max(worst, std::abs(sum.at(c) - levels.light(one.at(c))) / allowed);
        }
      }
    }
  }
  return static_cast<double>(odd) / static_cast<double>(all);
}

constexpr std::array kBlendedModes{
    StereoMode::Mono,           StereoMode::Left,         StereoMode::Right,          StereoMode::SideBySide,
    StereoMode::SideBySideHalf, StereoMode::TopBottom,    StereoMode::TopBottomHalf,  StereoMode::Row,
    StereoMode::Column,         StereoMode::Checkerboard, StereoMode::AnaglyphRedCyan};

TEST_F(Blended, PairAddsUpToThePictureOfOneProjector) {
  const TestScene test = make_test_scene();
  const render::FrameState frame = full_frame(test);
  Part whole{0, kWallPx};
  render(whole, test.scene, frame);
  for (const auto& [overlap_px, keys] :
       {std::pair(64U, ""), std::pair(64U, "blend_right = \"0.2 m\"\n"), std::pair(20U, "")}) {
    for (const std::optional<double> gamma : {std::optional<double>(), {1.8}, {2.2}, {2.6}}) {
      const bool first = overlap_px == 64 && std::string_view(keys).empty();
      const bool usual = !gamma || (gamma == 2.2 && first);
      if (!support::deep() && !usual) continue;
      set_up(overlap_px, keys, gamma ? fmt::format("gamma = {}\n", *gamma) : "");
      for (Part& part : parts_) {
        if (!part.renderer) render(part, test.scene, frame);
      }
      for (const StereoMode mode : kBlendedModes) {
        for (const EyeOrder order : {EyeOrder::Straight, EyeOrder::Swapped}) {
          if (order == EyeOrder::Swapped && (gamma || (!first && !support::deep()))) continue;
          std::vector<std::array<render::Image, 2>> shown;
          std::vector<unsigned> begins_px;
          for (Part& part : parts_) {
            render::Composition composition{.mode = mode, .order = order};
            const render::Image plain = read(part, composition);
            composition.blend = part.blend;
            shown.push_back({plain, read(part, composition)});
            begins_px.push_back(part.begin_px);
          }
          double worst = 0;
          const double odd =
              sum_differs(mode, gamma, read(whole, {.mode = mode, .order = order}), shown, begins_px, worst);
          const std::string what =
              fmt::format("{} px, {}gamma {}, {}", overlap_px, keys, gamma.value_or(0.0), scene::name_of(mode));
          EXPECT_LE(worst, 1.0) << what;
          EXPECT_LT(odd, 0.01) << what;
        }
      }
    }
  }
}

// Without blending the same sum is far off, so that the test above can fail.
TEST_F(Blended, PairThatIsNotBlendedDoesNotAddUp) {
  const TestScene test = make_test_scene();
  const render::FrameState frame = full_frame(test);
  Part whole{0, kWallPx};
  render(whole, test.scene, frame);
  set_up(64, "", "");
  std::vector<std::array<render::Image, 2>> shown;
  for (Part& part : parts_) {
    render(part, test.scene, frame);
    const render::Image plain = read(part, {.mode = StereoMode::Left});
    shown.push_back({plain, plain});
  }
  double worst = 0;
  sum_differs(StereoMode::Left, {}, read(whole, {.mode = StereoMode::Left}), shown, {0U, parts_[1].begin_px}, worst);
  EXPECT_GT(worst, 10.0);
}

// Light of black, with what raises it: equal beside the overlap and in it, and under any picture.
TEST_F(Blended, BlackIsAsBrightBesideTheOverlapAsInIt) {
  constexpr double kBlack = 0.02;
  for (const std::optional<double> gamma : {std::optional<double>(), {2.2}}) {
    set_up(64, "", fmt::format("black_level = {}\n{}", kBlack, gamma ? "gamma = 2.2\n" : ""));
    for (const float grey : {0.0F, 0.2F, 1.0F}) {
      scene::Scene scene;
      const auto material =
          add_material(scene, {.name = "plain", .base_color = glm::vec4(glm::vec3(grey), 1.0F), .unlit = true});
      add(scene, "wall", quad(material), glm::dmat4(glm::dmat3(12.0)));
      std::vector<double> light(kWallPx, 0.0), bound(kWallPx, 2e-6);
      double shown = 0;
      for (Part& part : parts_) {
        render(part, scene, bare_frame(scene));
        shown = light_of(rgb_at(read(part, {.mode = StereoMode::Left}), 5, 90)[1] / 255.0, gamma);
        const render::Image picture = read(part, {.mode = StereoMode::Left, .blend = part.blend});
        for (unsigned x = 0; x < part.width_px(); ++x) {
          const int value = rgb_at(picture, x, 90)[1];
          light[part.begin_px + x] += kBlack + light_of(value / 255.0, gamma);
          bound[part.begin_px + x] += half_step(value, gamma);
        }
      }
      for (unsigned x = 0; x < kWallPx; ++x) {
        EXPECT_NEAR(light[x], 2.0 * kBlack + (1.0 - kBlack) * shown, bound[x]) << x << ", grey " << grey;
      }
    }
  }
}

// An anaglyph is mixed and clamped first: a clamped colour is shared out as one projector would show it.
TEST_F(Blended, SharesOutWhatTheAnaglyphMixed) {
  const TestScene test = make_test_scene();
  set_up(64, "", "");
  Part& part = parts_[0];
  render(part, test.scene, full_frame(test));
  const render::Image left = part.renderer->read_eye(scene::Eye::Left),
                      right = part.renderer->read_eye(scene::Eye::Right);
  for (const scene::StereoModeTraits& row : scene::kStereoModes) {
    if (!row.anaglyph) continue;
    const render::Image picture = read(part, {.mode = row.mode, .blend = part.blend});
    int largest = 0;
    for (unsigned y = 0; y < picture.height; ++y) {
      for (unsigned x = 0; x < picture.width; ++x) {
        const auto at = part.blend->at({(x + 0.5) / picture.width, (y + 0.5) / picture.height});
        const glm::dvec3 mixed =
            at.own / at.all * anaglyph_linear(*row.anaglyph, rgb_at(left, x, y), rgb_at(right, x, y));
        const auto shown = rgb_at(picture, x, y);
        largest = std::max({largest, std::abs(shown[0] - srgb8(mixed.x)), std::abs(shown[1] - srgb8(mixed.y)),
                            std::abs(shown[2] - srgb8(mixed.z))});
      }
    }
    EXPECT_LE(largest, 1) << row.name;
  }
}

}  // namespace blending_test
}  // namespace afm::test
