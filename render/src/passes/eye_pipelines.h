// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "device/pipelines.h"

namespace afm::render {

// Both eyes in one multiview pass, or one eye a pass.
enum class EyePass { Both, Single };

// A shader's code for passes of both eyes, and for passes of one, which asks nothing of the device that multiview does.
struct EyeCode {
  std::span<const std::uint32_t> both, single;
};

// A pipeline that draws into eyes, for both kinds of passes and with any number of samples: each made when it is first
// asked for, and kept.
class EyePipeline {
 public:
  // Code, formats, samples and views of the request are filled in here. What it points to must outlive the pipeline.
  EyePipeline(const Device& device, PipelineRequest request, EyeCode vertex, EyeCode fragment);

  vk::Pipeline get(EyePass pass, vk::SampleCountFlagBits samples);

 private:
  const Device* device_;
  PipelineRequest request_;
  EyeCode vertex_, fragment_;
  std::array<vk::raii::Pipeline, 4> made_{nullptr, nullptr, nullptr, nullptr};
};

}  // namespace afm::render
