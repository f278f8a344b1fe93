// SPDX-License-Identifier: Apache-2.0
#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "physics/contact.h"
#include "scene/samples/material_library.h"

// Any bytes: materials that the closed forms accept, or an error. The closed forms throw on unphysical ones.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto library = afm::scene::load_materials(file.path());
  if (!library) return 0;
  ++afm::fuzz::accepted_inputs;
  for (const afm::scene::MaterialEntry& material : library->materials) {
    static_cast<void>(afm::physics::approach_retract_events(material.contact));
  }
  return 0;
}
