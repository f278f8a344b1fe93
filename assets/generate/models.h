// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model_file.h"

// Models of assets/models, one function per file or family. Sizes are the instrument's true ones in metres, except
// for the swatches, the optics and the wand, which have their sizes in the room.
namespace afm::generate {

Model probe();                 // chip, V-shaped cantilever, pyramidal tip
std::vector<Model> samples();  // one patch each of mica, gold and silicon nitride
Model stage();
Model room();                   // the floor below the exhibit
std::vector<Model> swatches();  // targets of the wand for choosing a material
Model optics();                 // laser, four-quadrant photodiode, beam, spot
Model wand();
Model analogy();               // a magnet on a spring above an iron plate
Model journey();               // the instrument from the bench to its last atom, all about the contact point
Model companions();            // familiar objects in the journey, at their true sizes
std::vector<Model> grounds();  // samples in the journey, from 5 mm to their atoms
Model marks();                 // lines of the ruler and of the bend

inline std::vector<Model> all_models() {
  std::vector<Model> models{probe(), stage(), room(), optics(), wand(), marks(), journey(), companions(), analogy()};
  for (Model& model : samples()) models.push_back(std::move(model));
  for (Model& model : grounds()) models.push_back(std::move(model));
  for (Model& model : swatches()) models.push_back(std::move(model));
  return models;
}

}  // namespace afm::generate
