// SPDX-License-Identifier: Apache-2.0
// A Vulkan layer that makes a device fail as real ones do, or less able, for tests of what happens then. AFM_TEST_FAULT
// says how:
//   lost:N    the Nth submission, and everything that waits from then on, returns VK_ERROR_DEVICE_LOST
//   hung:N    from the Nth submission on nothing is ever finished: what waits for it has waited long enough at once
//   stuck:F   nothing is finished while the file F exists: what waits for it does so for as long as it may
//   memory:N  from the Nth allocation on there is no device memory
//   surface:N from the Nth picture of a window on its surface is lost, and no other can be had
//   refresh:H a window shows its pictures at the refreshes of an H Hz monitor, as with FIFO
//   one-view  there is no multiview
//   barrier:F surfaces offer VK_NV_present_barrier, which does nothing; F gets a line for each swapchain made with it
//   count     nothing fails
// It counts the device's allocations that are not freed: afm_live_allocations().
// The interface is that of the Vulkan loader's documentation, "Layer Interface" version 2.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace {

struct Fault {
  std::string kind;
  int after = 0;
  std::string file;
};

Fault read_fault() {
  const char* text = std::getenv("AFM_TEST_FAULT");
  if (text == nullptr) return {};
  const std::string all = text;
  const auto colon = all.find(':');
  if (colon == std::string::npos) return {all, 1, {}};
  return {all.substr(0, colon), std::atoi(all.c_str() + colon + 1), all.substr(colon + 1)};
}

// State of the one instance and the one device that the program has at a time.
Fault the_fault;
PFN_vkGetInstanceProcAddr next_instance = nullptr;
PFN_vkGetDeviceProcAddr next_device = nullptr;
PFN_vkGetPhysicalDeviceFeatures2 next_features = nullptr;
PFN_vkEnumerateDeviceExtensionProperties next_extensions = nullptr;
PFN_vkGetPhysicalDeviceSurfaceCapabilities2KHR next_surface = nullptr;
VkInstance the_instance = VK_NULL_HANDLE;
VkDevice the_device = VK_NULL_HANDLE;
std::atomic<int> submissions{0}, allocations{0}, pictures{0}, live_allocations{0};

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(next_device(the_device, name));
}

// True if the fault of that kind has come; `count` counts the calls that lead to it.
bool failing(const char* kind, std::atomic<int>& count, int add) {
  return the_fault.kind == kind && (count += add) >= the_fault.after;
}
bool lost(int add) { return failing("lost", submissions, add); }

// True if a wait ends in a timeout, after the time that it takes.
bool waits_in_vain(std::uint64_t timeout_ns) {
  if (the_fault.kind != "stuck" || ::access(the_fault.file.c_str(), F_OK) != 0) {
    return failing("hung", submissions, 0);
  }
  std::this_thread::sleep_for(std::chrono::nanoseconds(timeout_ns));
  return true;
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit2(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* submits,
                                             VkFence fence) {
  if (lost(1)) {
    next<PFN_vkQueueWaitIdle>("vkQueueWaitIdle")(queue);  // no more use of anything by a lost device
    return VK_ERROR_DEVICE_LOST;
  }
  if (the_fault.kind == "hung") ++submissions;
  return next<PFN_vkQueueSubmit2>("vkQueueSubmit2")(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_semaphores(VkDevice device, const VkSemaphoreWaitInfo* info,
                                               std::uint64_t timeout) {
  if (lost(0)) return VK_ERROR_DEVICE_LOST;
  if (waits_in_vain(timeout)) return VK_TIMEOUT;
  return next<PFN_vkWaitSemaphores>("vkWaitSemaphores")(device, info, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_for_fences(VkDevice device, std::uint32_t count, const VkFence* fences,
                                               VkBool32 all, std::uint64_t timeout) {
  if (waits_in_vain(timeout)) return VK_TIMEOUT;
  return next<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  if (failing("memory", allocations, 1)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result = next<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, callbacks, memory);
  live_allocations += result == VK_SUCCESS ? 1 : 0;
  return result;
}

VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* callbacks) {
  live_allocations -= memory == VK_NULL_HANDLE ? 0 : 1;
  next<PFN_vkFreeMemory>("vkFreeMemory")(device, memory, callbacks);
}

VKAPI_ATTR VkResult VKAPI_CALL acquire_next_image(VkDevice device, VkSwapchainKHR swapchain, std::uint64_t timeout,
                                                  VkSemaphore semaphore, VkFence fence, std::uint32_t* index) {
  if (failing("surface", pictures, 1)) return VK_ERROR_SURFACE_LOST_KHR;
  return next<PFN_vkAcquireNextImageKHR>("vkAcquireNextImageKHR")(device, swapchain, timeout, semaphore, fence, index);
}

// Waits for the next refresh. Monitors of different rates do not stay in step.
VKAPI_ATTR VkResult VKAPI_CALL queue_present(VkQueue queue, const VkPresentInfoKHR* info) {
  if (the_fault.kind == "refresh") {
    using std::chrono::nanoseconds, std::chrono::steady_clock;
    const std::int64_t period = std::nano::den / the_fault.after;
    const std::int64_t now = nanoseconds(steady_clock::now().time_since_epoch()).count();
    std::this_thread::sleep_until(steady_clock::time_point(nanoseconds((now / period + 1) * period)));
  }
  return next<PFN_vkQueuePresentKHR>("vkQueuePresentKHR")(queue, info);
}

// The structure of that type in a chain; null if it has none.
template <class Wanted>
Wanted* in_chain(const void* chain, VkStructureType type) {
  for (auto* each = static_cast<const VkBaseInStructure*>(chain); each != nullptr; each = each->pNext) {
    if (each->sType == type) return const_cast<Wanted*>(reinterpret_cast<const Wanted*>(each));
  }
  return nullptr;
}

// The chain without the structure of that type.
void leave_out(const void* chain, VkStructureType type) {
  for (auto* each = const_cast<VkBaseInStructure*>(static_cast<const VkBaseInStructure*>(chain)); each != nullptr;
       each = const_cast<VkBaseInStructure*>(each->pNext)) {
    if (each->pNext != nullptr && each->pNext->sType == type) each->pNext = each->pNext->pNext;
  }
}

bool offers_barrier() { return the_fault.kind == "barrier"; }

VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* features) {
  next_features(physical, features);
  auto* multiview = in_chain<VkPhysicalDeviceVulkan11Features>(features->pNext,
                                                               VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
  if (multiview != nullptr && the_fault.kind == "one-view") multiview->multiview = VK_FALSE;
  auto* barrier = in_chain<VkPhysicalDevicePresentBarrierFeaturesNV>(
      features->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRESENT_BARRIER_FEATURES_NV);
  if (barrier != nullptr && offers_barrier()) barrier->presentBarrier = VK_TRUE;
}

VKAPI_ATTR VkResult VKAPI_CALL list_extensions(VkPhysicalDevice physical, const char* layer, std::uint32_t* count,
                                               VkExtensionProperties* list) {
  if (!offers_barrier()) return next_extensions(physical, layer, count, list);
  std::uint32_t others = 0;
  next_extensions(physical, layer, &others, nullptr);
  std::vector<VkExtensionProperties> all(others);
  next_extensions(physical, layer, &others, all.data());
  VkExtensionProperties own{VK_NV_PRESENT_BARRIER_EXTENSION_NAME, VK_NV_PRESENT_BARRIER_SPEC_VERSION};
  all.push_back(own);
  if (list != nullptr) std::copy_n(all.begin(), std::min<std::size_t>(*count, all.size()), list);
  const bool whole = list == nullptr || *count >= all.size();
  *count = static_cast<std::uint32_t>(list == nullptr ? all.size() : std::min<std::size_t>(*count, all.size()));
  return whole ? VK_SUCCESS : VK_INCOMPLETE;
}

VKAPI_ATTR VkResult VKAPI_CALL get_surface(VkPhysicalDevice physical, const VkPhysicalDeviceSurfaceInfo2KHR* info,
                                           VkSurfaceCapabilities2KHR* capabilities) {
  const VkResult result = next_surface(physical, info, capabilities);
  auto* barrier = in_chain<VkSurfaceCapabilitiesPresentBarrierNV>(
      capabilities->pNext, VK_STRUCTURE_TYPE_SURFACE_CAPABILITIES_PRESENT_BARRIER_NV);
  if (barrier != nullptr && offers_barrier()) barrier->presentBarrierSupported = VK_TRUE;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_swapchain(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                                const VkAllocationCallbacks* callbacks, VkSwapchainKHR* swapchain) {
  const auto* barrier = in_chain<VkSwapchainPresentBarrierCreateInfoNV>(
      info->pNext, VK_STRUCTURE_TYPE_SWAPCHAIN_PRESENT_BARRIER_CREATE_INFO_NV);
  if (barrier != nullptr && barrier->presentBarrierEnable == VK_TRUE && offers_barrier()) {
    std::ofstream(the_fault.file, std::ios::app) << "barrier\n";
  }
  VkSwapchainCreateInfoKHR own = *info;
  leave_out(&own, VK_STRUCTURE_TYPE_SWAPCHAIN_PRESENT_BARRIER_CREATE_INFO_NV);
  return next<PFN_vkCreateSwapchainKHR>("vkCreateSwapchainKHR")(device, &own, callbacks, swapchain);
}

template <class Info>
Info* link_info(const void* chain, VkStructureType type) {
  for (auto* each = static_cast<const Info*>(chain); each != nullptr; each = static_cast<const Info*>(each->pNext)) {
    if (each->sType == type && each->function == VK_LAYER_LINK_INFO) return const_cast<Info*>(each);
  }
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                                               VkInstance* instance) {
  auto* link = link_info<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  the_fault = read_fault();
  submissions = allocations = pictures = 0;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(next_instance(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, callbacks, instance);
  the_instance = *instance;
  // asked for later, the loader would name this layer again
  next_features =
      reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures2>(next_instance(*instance, "vkGetPhysicalDeviceFeatures2"));
  next_extensions = reinterpret_cast<PFN_vkEnumerateDeviceExtensionProperties>(
      next_instance(*instance, "vkEnumerateDeviceExtensionProperties"));
  next_surface = reinterpret_cast<PFN_vkGetPhysicalDeviceSurfaceCapabilities2KHR>(
      next_instance(*instance, "vkGetPhysicalDeviceSurfaceCapabilities2KHR"));
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks, VkDevice* device) {
  auto* link = link_info<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const auto* multiview =
      in_chain<VkPhysicalDeviceVulkan11Features>(info->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
  const bool asked = multiview != nullptr && multiview->multiview == VK_TRUE;
  if (the_fault.kind == "one-view" && asked) return VK_ERROR_FEATURE_NOT_PRESENT;
  // device features that the driver lacks
  VkDeviceCreateInfo own = *info;
  std::vector<const char*> extensions;
  for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
    const char* name = info->ppEnabledExtensionNames[i];
    if (std::strcmp(name, VK_NV_PRESENT_BARRIER_EXTENSION_NAME) != 0) extensions.push_back(name);
  }
  own.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  own.ppEnabledExtensionNames = extensions.data();
  leave_out(&own, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRESENT_BARRIER_FEATURES_NV);
  const auto instance_function = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  next_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(instance_function(the_instance, "vkCreateDevice"));
  const VkResult result = create(physical, &own, callbacks, device);
  the_device = *device;
  return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance, const char* name);

PFN_vkVoidFunction own_function(const char* name) {
  struct Own {
    const char* name;
    PFN_vkVoidFunction function;
  };
  static const Own kOwn[] = {
      {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(get_instance_function)},
      {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(get_device_function)},
      {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(create_instance)},
      {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(create_device)},
      {"vkGetPhysicalDeviceFeatures2", reinterpret_cast<PFN_vkVoidFunction>(get_features)},
      {"vkEnumerateDeviceExtensionProperties", reinterpret_cast<PFN_vkVoidFunction>(list_extensions)},
      {"vkGetPhysicalDeviceSurfaceCapabilities2KHR", reinterpret_cast<PFN_vkVoidFunction>(get_surface)},
      {"vkCreateSwapchainKHR", reinterpret_cast<PFN_vkVoidFunction>(create_swapchain)},
      {"vkQueueSubmit2", reinterpret_cast<PFN_vkVoidFunction>(queue_submit2)},
      {"vkWaitSemaphores", reinterpret_cast<PFN_vkVoidFunction>(wait_semaphores)},
      {"vkWaitForFences", reinterpret_cast<PFN_vkVoidFunction>(wait_for_fences)},
      {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(allocate_memory)},
      {"vkFreeMemory", reinterpret_cast<PFN_vkVoidFunction>(free_memory)},
      {"vkAcquireNextImageKHR", reinterpret_cast<PFN_vkVoidFunction>(acquire_next_image)},
      {"vkQueuePresentKHR", reinterpret_cast<PFN_vkVoidFunction>(queue_present)},
  };
  for (const Own& own : kOwn) {
    if (std::strcmp(own.name, name) == 0) return own.function;
  }
  return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
  const auto own = own_function(name);
  return own != nullptr ? own : next_device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance, const char* name) {
  const auto own = own_function(name);
  if (own != nullptr) return own;
  return next_instance == nullptr ? nullptr : next_instance(instance, name);
}

}  // namespace

extern "C" [[gnu::visibility("default")]] VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* interface) {
  if (interface->loaderLayerInterfaceVersion < 2) return VK_ERROR_INITIALIZATION_FAILED;
  interface->loaderLayerInterfaceVersion = 2;
  interface->pfnGetInstanceProcAddr = get_instance_function;
  interface->pfnGetDeviceProcAddr = get_device_function;
  interface->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}

extern "C" [[gnu::visibility("default")]] int afm_live_allocations() { return live_allocations; }
