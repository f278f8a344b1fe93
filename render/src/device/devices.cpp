// SPDX-License-Identifier: Apache-2.0
#include "device/device.h"

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
  for (const auto& physical : *found) {
    descriptions.push_back(describe(physical));
  }
  return descriptions;
}

}  // namespace afm::render
