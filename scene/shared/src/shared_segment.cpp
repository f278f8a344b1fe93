// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/shared_segment.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <utility>

#include "core/check.h"
#include "core/system_error.h"
#include "segment_layout.h"

namespace afm::scene {

namespace {

constexpr std::uint64_t kMostSegmentBytes =
    sizeof(SegmentLayout) + std::uint64_t{kMaxTopographySide} * kMaxTopographySide * sizeof(float);

// Without the shrink seal, the other process could truncate the file under our mapping, and the next access would cause
// a SIGBUS.
constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

auto segment_refused(std::string message) { return core::failure(core::ErrorCategory::Failed, std::move(message)); }

void* map_whole(int descriptor, std::size_t bytes) {
  return ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
}

// Size of the heights stored after the blocks; `size` is valid.
std::size_t bytes_of(const SharedTopography& size) { return std::size_t{size.columns} * size.rows * sizeof(float); }

// Address of the heights: the layout is a whole number of pages long.
float* heights_behind(SegmentLayout& layout) { return reinterpret_cast<float*>(&layout + 1); }

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
  if (header.total_bytes < sizeof(SegmentLayout) || header.total_bytes > kMostSegmentBytes ||
      header.block_bytes != kBlockSizes) {
    return segment_refused(
        fmt::format("cannot use the shared segment: its blocks differ from this program's ({} and {} bytes); start "
                    "touchafm and touchafm-servo from the same build",
                    header.total_bytes, sizeof(SegmentLayout)));
  }
  return {};
}

}  // namespace

void SharedSegment::Unmap::operator()(SegmentLayout* layout) const noexcept { ::munmap(layout, bytes); }

core::Result<SharedSegment> SharedSegment::create(const SharedModel& model, std::uint64_t scene_digest,
                                                  const Topography& topography) {
  if (auto valid = scene::validate(model); !valid) return tl::unexpected(valid.error());
  if (!is_valid(topography, model.topography)) {
    return segment_refused("cannot create a shared segment: its topography is not the one that its scene has");
  }
  const std::size_t bytes = sizeof(SegmentLayout) + bytes_of(model.topography);

  core::FileDescriptor descriptor(::memfd_create("touchafm", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!descriptor.is_open() || ::ftruncate(descriptor.get(), static_cast<off_t>(bytes)) != 0 ||
      ::fcntl(descriptor.get(), F_ADD_SEALS, kSeals) != 0) {
    return segment_refused(
        fmt::format("cannot create a shared segment of {} bytes: {}", bytes, core::system_error(errno)));
  }
  void* memory = map_whole(descriptor.get(), bytes);
  if (memory == MAP_FAILED)
    return segment_refused(fmt::format("cannot map the shared segment: {}", core::system_error(errno)));

  auto* layout = new (memory) SegmentLayout;
  layout->header.total_bytes = bytes;
  layout->header.scene_digest = scene_digest;
  layout->model = model;
  std::copy(topography.height_m.begin(), topography.height_m.end(), heights_behind(*layout));
  return SharedSegment(std::move(descriptor), layout, bytes);
}

core::Result<SharedSegment> SharedSegment::attach(core::FileDescriptor descriptor) {
  struct stat status{};
  if (::fstat(descriptor.get(), &status) != 0) {
    return segment_refused(
        fmt::format("cannot use descriptor {} as shared segment: {}", descriptor.get(), core::system_error(errno)));
  }

  // reads the header first, with a plain read, which cannot fault for any descriptor
  SegmentHeader header;
  if (::pread(descriptor.get(), &header, sizeof(header), 0) != static_cast<ssize_t>(sizeof(header))) {
    return segment_refused("cannot use the shared segment: it is shorter than its header");
  }
  if (auto valid = validate(header); !valid) return tl::unexpected(valid.error());
  if (status.st_size != static_cast<off_t>(header.total_bytes)) {
    return segment_refused(fmt::format("cannot use the shared segment: it has {} bytes instead of {}", status.st_size,
                                       header.total_bytes));
  }
  const int seals = ::fcntl(descriptor.get(), F_GET_SEALS);
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0) {
    return segment_refused("cannot use the shared segment: it is not sealed against shrinking");
  }

  const std::size_t bytes = header.total_bytes;
  void* memory = map_whole(descriptor.get(), bytes);
  if (memory == MAP_FAILED)
    return segment_refused(fmt::format("cannot map the shared segment: {}", core::system_error(errno)));
  SharedSegment segment(std::move(descriptor), std::launder(static_cast<SegmentLayout*>(memory)), bytes);
  if (auto valid = scene::validate(segment.model()); !valid) return tl::unexpected(valid.error());
  if (bytes != sizeof(SegmentLayout) + bytes_of(segment.model().topography)) {
    return segment_refused("cannot use the shared segment: its topography does not fill it");
  }
  return segment;
}

Topography SharedSegment::topography() const {
  // reads the size once, because checked data in shared memory could still change
  const SharedTopography size = layout_->model.topography;
  const std::size_t held = layout_.get_deleter().bytes - sizeof(SegmentLayout);
  Topography copy{.columns = size.columns, .rows = size.rows, .spacing_m = size.spacing_m, .height_m = {}};
  copy.height_m.assign(heights_behind(*layout_), heights_behind(*layout_) + held / sizeof(float));
  return copy;
}

const SharedModel& SharedSegment::model() const noexcept { return layout_->model; }
std::uint64_t SharedSegment::scene_digest() const noexcept { return layout_->header.scene_digest; }

namespace {

// Empties an implausible `value` and counts it as rejected. Works in place: a block may have 16 KB, and an empty one
// must cost a tick nothing.
template <class T, class Count, class... Model>
void check(std::optional<T>& value, Count& refused, const Model&... model) noexcept {
  if (value && !is_valid(*value, model...)) {
    ++refused;
    value.reset();
  }
}

// Next plausible value of a ring; counts those that it skips as rejected.
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
void RendererSide::store(const ScanLead& lead) noexcept { layout_->scan_lead.store(lead); }
void RendererSide::store(const PlannedPush& plan) noexcept { layout_->plan.store(plan); }
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

std::optional<TipPush> RendererSide::tip_push() noexcept {
  auto push = layout_->tip_push.load();
  check(push, refused_, layout_->model);
  return push;
}

std::optional<ParticlePage> RendererSide::new_particle_page(std::uint32_t page) noexcept {
  AFM_CHECK(page < kParticlePages);
  auto poses = layout_->particle_pages[page].try_load_newer(seen_pages_[page]);
  check(poses, refused_);
  return poses;
}

std::optional<MarkTile> RendererSide::new_mark_tile(std::uint32_t tile) noexcept {
  AFM_CHECK(tile < kMarkTiles);
  auto squares = layout_->mark_tiles[tile].try_load_newer(seen_tiles_[tile]);
  check(squares, refused_);
  return squares;
}

std::optional<TipSample> RendererSide::pop_sample() noexcept {
  return next(layout_->samples, refused_, layout_->model);
}
std::optional<TipEvent> RendererSide::pop_event() noexcept { return next(layout_->events, refused_, layout_->model); }

std::uint64_t RendererSide::lost_samples() const noexcept { return layout_->samples.dropped(); }

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

std::optional<Selection> EditSide::new_selection() noexcept {
  auto selection = layout_->selection.try_load_newer(seen_selection_);
  return selection && is_valid(*selection, layout_->model) ? selection : std::nullopt;
}

std::optional<HandScript> ServoSide::new_hand_script() noexcept {
  auto script = layout_->hand_script.try_load_newer(seen_script_);
  check(script, refused_);
  return script;
}

std::optional<ScanLead> ServoSide::new_scan_lead() noexcept {
  auto lead = layout_->scan_lead.try_load_newer(seen_lead_);
  check(lead, refused_);
  return lead;
}

std::optional<PlannedPush> ServoSide::new_plan() noexcept {
  auto plan = layout_->plan.try_load_newer(seen_plan_);
  check(plan, refused_, layout_->model);
  return plan;
}

std::optional<RendererHeartbeat> ServoSide::new_heartbeat() noexcept {
  auto heartbeat = layout_->heartbeat.try_load_newer(seen_heartbeat_);
  check(heartbeat, refused_);
  return heartbeat;
}

void ServoSide::store(const TipState& state) noexcept { layout_->tip_state.store(state); }
void ServoSide::store(const ServoTiming& timing) noexcept { layout_->timing.store(timing); }
void ServoSide::store(const SharedDevice& device) noexcept { layout_->device.store(device); }
void ServoSide::store(const TipPush& push) noexcept { layout_->tip_push.store(push); }
void ServoSide::store(const ParticlePage& page, std::uint32_t number) noexcept {
  AFM_CHECK(number < kParticlePages);
  layout_->particle_pages[number].store(page);
}

std::optional<ParticlePage> ServoSide::last_particle_page(std::uint32_t number) const noexcept {
  AFM_CHECK(number < kParticlePages);
  auto page = layout_->particle_pages[number].try_load();
  return page && is_valid(*page) ? page : std::nullopt;
}

void ServoSide::store(const MarkTile& tile, std::uint32_t number) noexcept {
  AFM_CHECK(number < kMarkTiles);
  layout_->mark_tiles[number].store(tile);
}

std::optional<MarkTile> ServoSide::last_mark_tile(std::uint32_t number) const noexcept {
  AFM_CHECK(number < kMarkTiles);
  auto tile = layout_->mark_tiles[number].try_load();
  return tile && is_valid(*tile) ? tile : std::nullopt;
}

void ServoSide::push(const TipSample& sample) noexcept { layout_->samples.push(sample); }
void ServoSide::push(const TipEvent& event) noexcept { layout_->events.push(event); }

}  // namespace afm::scene
