// SPDX-License-Identifier: Apache-2.0
#include "render/screenshot_queue.h"

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "composition/readback.h"
#include "core/check.h"
#include "device/barriers.h"
#include "device/device_error.h"
#include "output/png_writer.h"
#include "renderer/renderer_parts.h"

namespace afm::render {

enum class QueueMark : std::uint32_t { Begin, Composed, Copied };
constexpr std::uint32_t kPictureMarks = 3;

// Picture in progress: composed into an image, copied to the host, written from there.
struct QueuedPicture {
  QueuedPicture(const Device& device, bool timed)
      : pool(*device, vk::CommandPoolCreateInfo{.queueFamilyIndex = device.queue_family()}),
        commands(std::move(
            vk::raii::CommandBuffers(
                *device, {.commandPool = *pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1})
                .front())),
        copied(*device, vk::FenceCreateInfo{}) {
    if (timed && TimestampQueries::works_on(device)) clock.emplace(device, kPictureMarks);
  }

  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer commands;
  vk::raii::Fence copied;
  std::optional<TimestampQueries> clock;
  ComposeTarget target;
  HostCopy host;
  std::string path;
};

// Members in the order of creation.
struct ScreenshotQueue::Parts {
  Parts(const Device& the_device, Renderer::Parts& the_renderer) : device(the_device), renderer(the_renderer) {
    for (std::size_t i = 0; i < kMostPictures; ++i) places.emplace_back(device, renderer.options.time_passes);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { device.wait_idle(); }

  QueuedPicture& place(std::size_t picture) { return places[picture % kMostPictures]; }
  bool is_copied(const QueuedPicture& place) const;
  void mark(const QueuedPicture& place, QueueMark mark) const;
  void begin(QueuedPicture& place, const Composition& composition, const ReadArea& area);
  void hand_on();

  const Device& device;
  Renderer::Parts& renderer;
  std::vector<QueuedPicture> places;
  PngWriter writer;

  // number of pictures so far; unwritten ones occupy a place
  std::size_t begun = 0, handed = 0, written = 0;
};

void ScreenshotQueue::Parts::mark(const QueuedPicture& place, QueueMark mark) const {
  if (!place.clock) return;
  if (mark == QueueMark::Begin) place.clock->reset(place.commands, 0, kPictureMarks);
  place.clock->mark(place.commands, static_cast<std::uint32_t>(mark));
}

// True if the picture has been copied to the host. Never waits.
bool ScreenshotQueue::Parts::is_copied(const QueuedPicture& place) const {
  return place.copied.getStatus() == vk::Result::eSuccess;
}

void ScreenshotQueue::Parts::begin(QueuedPicture& place, const Composition& composition, const ReadArea& area) {
  device->resetFences(*place.copied);
  place.pool.reset();
  const auto& command = place.commands;
  command.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  mark(place, QueueMark::Begin);
  renderer.composer.record(command, composition, area, place.target);
  mark(place, QueueMark::Composed);
  place.host.record(device, command, *place.target.image.image, place.target.image.layers, place.target.image.extent);
  mark(place, QueueMark::Copied);
  command.end();
  const vk::CommandBufferSubmitInfo submit{.commandBuffer = *command};
  device.queue().submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &submit}, *place.copied);
}

void ScreenshotQueue::Parts::hand_on() {
  QueuedPicture& place = this->place(handed++);
  if (place.clock) {
    const auto between_ms = [&](QueueMark from, QueueMark to) {
      return place.clock->between_ms(static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to));
    };
    renderer.compose_ms = between_ms(QueueMark::Begin, QueueMark::Composed);
    renderer.readback_ms = between_ms(QueueMark::Composed, QueueMark::Copied);
  }
  writer.write(place.host.picture(0), std::move(place.path));
}

ScreenshotQueue::ScreenshotQueue(Context& context, Renderer& renderer)
    : parts_(std::make_unique<Parts>(context.device(), *renderer.parts_)) {}
ScreenshotQueue::ScreenshotQueue(ScreenshotQueue&&) noexcept = default;
ScreenshotQueue& ScreenshotQueue::operator=(ScreenshotQueue&&) noexcept = default;
ScreenshotQueue::~ScreenshotQueue() {
  if (!parts_) return;
  try {
    finish();
  } catch (const DeviceFailure&) {
    // a lost device or lack of memory is said by the next call that needs the device
  }
}

bool ScreenshotQueue::save(const Composition& composition, std::string path, const ReadArea& area) {
  Parts& parts = *parts_;
  AFM_CHECK(parts.renderer.eyes_drawn && !scene::has_two_pictures(composition.mode));
  if (parts.begun - parts.written == kMostPictures) return false;
  QueuedPicture& place = parts.place(parts.begun);
  rethrow_as_device_failure(parts.device, "saving a picture", [&] { parts.begin(place, composition, area); });
  place.path = std::move(path);
  ++parts.begun;
  return true;
}

std::vector<SavedPicture> ScreenshotQueue::collect() {
  Parts& parts = *parts_;
  while (parts.handed < parts.begun && parts.is_copied(parts.place(parts.handed))) parts.hand_on();
  std::vector<SavedPicture> saved;
  while (auto picture = parts.writer.take()) {
    saved.push_back(std::move(*picture));
    ++parts.written;
  }
  return saved;
}

std::vector<SavedPicture> ScreenshotQueue::finish() {
  Parts& parts = *parts_;
  rethrow_as_device_failure(parts.device, "saving a picture", [&] {
    while (parts.handed < parts.begun) {
      const QueuedPicture& place = parts.place(parts.handed);
      parts.device.wait_for(place.copied);
      parts.hand_on();
    }
  });
  std::vector<SavedPicture> saved;
  for (; parts.written < parts.begun; ++parts.written) saved.push_back(parts.writer.wait());
  return saved;
}

}  // namespace afm::render
