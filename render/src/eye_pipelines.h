// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pipelines.h"

namespace afm::render {

// Both eyes in one multiview pass, or one eye a pass.
enum class EyePass { Both, Single };

// A pipeline that draws into eyes, for both kinds of passes and with any number of samples: each made when it is first
// asked for, and kept.
class EyePipeline {
 public:
  // Formats, samples and views of the request are filled in here. What it points to must outlive the pipeline.
  EyePipeline(const Device& device, PipelineRequest request);

  vk::Pipeline get(EyePass pass, vk::SampleCountFlagBits samples);

 private:
  const Device* device_;
  PipelineRequest request_;
  std::array<vk::raii::Pipeline, 4> made_{nullptr, nullptr, nullptr, nullptr};
};

}  // namespace afm::render
