// SPDX-License-Identifier: Apache-2.0
#include "eye_pipelines.h"

#include <utility>

#include "eye_targets.h"

namespace afm::render {

EyePipeline::EyePipeline(const Device& device, PipelineRequest request)
    : device_(&device), request_(std::move(request)) {
  request_.color_format = kEyeFormat;
  request_.depth_format = kDepthFormat;
}

vk::Pipeline EyePipeline::get(EyePass pass, vk::SampleCountFlagBits samples) {
  auto& pipeline = made_[(pass == EyePass::Both ? 0U : 1U) + (samples == vk::SampleCountFlagBits::e1 ? 0U : 2U)];
  if (!*pipeline) {
    request_.samples = samples;
    request_.view_mask = pass == EyePass::Both ? kBothEyes : 0U;
    pipeline = create_pipeline(*device_, request_);
  }
  return *pipeline;
}

}  // namespace afm::render
