// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "device/pipelines.h"

namespace afm::render {

// Both eyes in one multiview pass, or one eye per pass.
enum class EyePass { Both, Single };

// Code of a shader for passes of both eyes, and for passes of one eye, which does not require multiview of the device.
struct EyeCode {
  std::span<const std::uint32_t> both, single;
};

// Pipeline that draws into eyes, for both kinds of passes and any number of samples. Each variant is created at first
// use and kept.
class EyePipeline {
 public:
  // Fills in code, formats, samples and views of the request. The data it points to must outlive the pipeline.
  EyePipeline(const Device& device, PipelineRequest request, EyeCode vertex, EyeCode fragment);

  vk::Pipeline get(EyePass pass, vk::SampleCountFlagBits samples);

 private:
  const Device* device_;
  PipelineRequest request_;
  EyeCode vertex_, fragment_;
  std::array<vk::raii::Pipeline, 4> made_{nullptr, nullptr, nullptr, nullptr};
};

}  // namespace afm::render
