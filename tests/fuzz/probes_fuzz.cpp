// SPDX-License-Identifier: Apache-2.0
#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "physics/contact_parameters.h"
#include "scene/samples/probe_library.h"

// Whatever the bytes: probes that a sample accepts, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto library = afm::scene::load_probes(file.path());
  if (!library) return 0;
  ++afm::fuzz::accepted_inputs;
  afm::scene::MaterialEntry material;
  material.contact.sample_stiffness = afm::physics::Stiffness(1.0);
  material.contact.hamaker = afm::physics::Energy(1e-20);
  material.contact.mean_surface_energy = afm::physics::SurfaceEnergy(1e-3);
  material.sample_elasticity = afm::physics::Elasticity{afm::physics::Pressure(1e9), 0.3};
  for (const afm::scene::ProbeEntry& probe : library->probes) {
    afm::physics::validate(afm::scene::with_probe(material, probe).contact);
  }
  return 0;
}
