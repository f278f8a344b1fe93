// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace afm::python {

// A sample in place of a material's, as the arguments of scan() that describe it.
struct Surface {
  std::filesystem::path sample;
  std::optional<double> size;  // width of an image, m; empty: of the whole sample
  std::string channel;
  std::optional<std::string> level;
};

}  // namespace afm::python
