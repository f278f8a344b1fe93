// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/image_file.h"
#include "curves/image_output.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/errors.h"
#include "python/long_work.h"
#include "python/numbers.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using physics::ImageChannel;
using physics::ScanImage;

py::dict read_image(const std::filesystem::path& path, const std::string& channel) {
  const curves::LoadedImage loaded = value_of(long_work([path = path.string(), channel](const std::stop_token&) {
    return curves::load_image(path, {.channel = channel});
  }));
  const ScanImage& image = loaded.image;
  py::dict channels, metadata;
  for (const ImageChannel& each : image.channels) {
    py::array_t<double> values({image.rows, image.columns});
    std::copy(each.values.begin(), each.values.end(), values.mutable_data());
    channels[py::str(each.name)] = py::make_tuple(std::move(values), each.unit);
  }
  for (const auto& [key, value] : image.metadata) metadata[py::str(key)] = value;
  py::dict result;
  result["channels"] = channels;
  result["chosen"] = image.channels.at(loaded.chosen).name;
  result["width"] = image.width_m;
  result["height"] = image.height_m;
  result["metadata"] = metadata;
  result["remarks"] = loaded.remarks;
  return result;
}

// ValueError for a text that the formats cannot hold.
std::string kept(std::string_view what, const std::string& text) {
  if (text.find('\0') != std::string::npos) refuse(fmt::format("{}: a text has a zero byte", what));
  return text;
}

ImageChannel channel_of(const std::string& name, py::handle given) {
  const std::string what = fmt::format("channels[\"{}\"]", name);
  std::optional<GivenArray> values;
  std::string unit;
  if (py::isinstance<py::tuple>(given) && py::len(given) == 2 && py::isinstance<py::str>(given[py::int_(1)])) {
    values = GivenArray::of(given[py::int_(0)]);
    unit = kept(what, given[py::int_(1)].cast<std::string>());
  }
  if (!values) not_numbers(what, "an array and its SI unit, such as (heights, \"m\")", given);
  if (values->ndim() != 2 || values->size() == 0) {
    refuse(fmt::format("{}: an image has two dimensions, rows and columns", what));
  }
  ImageChannel channel{kept(what, name), std::move(unit), {}};
  channel.values.assign(values->data(), values->data() + values->size());
  for (const double value : channel.values) {
    if (std::abs(value) > physics::kMostImageValue) {
      refuse(fmt::format("{}: {:g} is beyond {:g}; mark what was not measured by NaN", what, value,
                         physics::kMostImageValue));
    }
  }
  return channel;
}

double length_of(std::string_view name, double metres) {
  if (!(metres > 0.0 && std::isfinite(metres))) refuse(fmt::format("{}: {:g} m is not positive", name, metres));
  return metres;
}

void write_image(const std::filesystem::path& path, const py::dict& channels, double width, double height,
                 const std::map<std::string, std::string>& metadata) {
  const auto format = curves::image_format(path.string());
  if (!format) refuse(fmt::format("{}: name a file that ends in .gwy or .gsf", path.string()));
  ScanImage image;
  image.width_m = length_of("width", width);
  image.height_m = length_of("height", height);
  std::optional<std::pair<py::ssize_t, py::ssize_t>> shape;
  for (const auto& [key, given] : channels) {
    const std::string name = py::str(key);
    image.channels.push_back(channel_of(name, given));
    const auto values = py::array::ensure(given[py::int_(0)]);
    const std::pair own(values.shape(0), values.shape(1));
    if (shape.value_or(own) != own) {
      refuse(fmt::format("channels[\"{}\"]: it has {} x {} pixels, those before {} x {}", name, own.second, own.first,
                         shape->second, shape->first));
    }
    shape = own;
  }
  if (!shape) refuse("channels: give one at least, {\"Height\": (heights, \"m\")}");
  image.rows = static_cast<std::size_t>(shape->first);
  image.columns = static_cast<std::size_t>(shape->second);
  const bool is_gsf = *format == curves::ImageFormat::Gsf;
  if (is_gsf && image.channels.size() > 1) {
    refuse(fmt::format("{}: .gsf holds one channel, not {}; name a file that ends in .gwy", path.string(),
                       image.channels.size()));
  }
  for (const auto& [key, value] : metadata) image.metadata.emplace_back(kept("metadata", key), kept("metadata", value));
  if (!metadata.contains("Software")) image.metadata.emplace_back("Software", core::written_by());
  value_of(long_work([image = std::move(image), path = path.string(), is_gsf](const std::stop_token&) {
    return core::write_file(path, is_gsf ? curves::gsf_bytes(image, 0) : curves::gwy_bytes(image));
  }));
}

}  // namespace

void add_images(py::module_& module) {
  module.def(
      "read_image", &read_image, py::arg("path"), py::kw_only(), py::arg("channel") = "",
      "An image of a microscope as a dict: \"channels\", by name an array and its SI unit, row 0 at the top;\n"
      "\"chosen\", the name of the asked or the first height channel; \"width\" and \"height\" in m; \"metadata\"\n"
      "and \"remarks\". FileError if it cannot be understood.");
  module.def(
      "write_image", &write_image, py::arg("path"), py::arg("channels"), py::kw_only(), py::arg("width"),
      py::arg("height"), py::arg("metadata") = std::map<std::string, std::string>(),
      "Writes an image for other programs, whole or not at all: .gwy with every channel, or .gsf with one.\n\n"
      "channels: by name an array of rows by columns, row 0 at the top, and its SI unit, as read_image()\n"
      "gives them; NaN is what was not measured. width, height: of the whole image, m. metadata: texts.\n"
      "ValueError for channels of different shapes and numbers beyond 1e100, FileError if it cannot be written.");
}

}  // namespace afm::python
