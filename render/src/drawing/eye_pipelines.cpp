// SPDX-License-Identifier: Apache-2.0
#include "drawing/eye_pipelines.h"

#include <utility>

#include "drawing/eye_targets.h"

namespace afm::render {

EyePipeline::EyePipeline(const Device& device, PipelineRequest request, EyeCode vertex, EyeCode fragment)
    : device_(&device), request_(std::move(request)), vertex_(vertex), fragment_(fragment) {
  request_.color_format = kEyeFormat;
  request_.depth_format = kDepthFormat;
}

vk::Pipeline EyePipeline::get(EyePass pass, vk::SampleCountFlagBits samples) {
  const bool both = pass == EyePass::Both;
  auto& pipeline = made_[(both ? 0U : 1U) + (samples == vk::SampleCountFlagBits::e1 ? 0U : 2U)];
  if (!*pipeline) {
    request_.samples = samples;
    request_.view_mask = both ? kBothEyes : 0U;
    request_.vertex_code = both ? vertex_.both : vertex_.single;
    request_.fragment_code = both ? fragment_.both : fragment_.single;
    pipeline = create_pipeline(*device_, request_);
  }
  return *pipeline;
}

}  // namespace afm::render
