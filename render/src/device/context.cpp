// SPDX-License-Identifier: Apache-2.0
#include "render/context.h"

#include <utility>

#include "device/device.h"
#include "render/headset.h"

namespace afm::render {

Context::Context(std::unique_ptr<Device> device) : device_(std::move(device)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

core::Result<Context> Context::open(const ContextOptions& options) {
  auto device = Device::open(options.validation, options.presentation, options.gpu,
                             options.runtime == nullptr ? nullptr : &options.runtime->device_source());
  if (!device) {
    return tl::unexpected(device.error());
  }
  return Context(std::move(*device));
}

const std::string& Context::device_name() const { return device_->name(); }

bool Context::draws_on_processor() const {
  return device_->physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
}

bool Context::draws_both_eyes_at_once() const { return device_->multiview(); }

std::uint32_t Context::largest_picture_px() const {
  return device_->physical().getProperties().limits.maxImageDimension2D;
}

std::vector<std::string> Context::take_validation_messages() { return device_->messages().take(); }

}  // namespace afm::render
