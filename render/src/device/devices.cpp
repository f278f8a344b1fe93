// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "device/device.h"
#include "device/device_choice.h"

namespace afm::render {

core::Result<std::vector<DeviceDescription>> list_devices() {
  auto loader = open_loader();
  if (!loader) {
    return tl::unexpected(loader.error());
  }
  MessageSink sink;
  auto instance = create_instance(**loader, Validation::Off, Presentation::None, sink);
  if (!instance) {
    return tl::unexpected(instance.error());
  }
  auto found = physical_devices(*instance);
  if (!found) {
    return tl::unexpected(found.error());
  }
  std::vector<DeviceDescription> descriptions;
  std::vector<std::string> names = device_names(*found);
  descriptions.reserve(found->size());
  for (std::size_t i = 0; i < found->size(); ++i) {
    descriptions.push_back(describe((*found)[i], std::move(names[i])));
  }
  return descriptions;
}

}  // namespace afm::render
