// SPDX-License-Identifier: Apache-2.0
#include "composition/composer.h"

#include <algorithm>
#include <array>
#include <span>

#include "composition/readback.h"
#include "device/barriers.h"
#include "device/pipelines.h"
#include "device/shader_interface.h"
#include "drawing/pixel_tiles.h"
#include "shaders/compose_frag.h"
#include "shaders/fullscreen_vert.h"

namespace afm::render {
namespace {

using scene::EyeArrangement;

vk::DescriptorSetLayoutBinding binding(std::uint32_t index, vk::DescriptorType type) {
  return {
      .binding = index, .descriptorType = type, .descriptorCount = 1, .stageFlags = vk::ShaderStageFlagBits::eFragment};
}

vk::raii::DescriptorSetLayout create_composing_set_layout(const Device& device) {
  const std::array bindings{binding(AFM_BINDING_TEXTURE, vk::DescriptorType::eCombinedImageSampler),
                            binding(AFM_BINDING_LINEAR, vk::DescriptorType::eCombinedImageSampler),
                            binding(AFM_BINDING_ANAGLYPH, vk::DescriptorType::eUniformBuffer)};
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorPool create_composing_pool(const Device& device) {
  const std::array sizes{
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 2},
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eUniformBuffer, .descriptorCount = 1}};
  return vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                            .maxSets = 1,
                                            .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                            .pPoolSizes = sizes.data()});
}

// Index of an anaglyph's matrices in the block, in the order of kStereoModes.
std::size_t anaglyph_index(scene::StereoMode mode) {
  const auto* const end = scene::kStereoModes.begin() + static_cast<std::size_t>(mode);
  return static_cast<std::size_t>(
      std::count_if(scene::kStereoModes.begin(), end, [](const auto& row) { return row.anaglyph.has_value(); }));
}

static_assert(std::count_if(scene::kStereoModes.begin(), scene::kStereoModes.end(),
                            [](const auto& row) { return row.anaglyph.has_value(); }) <= AFM_MOST_ANAGLYPHS);

Buffer upload_anaglyphs(const Device& device) {
  AnaglyphBlock block{};
  for (const scene::StereoModeTraits& row : scene::kStereoModes) {
    if (!row.anaglyph) {
      continue;
    }
    const std::size_t i = anaglyph_index(row.mode);
    block.left[i] = glm::mat4(glm::mat3(row.anaglyph->left));
    block.right[i] = glm::mat4(glm::mat3(row.anaglyph->right));
  }
  return upload_buffer(device, "anaglyph matrices", std::as_bytes(std::span(&block, 1)),
                       vk::BufferUsageFlagBits::eUniformBuffer);
}

// Arrangement of one layer. In modes with two pictures, layer 1 is the right eye's.
EyeArrangement arrangement_of(scene::StereoMode mode, std::uint32_t layer) {
  const EyeArrangement arrangement = scene::traits_of(mode).arrangement;
  if (arrangement != EyeArrangement::TwoPictures) {
    return arrangement;
  }
  return layer == 0 ? EyeArrangement::Left : EyeArrangement::Right;
}

ComposeBlock compose_block(const EyeTargets& eyes, const Composition& composition, const ComposePlace& place,
                           std::uint32_t layer) {
  const auto mode = composition.mode;
  const bool swapped = composition.order == scene::EyeOrder::Swapped && mode != scene::StereoMode::Mono;
  const bool keystone = composition.picture_from_output != glm::dmat3(1.0);
  ComposeBlock block{
      .mode = {static_cast<int>(arrangement_of(mode, layer)), swapped, keystone,
               static_cast<int>(anaglyph_index(mode))},
      .eyes = {eyes.same_eyes() ? 1 : 0, 0, 0, 0},
      .place = {place.area.offset.x, place.area.offset.y, place.area.extent.width, place.area.extent.height},
      .screen = {place.screen_px.x, place.screen_px.y, 0, 0},
      .picture_from_output = {}};
  if (const auto& packing = scene::frame_packing(mode)) {
    block.screen.z = static_cast<int>(packing->eye_px.y);
    block.screen.w = static_cast<int>(packing->blank_lines);
  }
  for (int column = 0; column < 3; ++column) {
    block.picture_from_output[column] = glm::vec4(composition.picture_from_output[column], 0.0);
  }
  block.picture_from_output[0].w = composition.mesh_lines ? 1.0F : 0.0F;
  return block;
}

bool is_exact(const EyeTargets& eyes, const Composition& composition, const ComposePlace& place) {
  const vk::Extent2D whole = eyes.extent();
  const glm::uvec2 seen = scene::eye_size(composition.mode, {place.area.extent.width, place.area.extent.height});
  return !scene::traits_of(composition.mode).squeezed && composition.picture_from_output == glm::dmat3(1.0) &&
         !composition.warp && seen == glm::uvec2(whole.width, whole.height);
}

// Variant of the pipeline for this picture.
std::uint32_t composing_variant_of(const EyeTargets& eyes, const Composition& composition, const ComposePlace& place) {
  const bool mixed = scene::anaglyph_matrices(composition.mode).has_value();
  return (is_exact(eyes, composition, place) ? 0U : AFM_FEATURE_SCALED) | (mixed ? AFM_FEATURE_MIXED : 0U) |
         (composition.warp ? AFM_FEATURE_WARPED : 0U) | (composition.blend ? AFM_FEATURE_BLENDED : 0U);
}

// True if the target shows only the eyes' complete images, side by side.
bool shows_eyes_alone(const EyeTargets& eyes, const Composition& composition, const ComposePlace& place) {
  const EyeArrangement eyes_in_it = arrangement_of(composition.mode, 0);
  const bool beside = eyes_in_it == EyeArrangement::Left || eyes_in_it == EyeArrangement::Right ||
                      eyes_in_it == EyeArrangement::SideBySide || eyes_in_it == EyeArrangement::TopBottom;
  const glm::uvec2 size = scene::picture_size(composition.mode, {eyes.extent().width, eyes.extent().height});
  return beside && !composition.blend && is_exact(eyes, composition, place) && place.area.extent == place.target &&
         glm::uvec2(place.target.width, place.target.height) == size;
}

// Positions of the eyes' images on a target: one box each, or one shared box.
struct EyeBoxes {
  std::array<PixelBox, 2> boxes;
  std::size_t count = 1;
};

EyeBoxes boxes_of_eyes(EyeArrangement arrangement, const vk::Rect2D& area) {
  const glm::ivec2 low(area.offset.x, area.offset.y);
  const glm::ivec2 size(static_cast<int>(area.extent.width), static_cast<int>(area.extent.height));
  if (arrangement != EyeArrangement::SideBySide && arrangement != EyeArrangement::TopBottom) {
    return {.boxes = {PixelBox{low, low + size}, {}}};
  }
  const glm::length_t axis = arrangement == EyeArrangement::SideBySide ? 0 : 1;
  glm::ivec2 half = size, step(0);
  half[axis] = std::max(1, size[axis] / 2);
  step[axis] = half[axis];
  return {.boxes = {PixelBox{low, low + half}, PixelBox{low + step, low + step + half}}, .count = 2};
}

// Size of the part of the picture covered by one eye's image, with the same split as compose.frag.
vk::Extent2D region_of_eye(const EyeTargets& eyes, const Composition& composition, const ComposePlace& place) {
  if (const auto& packing = scene::frame_packing(composition.mode)) return {eyes.extent().width, packing->eye_px.y};
  const PixelBox box = boxes_of_eyes(scene::traits_of(composition.mode).arrangement, place.area).boxes[0];
  return {static_cast<std::uint32_t>(box.high.x - box.low.x), static_cast<std::uint32_t>(box.high.y - box.low.y)};
}

// Pixels of `shown`, which an eye's image of that size covers, that depend on `box` of that image. Scaled pixels are
// blended from their neighbours.
PixelBox scaled_into(const PixelBox& shown, const PixelBox& box, vk::Extent2D eye) {
  const glm::dvec2 scale = glm::dvec2(shown.high - shown.low) / glm::dvec2(eye.width, eye.height);
  if (scale == glm::dvec2(1.0)) return {shown.low + box.low, shown.low + box.high};
  const glm::ivec2 low(glm::floor(scale * glm::dvec2(box.low - 1)));
  const glm::ivec2 high(glm::ceil(scale * glm::dvec2(box.high + 1)));
  return PixelBox{shown.low + low - 1, shown.low + high + 1}.within(shown);
}

}  // namespace

ComposePipeline::ComposePipeline(const Device& device, vk::PipelineLayout layout, vk::Format format)
    : device_(&device), layout_(layout), format_(format) {
  for (int i = 0; i < AFM_COMPOSE_VARIANTS; ++i) made_.emplace_back(nullptr);
}

vk::Pipeline ComposePipeline::get(std::uint32_t variant) {
  auto& pipeline = made_.at(variant);
  if (!*pipeline) {
    pipeline = create_pipeline(*device_, {.name = "compose",
                                          .vertex_code = shaders::fullscreen_vert,
                                          .fragment_code = shaders::compose_frag,
                                          .layout = layout_,
                                          .topology = vk::PrimitiveTopology::eTriangleStrip,
                                          .color_format = format_,
                                          .variant = variant});
  }
  return *pipeline;
}

Composer::Composer(const Device& device, const EyeTargets& eyes, const EyeChanges& changes)
    : device_(device),
      eyes_(eyes),
      changes_(changes),
      corrections_(device),
      set_layout_(create_composing_set_layout(device)),
      layout_(create_pipeline_layout(device, {.sets = std::array{*set_layout_, corrections_.layout()},
                                              .push_stages = vk::ShaderStageFlagBits::eFragment,
                                              .push_size = sizeof(ComposeBlock)})),
      pipeline_(create_pipeline_for(kEyeFormat)),
      sampler_(*device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear,
                                              .minFilter = vk::Filter::eLinear,
                                              .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                              .addressModeV = vk::SamplerAddressMode::eClampToEdge}),
      anaglyphs_(upload_anaglyphs(device)),
      pool_(create_composing_pool(device)) {
  set_ = std::move(vk::raii::DescriptorSets(
                       *device, {.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &*set_layout_})
                       .front());
  const vk::DescriptorBufferInfo anaglyphs{.buffer = *anaglyphs_.buffer, .range = VK_WHOLE_SIZE};
  device_->updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *set_,
                                                       .dstBinding = AFM_BINDING_ANAGLYPH,
                                                       .descriptorCount = 1,
                                                       .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                       .pBufferInfo = &anaglyphs},
                                nullptr);
  eyes_changed();
}

void Composer::eyes_changed() {
  const auto write = [this](std::uint32_t binding, vk::ImageView view) {
    const vk::DescriptorImageInfo image{
        .sampler = *sampler_, .imageView = view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
    device_->updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *set_,
                                                         .dstBinding = binding,
                                                         .descriptorCount = 1,
                                                         .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                         .pImageInfo = &image},
                                  nullptr);
  };
  write(AFM_BINDING_TEXTURE, eyes_.both_eyes());
  write(AFM_BINDING_LINEAR, eyes_.both_eyes_linear());
}

vk::Extent2D Composer::extent(scene::StereoMode mode) const {
  const auto size = scene::picture_size(mode, {eyes_.extent().width, eyes_.extent().height});
  return {size.x, size.y};
}

// Pixels of the target that are out of date with the eyes.
PixelArea Composer::changed_in(const ComposeInto& into, const Drawn& drawn) const {
  const auto& [composition, place, correction] = drawn;
  PixelArea changed;
  const auto& shown = *into.shown;
  if (!shown || shown->composition != composition || shown->place != place) {
    changed.add_everything();
    return changed;
  }
  const PixelArea in_eyes = changes_.since(shown->eye_changes, eyes_.extent());
  const bool simple =
      composition.picture_from_output == glm::dmat3(1.0) && !scene::frame_packing(composition.mode).has_value();
  if (in_eyes.everything() || (!simple && !in_eyes.empty())) {
    changed.add_everything();
    return changed;
  }
  const EyeBoxes eyes = boxes_of_eyes(scene::traits_of(composition.mode).arrangement, place.area);
  PixelTiles tiles(place.target);
  for (const PixelBox& box : in_eyes.boxes()) {
    for (std::size_t i = 0; i < eyes.count; ++i) {
      if (composition.warp) {
        correction.add_moved(box, eyes_.extent(), eyes.boxes[i].low, tiles);
      } else {
        tiles.add(scaled_into(eyes.boxes[i], box, eyes_.extent()));
      }
    }
  }

  // the target is black outside the picture
  const glm::ivec2 low(place.area.offset.x, place.area.offset.y);
  const PixelBox picture{
      low, low + glm::ivec2(static_cast<int>(place.area.extent.width), static_cast<int>(place.area.extent.height))};
  return tiles.area().within(picture);
}

void Composer::draw(const vk::raii::CommandBuffer& command, vk::Pipeline pipeline, const Drawn& drawn,
                    const vk::Rect2D& part, std::uint32_t layer) const {
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
  set_viewport(command, drawn.place.target);
  command.setScissor(0, part);
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, std::array{*set_, drawn.correction.set()},
                             nullptr);
  command.pushConstants<ComposeBlock>(*layout_, vk::ShaderStageFlagBits::eFragment, 0,
                                      compose_block(eyes_, drawn.composition, drawn.place, layer));
  command.draw(4, 1, 0, 0);
}

void Composer::draw_parts(const vk::raii::CommandBuffer& command, ComposePipeline& pipeline, const Drawn& drawn,
                          const ComposeInto& into, const PixelArea& changed) const {
  const vk::Pipeline chosen = pipeline.get(composing_variant_of(eyes_, drawn.composition, drawn.place));
  const auto pass = [&](std::uint32_t layer, const vk::Rect2D& filled, const vk::Rect2D& part) {
    const vk::RenderingAttachmentInfo color{
        .imageView = into.layers[layer],
        .imageLayout = kColorDrawn.layout,
        .loadOp = filled == part ? vk::AttachmentLoadOp::eDontCare : vk::AttachmentLoadOp::eClear,
        .storeOp = vk::AttachmentStoreOp::eStore,
        .clearValue = vk::ClearColorValue(std::array{0.0F, 0.0F, 0.0F, 1.0F})};
    command.beginRendering(
        {.renderArea = filled, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &color});
    draw(command, chosen, drawn, part, layer);
    command.endRendering();
  };
  for (std::uint32_t layer = 0; layer < into.layers.size(); ++layer) {
    if (changed.everything()) pass(layer, {.extent = drawn.place.target}, drawn.place.area);
    for (const PixelBox& box : changed.boxes()) pass(layer, box.rect(), box.rect());
  }
}

void Composer::copy(const vk::raii::CommandBuffer& command, const Composition& composition, const ComposeInto& into,
                    const PixelBox& box) const {
  const bool swapped = composition.order == scene::EyeOrder::Swapped && composition.mode != scene::StereoMode::Mono;
  const auto put = [&](scene::Eye eye, std::uint32_t layer, vk::Offset2D place) {
    const bool left = (eye == scene::Eye::Left) != swapped;
    eyes_.copy(command, left ? scene::Eye::Left : scene::Eye::Right, box, into.image, layer, place);
  };
  const auto width = static_cast<std::int32_t>(eyes_.extent().width);
  const auto height = static_cast<std::int32_t>(eyes_.extent().height);
  for (std::uint32_t layer = 0; layer < into.layers.size(); ++layer) {
    const EyeArrangement arrangement = arrangement_of(composition.mode, layer);
    put(arrangement == EyeArrangement::Right ? scene::Eye::Right : scene::Eye::Left, layer, {0, 0});
    if (arrangement == EyeArrangement::SideBySide) put(scene::Eye::Right, layer, {width, 0});
    if (arrangement == EyeArrangement::TopBottom) put(scene::Eye::Right, layer, {0, height});
  }
}

// Copies parts of the eyes' images, whose pixels equal the target's.
void Composer::copy_parts(const vk::raii::CommandBuffer& command, const Composition& composition,
                          const ComposeInto& into, const PixelArea& changed) const {
  eyes_.begin_copies(command);
  if (changed.everything()) {
    copy(command, composition, into, PixelBox::whole(eyes_.extent()));
  } else {
    const PixelArea in_eyes = changes_.since((*into.shown)->eye_changes, eyes_.extent());
    for (const PixelBox& box : in_eyes.boxes()) copy(command, composition, into, box);
  }
  eyes_.end_copies(command);
}

void Composer::record(const vk::raii::CommandBuffer& command, ComposePipeline& pipeline, const Composition& composition,
                      const ComposePlace& place, const ComposeInto& into) {
  const Drawn drawn{composition, place, corrections_.find(composition, region_of_eye(eyes_, composition, place))};
  const PixelArea changed = changed_in(into, drawn);
  const ImageUse found{into.before.stages, into.before.access, into.after.layout};
  if (changed.empty()) {
    if (found.stages != into.after.stages) {
      record_barriers(command, {image_barrier(into.image, kColorAspect, found, into.after)});
    }
  } else {
    const bool copied = into.takes_copies && shows_eyes_alone(eyes_, composition, place);
    const ImageUse& used = copied ? kCopiedTo : kColorDrawn;
    const ImageUse from = changed.everything() ? found.discarded() : found;
    record_barriers(command, {image_barrier(into.image, kColorAspect, from, used)});
    if (copied) {
      copy_parts(command, composition, into, changed);
    } else {
      draw_parts(command, pipeline, drawn, into, changed);
    }
    record_barriers(command, {image_barrier(into.image, kColorAspect, used, into.after)});
  }
  *into.shown = ComposedPicture{composition, place, changes_.count()};
}

void Composer::record(const vk::raii::CommandBuffer& command, const Composition& composition, const ReadArea& area,
                      ComposeTarget& target) {
  const std::uint32_t count = scene::has_two_pictures(composition.mode) ? 2 : 1;
  const vk::Extent2D size =
      area.size_px == glm::uvec2(0) ? extent(composition.mode) : vk::Extent2D{area.size_px.x, area.size_px.y};
  if (target.image.extent != size || target.image.layers != count) {
    target.image = create_image(device_, "composed",
                                {.format = kEyeFormat,
                                 .extent = size,
                                 .usage = vk::ImageUsageFlagBits::eColorAttachment |
                                          vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst,
                                 .layers = count});
    for (std::uint32_t i = 0; i < count; ++i) target.views[i] = create_view(device_, target.image, kColorAspect, i, 1);
    target.shown.reset();
  }
  const std::array layers{*target.views[0], *target.views[1]};
  record(command, pipeline_, composition, {.target = size, .area = {.extent = size}, .screen_px = area.screen_px},
         {.image = *target.image.image,
          .layers = std::span(layers).first(count),
          .before = kCopiedFrom,
          .after = kCopiedFrom,
          .takes_copies = true,
          .shown = &target.shown});
}

std::vector<Image> Composer::compose(const Composition& composition, const ReadArea& area) {
  HostCopy copy;
  device_.run_once([&](const vk::raii::CommandBuffer& command) {
    record(command, composition, area, target_);
    copy.record(device_, command, *target_.image.image, target_.image.layers, target_.image.extent);
  });
  std::vector<Image> pictures;
  pictures.reserve(target_.image.layers);
  for (std::uint32_t layer = 0; layer < target_.image.layers; ++layer) {
    pictures.push_back(to_image(copy.picture(layer)));
  }
  return pictures;
}

}  // namespace afm::render
