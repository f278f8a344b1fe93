// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/shared_segment.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <utility>

#include "core/check.h"
#include "core/system_error.h"
#include "segment_layout.h"

namespace afm::scene {

namespace {

// Without the shrink seal the other process could cut the file under our mapping, and the next access would be a
// SIGBUS.
constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

auto segment_refused(std::string message) { return core::failure(core::ErrorCategory::Failed, std::move(message)); }

void* map_whole(int descriptor) {
  return ::mmap(nullptr, sizeof(SegmentLayout), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
}

core::Result<void> validate(const SegmentHeader& header) {
  if (header.magic != kSegmentMagic) {
    return segment_refused("cannot use the shared segment: its descriptor refers to something else");
  }
  if (header.version != kSegmentVersion) {
    return segment_refused(
        fmt::format("cannot use a shared segment of version {}: this program uses version {}; start touchafm and "
                    "touchafm-servo from the same build",
                    header.version, kSegmentVersion));
  }
  if (header.total_bytes != sizeof(SegmentLayout) || header.block_bytes != kBlockSizes) {
    return segment_refused(
        fmt::format("cannot use the shared segment: its blocks differ from this program's ({} and {} bytes); start "
                    "touchafm and touchafm-servo from the same build",
                    header.total_bytes, sizeof(SegmentLayout)));
  }
  return {};
}

}  // namespace

void SharedSegment::Unmap::operator()(SegmentLayout* layout) const noexcept { ::munmap(layout, sizeof(SegmentLayout)); }

core::Result<SharedSegment> SharedSegment::create(const SharedModel& model, std::uint64_t scene_digest) {
  if (auto valid = scene::validate(model); !valid) return tl::unexpected(valid.error());

  core::FileDescriptor descriptor(::memfd_create("touchafm", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!descriptor.is_open() || ::ftruncate(descriptor.get(), sizeof(SegmentLayout)) != 0 ||
      ::fcntl(descriptor.get(), F_ADD_SEALS, kSeals) != 0) {
    return segment_refused(fmt::format("cannot create a shared segment of {} bytes: {}", sizeof(SegmentLayout),
                                       core::system_error(errno)));
  }
  void* memory = map_whole(descriptor.get());
  if (memory == MAP_FAILED)
    return segment_refused(fmt::format("cannot map the shared segment: {}", core::system_error(errno)));

  auto* layout = new (memory) SegmentLayout;
  layout->header.total_bytes = sizeof(SegmentLayout);
  layout->header.scene_digest = scene_digest;
  layout->model = model;
  return SharedSegment(std::move(descriptor), layout);
}

core::Result<SharedSegment> SharedSegment::attach(core::FileDescriptor descriptor) {
  struct stat status{};
  if (::fstat(descriptor.get(), &status) != 0) {
    return segment_refused(
        fmt::format("cannot use descriptor {} as shared segment: {}", descriptor.get(), core::system_error(errno)));
  }

  // the header first, by a plain read, which cannot fault whatever the descriptor is
  SegmentHeader header;
  if (::pread(descriptor.get(), &header, sizeof(header), 0) != static_cast<ssize_t>(sizeof(header))) {
    return segment_refused("cannot use the shared segment: it is shorter than its header");
  }
  if (auto valid = validate(header); !valid) return tl::unexpected(valid.error());
  if (status.st_size != static_cast<off_t>(sizeof(SegmentLayout))) {
    return segment_refused(fmt::format("cannot use the shared segment: it has {} bytes instead of {}", status.st_size,
                                       sizeof(SegmentLayout)));
  }
  const int seals = ::fcntl(descriptor.get(), F_GET_SEALS);
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0) {
    return segment_refused("cannot use the shared segment: it is not sealed against shrinking");
  }

  void* memory = map_whole(descriptor.get());
  if (memory == MAP_FAILED)
    return segment_refused(fmt::format("cannot map the shared segment: {}", core::system_error(errno)));
  SharedSegment segment(std::move(descriptor), std::launder(static_cast<SegmentLayout*>(memory)));
  if (auto valid = scene::validate(segment.model()); !valid) return tl::unexpected(valid.error());
  return segment;
}

const SharedModel& SharedSegment::model() const noexcept { return layout_->model; }
std::uint64_t SharedSegment::scene_digest() const noexcept { return layout_->header.scene_digest; }

namespace {

// Empties `value` and counts it as refused unless it is plausible. In place: a block may have 16 KB, and an empty one
// must cost a tick nothing.
template <class T, class Count, class... Model>
void check(std::optional<T>& value, Count& refused, const Model&... model) noexcept {
  if (value && !is_valid(*value, model...)) {
    ++refused;
    value.reset();
  }
}

// The next plausible value of a ring; counts those that it skips as refused.
template <class T, std::size_t Capacity>
std::optional<T> next(core::SpscRing<T, Capacity>& ring, std::uint64_t& refused, const SharedModel& model) noexcept {
  while (auto value = ring.pop()) {
    if (is_valid(*value, model)) return value;
    ++refused;
  }
  return std::nullopt;
}

}  // namespace

void RendererSide::store(const SceneTransforms& transforms) noexcept { layout_->transforms.store(transforms); }
void RendererSide::store(const Selection& selection) noexcept { layout_->selection.store(selection); }
void RendererSide::store(const MaterialEdit& edit, std::uint32_t material) noexcept {
  AFM_CHECK(material < kMaxMaterials);
  layout_->edits[material].store(edit);
}
void RendererSide::store(const HandScript& script) noexcept { layout_->hand_script.store(script); }
void RendererSide::store(const RendererHeartbeat& heartbeat) noexcept { layout_->heartbeat.store(heartbeat); }

std::optional<TipState> RendererSide::tip_state() noexcept {
  auto state = layout_->tip_state.load();
  check(state, refused_, layout_->model);
  return state;
}

std::optional<Selection> RendererSide::last_selection() const noexcept { return layout_->selection.try_load(); }
std::optional<HandScript> RendererSide::last_hand_script() const noexcept { return layout_->hand_script.try_load(); }
std::optional<MaterialEdit> RendererSide::last_edit(std::uint32_t material) const noexcept {
  AFM_CHECK(material < kMaxMaterials);
  return layout_->edits[material].try_load();
}

std::optional<ServoTiming> RendererSide::servo_timing() const noexcept { return layout_->timing.load(); }

std::optional<SharedDevice> RendererSide::device() noexcept {
  auto device = layout_->device.load();
  check(device, refused_);
  return device;
}

std::optional<TipSample> RendererSide::pop_sample() noexcept {
  return next(layout_->samples, refused_, layout_->model);
}
std::optional<TipEvent> RendererSide::pop_event() noexcept { return next(layout_->events, refused_, layout_->model); }

std::uint64_t RendererSide::lost_samples() const noexcept { return layout_->samples.dropped(); }
std::uint64_t RendererSide::lost_events() const noexcept { return layout_->events.dropped(); }

std::optional<SceneTransforms> ServoSide::new_transforms() noexcept {
  auto transforms = layout_->transforms.try_load_newer(seen_transforms_);
  check(transforms, refused_, layout_->model);
  return transforms;
}

std::optional<Selection> ServoSide::new_selection() noexcept {
  auto selection = layout_->selection.try_load_newer(seen_selection_);
  check(selection, refused_, layout_->model);
  return selection;
}

std::optional<MaterialEdit> EditSide::new_edit(std::uint32_t material) noexcept {
  return layout_->edits[material].try_load_newer(seen_[material]);
}

std::optional<HandScript> ServoSide::new_hand_script() noexcept {
  auto script = layout_->hand_script.try_load_newer(seen_script_);
  check(script, refused_);
  return script;
}

std::optional<RendererHeartbeat> ServoSide::new_heartbeat() noexcept {
  auto heartbeat = layout_->heartbeat.try_load_newer(seen_heartbeat_);
  check(heartbeat, refused_);
  return heartbeat;
}

void ServoSide::store(const TipState& state) noexcept { layout_->tip_state.store(state); }
void ServoSide::store(const ServoTiming& timing) noexcept { layout_->timing.store(timing); }
void ServoSide::store(const SharedDevice& device) noexcept { layout_->device.store(device); }
void ServoSide::push(const TipSample& sample) noexcept { layout_->samples.push(sample); }
void ServoSide::push(const TipEvent& event) noexcept { layout_->events.push(event); }

}  // namespace afm::scene
