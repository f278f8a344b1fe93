// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "stand_in.h"

namespace afm::stand_in {
namespace {

std::uint32_t memory_type(std::uint32_t bits, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties properties;
  vkGetPhysicalDeviceMemoryProperties(stand_in().physical, &properties);
  for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    if ((bits & (1U << i)) != 0 && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  return 0;
}

VkDeviceMemory allocate(const VkMemoryRequirements& needed, VkMemoryPropertyFlags wanted) {
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needed.size;
  info.memoryTypeIndex = memory_type(needed.memoryTypeBits, wanted);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  vkAllocateMemory(stand_in().device, &info, nullptr, &memory);
  return memory;
}

template <class Record>
void run(Record&& record) {
  StandIn& s = stand_in();
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.queueFamilyIndex = s.family;
  VkCommandPool pool = VK_NULL_HANDLE;
  vkCreateCommandPool(s.device, &pool_info, nullptr, &pool);
  VkCommandBufferAllocateInfo allocate_info{};
  allocate_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocate_info.commandPool = pool;
  allocate_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate_info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  vkAllocateCommandBuffers(s.device, &allocate_info, &commands);
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  vkBeginCommandBuffer(commands, &begin);
  record(commands);
  vkEndCommandBuffer(commands);
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  vkQueueSubmit(s.queue, 1, &submit, VK_NULL_HANDLE);
  vkQueueWaitIdle(s.queue);
  vkDestroyCommandPool(s.device, pool, nullptr);
}

VkImageAspectFlags aspect_of(const Swapchain& chain) {
  return chain.has_depth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

// Layout in which the specification lends images.
VkImageLayout lent_layout(const Swapchain& chain) {
  return chain.has_depth() ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                           : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

void change(VkCommandBuffer commands, const Swapchain& chain, VkImage image, VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect_of(chain), 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr,
                       0, nullptr, 1, &barrier);
}

}  // namespace

Swapchain* create_images(const XrSwapchainCreateInfo& info, std::uint32_t count) {
  auto* chain = new Swapchain();
  chain->info = info;
  for (std::uint32_t i = 0; i < count; ++i) {
    VkImageCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = static_cast<VkFormat>(info.format);
    create.extent = {info.width, info.height, 1};
    create.mipLevels = 1;
    create.arrayLayers = info.arraySize;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = VkImageUsageFlags{VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT} |
                   VkImageUsageFlags{chain->has_depth() ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                        : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
    VkImage image = VK_NULL_HANDLE;
    vkCreateImage(stand_in().device, &create, nullptr, &image);
    VkMemoryRequirements needed;
    vkGetImageMemoryRequirements(stand_in().device, image, &needed);
    chain->images.push_back(image);
    chain->memory.push_back(allocate(needed, 0));
    vkBindImageMemory(stand_in().device, image, chain->memory.back(), 0);
    run([&](VkCommandBuffer commands) {
      change(commands, *chain, image, VK_IMAGE_LAYOUT_UNDEFINED, lent_layout(*chain));
    });
  }
  return chain;
}

void destroy_images(Swapchain* chain) {
  for (std::size_t i = 0; i < chain->images.size(); ++i) {
    vkDestroyImage(stand_in().device, chain->images[i], nullptr);
    vkFreeMemory(stand_in().device, chain->memory[i], nullptr);
  }
  delete chain;
}

SubmittedImage read_image(const Swapchain& chain, std::uint32_t layer, const XrRect2Di& rect) {
  StandIn& s = stand_in();
  SubmittedImage read;
  read.format = chain.info.format;
  read.width = static_cast<std::uint32_t>(rect.extent.width);
  read.height = static_cast<std::uint32_t>(rect.extent.height);
  read.layer = layer;
  read.bytes.resize(std::size_t{4} * read.width * read.height);
  VkBufferCreateInfo create{};
  create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  create.size = read.bytes.size();
  create.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  vkCreateBuffer(s.device, &create, nullptr, &buffer);
  VkMemoryRequirements needed;
  vkGetBufferMemoryRequirements(s.device, buffer, &needed);
  const VkDeviceMemory memory =
      allocate(needed, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  vkBindBufferMemory(s.device, buffer, memory, 0);
  // the image that was given back last
  const auto count = static_cast<std::uint32_t>(chain.images.size());
  VkImage image = chain.images[(chain.next + count - 1) % count];
  run([&](VkCommandBuffer commands) {
    change(commands, chain, image, lent_layout(chain), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {aspect_of(chain), 0, layer, 1};
    copy.imageOffset = {rect.offset.x, rect.offset.y, 0};
    copy.imageExtent = {read.width, read.height, 1};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    change(commands, chain, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, lent_layout(chain));
  });
  void* mapped = nullptr;
  vkMapMemory(s.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
  std::memcpy(read.bytes.data(), mapped, read.bytes.size());
  vkDestroyBuffer(s.device, buffer, nullptr);
  vkFreeMemory(s.device, memory, nullptr);
  return read;
}

}  // namespace afm::stand_in
