// SPDX-License-Identifier: Apache-2.0
// Invariant: no frame in any picture test causes a validation or synchronisation message
#pragma once

#include <gtest/gtest.h>
#include <malloc.h>

#include <stdexcept>

#include "render/renderer.h"
#include "support/test_scene.h"

namespace afm::test {

// A Vulkan device with validation and synchronisation validation: one for all tests of a program, because opening it
// takes longer than most of their pictures. Any message fails the test; so does a missing device.
class VulkanTest : public testing::Test {
 protected:
  VulkanTest() : context_(shared()) {}
  ~VulkanTest() override {
    for (const auto& message : context_.take_validation_messages()) {
      ADD_FAILURE() << message;
    }
  }

  render::Renderer make_renderer(const scene::Scene& scene, const render::RendererOptions& options) {
    auto renderer = render::Renderer::create(context_, scene, options);
    if (!renderer) {
      throw std::runtime_error(renderer.error().message);
    }
    return std::move(*renderer);
  }

  struct Pair {
    render::Image left, right;
  };
  Pair draw(const scene::Scene& scene, const render::FrameState& frame, const render::RendererOptions& options) {
    auto renderer = make_renderer(scene, options);
    renderer.render(frame);
    return {renderer.read_eye(scene::Eye::Left), renderer.read_eye(scene::Eye::Right)};
  }

  render::Context& context_;

 private:
  static render::Context& shared() {
    static render::Context context = open();
    return context;
  }

  // Keeps freed memory: each test creates and drops pictures of the same sizes, which then need no new pages.
  static void keep_freed_memory() {
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
  }

  static render::Context open() {
    keep_freed_memory();
    auto context = render::Context::open({.validation = render::Validation::On});
    if (!context) {
      throw std::runtime_error(context.error().message);
    }
    return std::move(*context);
  }
};

// Options small enough for a CPU device under sanitizers, in the proportions of the paper's wall.
inline render::RendererOptions small(std::uint32_t samples = 4,
                                     render::PassMode pass_mode = render::PassMode::Multiview) {
  return {.eye_width = 256, .eye_height = 192, .samples = samples, .pass_mode = pass_mode, .panel_texels_per_m = 320.0};
}

}  // namespace afm::test
