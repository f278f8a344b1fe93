// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "curves/image_file.h"
#include "fuzz/accepted.h"
#include "physics/imaging/levelling.h"

// Whatever the bytes, and whichever format they claim: an image whose channels fill its grid, and which can be levelled
// if a point was measured, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  if (text.starts_with("\x89HDF")) return 0;  // format converted by a separate program
  const auto loaded = afm::curves::parse_image(text, "fuzz", {.channel = {}, .confined = false});
  if (!loaded) return 0;
  ++afm::fuzz::accepted_inputs;
  const auto& image = loaded->image;
  if (loaded->chosen >= image.channels.size()) std::abort();
  for (const auto& channel : image.channels) {
    if (channel.values.size() != image.columns * image.rows) std::abort();
  }
  const auto& heights = image.channels[loaded->chosen].values;
  if (afm::physics::height_statistics(heights).measured == 0) return 0;
  const auto level = afm::physics::levelled(heights, image.columns, image.rows, afm::physics::Levelling::Lines);
  for (const double height : level.heights) {
    if (!std::isfinite(height)) std::abort();
  }
  return 0;
}
