// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/json_text.h"
#include "core/whole_file.h"
#include "curves/angle_units.h"
#include "curves/image_output.h"
#include "imaging/scan_run.h"
#include "physics/imaging/levelling.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/contact.h"
#include "python/drive.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/named_row.h"
#include "python/numbers.h"
#include "python/result_type.h"
#include "python/surface.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using imaging::Scan;
using imaging::ScanRequest;
using physics::ImageChannel;
using physics::ScanImage;

double legal(double si, const char* option, const curves::QuantityDomain& domain) {
  const std::string refusal = curves::refusal(si, physics::format_si(si, domain.units), domain);
  if (!refusal.empty()) refuse(fmt::format("--{}: {}", option, refusal));
  return si;
}

physics::Length length(const std::optional<double>& si, const char* option,
                       const curves::QuantityRange<double>& range) {
  return physics::Length(
      legal(si.value_or(0.0), option,
            {physics::kLengthUnits.sort, physics::kLengthUnits.units, si ? std::optional(range) : std::nullopt}));
}

using Numbers = std::map<std::string, double, std::less<>>;

void add_drive_to(Numbers& numbers, const DriveArgument& drive) {
  Drive beside;
  for (const DriveMember& each : kDriveMembers) {
    const auto found = numbers.find(each.option);
    if (found != numbers.end()) beside.*each.value = found->second;
  }
  const Drive all = joined(drive, beside);
  for (const DriveMember& each : kDriveMembers) {
    if (all.*each.value) numbers[std::string(each.option)] = *(all.*each.value);
  }
}

// Takes the numbers of a lever that taps out of the keywords.
void set_tapping(Numbers& numbers, ScanRequest& request) {
  const auto take = [&](const char* option) -> std::optional<double> {
    const auto found = numbers.find(option);
    if (found == numbers.end()) return std::nullopt;
    const double si = found->second;
    numbers.erase(found);
    return si;
  };
  curves::TappingChoice& choice = request.tapping;
  choice.mode = "tapping";
  choice.numbers.free_amplitude = typed(take("free-amplitude"), "m");
  if (choice.numbers.free_amplitude.empty()) refuse("--mode tapping needs --free-amplitude");
  choice.numbers.drive = typed(take("drive"), "Hz");
  choice.numbers.viscosity = typed(take("viscosity"), "Pa*s");
  choice.contact_gap = typed(take("contact-gap"), "m");
  if (!choice.contact_gap.empty()) request.contact.si_values.erase("work-of-adhesion");
  for (const char* option : {"resonance", "quality-factor"}) {
    if (const auto si = take(option)) request.contact.si_values[option] = *si;
  }
  request.amplitude_setpoint = typed(take("amplitude-setpoint"), "m");
}

void set_fields(const Numbers& numbers, ScanRequest& request) {
  for (const auto& [option, si] : numbers) {
    const auto* const field = std::find_if(physics::kScanFields.begin(), physics::kScanFields.end(),
                                           [&](const physics::ScanField& each) { return each.option == option; });
    if (field == physics::kScanFields.end() || curves::find_contact_parameter(option) != nullptr) {
      unknown_keyword("scan", keyword_of(option));
    }
    legal(si, option.c_str(),
          {field->units->sort, field->units->units, curves::QuantityRange<double>{field->smallest, field->largest}});
    request.settings.emplace_back(field, si);
  }
}

physics::Levelling levelling_of(const std::string& word) {
  std::string words;
  for (const physics::LevellingText& row : physics::kLevellings) {
    if (row.word == word) return row.levelling;
    words += (words.empty() ? "" : ", ") + std::string(row.word);
  }
  refuse(fmt::format("unknown levelling \"{}\"; choose {}", word, words));
}

// Object under the tip: a surface, or a contact of a material.
using Sample = std::variant<Surface, Contact>;

// The surface whose parts are given one by one, or that is given as a whole.
Surface surface_of(const std::optional<Sample>& given, Surface parts) {
  if (parts.sample.empty() && (!parts.channel.empty() || parts.level)) {
    refuse("sample_channel and level have no effect without sample");
  }
  const Surface* const whole = given ? std::get_if<Surface>(&*given) : nullptr;
  if (whole == nullptr) return parts;
  if (!parts.sample.empty()) refuse("sample: the surface is one; leave sample out, or give a contact");
  if (!parts.size) parts.size = whole->size;
  return Surface{whole->sample, parts.size, whole->channel, whole->level};
}

std::shared_ptr<Scan> make_scan(const std::optional<Sample>& under_tip,
                                const std::optional<std::filesystem::path>& sample, const std::string& sample_channel,
                                const std::optional<std::string>& level, std::optional<double> size,
                                const std::optional<Whole>& pixels, std::optional<double> x, std::optional<double> y,
                                const std::optional<std::string>& direction, bool feedback,
                                const std::optional<std::string>& tip, std::optional<double> tip_angle, bool show_truth,
                                const std::optional<Whole>& seed, const std::string& mode, const DriveArgument& drive,
                                const py::kwargs& given) {
  ScanRequest request;
  const auto* const contact = under_tip ? std::get_if<Contact>(&*under_tip) : nullptr;
  if (contact != nullptr) request.contact = contact->options();
  request.contact.assets_dir = assets_dir();
  const Surface surface = surface_of(under_tip, {sample.value_or(""), size, sample_channel, level});
  request.sample.file = surface.sample.string();
  request.sample.reading.image.channel = surface.channel;
  if (surface.level) request.sample.reading.levelling = levelling_of(*surface.level);
  request.size = length(surface.size, "size", imaging::kScanSizesM);
  request.x_centre = length(x, "x", imaging::kScanPlacesM);
  request.y_centre = length(y, "y", imaging::kScanPlacesM);
  if (pixels) request.pixels = whole_within("pixels", *pixels, imaging::kFewestPixels, physics::kMostScanPixels);
  if (direction) request.direction = row_named(imaging::kDirections, *direction, "direction").direction;
  if (!feedback) request.feedback = physics::Feedback::Off;
  if (tip) request.tip.kind = row_named(physics::kTipKinds, *tip, "tip").kind;
  if (tip_angle) {
    request.tip.half_angle_rad =
        legal(*tip_angle, "tip-angle", {curves::kAngleUnits.sort, curves::kAngleUnits.units, imaging::kTipAnglesRad});
  }
  request.show_truth = show_truth;
  constexpr std::uint32_t kMostSeed = std::numeric_limits<std::uint32_t>::max();
  if (seed) request.seed = static_cast<std::uint32_t>(whole_within("seed", *seed, 0, kMostSeed));
  Numbers numbers = numbers_of(given);
  add_drive_to(numbers, drive);
  if (mode == "tapping") {
    set_tapping(numbers, request);
  } else if (mode != "contact") {
    refuse(fmt::format("unknown mode \"{}\"; choose contact or tapping", mode));
  }
  set_fields(numbers, request);
  imaging::complete(request, tip.has_value());
  return std::make_shared<Scan>(
      value_of(long_work([request](const std::stop_token& stop) { return imaging::take_scan(request, stop); })));
}

// Read-only view of a channel; `owner` keeps the image alive.
py::array view(const py::handle& owner, const ScanImage& image, const ImageChannel& channel) {
  py::array_t<double> values({image.rows, image.columns}, channel.values.data(), owner);
  values.attr("setflags")(py::arg("write") = false);
  return values;
}

py::dict channels_of(const py::object& self) {
  const ScanImage& image = self.cast<const Scan&>().image;
  py::dict channels;
  for (const ImageChannel& each : image.channels) channels[py::str(each.name)] = view(self, image, each);
  return channels;
}

py::array channel_of(const py::object& self, const std::string& name) {
  const ScanImage& image = self.cast<const Scan&>().image;
  std::string names;
  for (const ImageChannel& each : image.channels) {
    if (each.name == name) return view(self, image, each);
    names += (names.empty() ? "" : ", ") + each.name;
  }
  throw py::key_error(fmt::format("the image has no channel \"{}\"; choose {}", name, names));
}

py::array truth_of(const std::shared_ptr<Scan>& self) {
  const ScanImage image = long_work([scan = self](const std::stop_token&) { return imaging::true_image_of(*scan); });
  py::array_t<double> values({image.rows, image.columns});
  std::copy(image.channels.front().values.begin(), image.channels.front().values.end(), values.mutable_data());
  values.attr("setflags")(py::arg("write") = false);
  return values;
}

void write_scan(const Scan& self, const std::filesystem::path& path, const std::string& channel) {
  const auto format = curves::image_format(path.string());
  if (!format) refuse(fmt::format("{}: name a file that ends in .gwy or .gsf", path.string()));
  ScanImage image(self.image);
  if (!channel.empty()) value_of(imaging::keep_channel(channel, image));
  value_of(long_work([image = std::move(image), path = path.string(), format](const std::stop_token&) {
    return core::write_file(
        path, format == curves::ImageFormat::Gsf ? curves::gsf_bytes(image, 0) : curves::gwy_bytes(image));
  }));
}

py::array level_heights(const GivenArray& heights, const std::string& how) {
  if (heights.ndim() != 2) refuse(fmt::format("heights have two dimensions, rows and columns, not {}", heights.ndim()));
  const auto rows = static_cast<std::size_t>(heights.shape(0)), columns = static_cast<std::size_t>(heights.shape(1));
  std::vector<double> values(heights.data(), heights.data() + heights.size());
  const auto levelled =
      long_work([values = std::move(values), rows, columns, levelling = levelling_of(how)](const std::stop_token&) {
        return physics::levelled(values, columns, rows, levelling).heights;
      });
  py::array_t<double> result({rows, columns});
  std::copy(levelled.begin(), levelled.end(), result.mutable_data());
  return result;
}

void add_scan_class(py::module_& module) {
  py::class_<Scan, std::shared_ptr<Scan>> scan(
      module, "Scan", plain_type(), py::is_final(),
      "An image of the virtual microscope with its artefacts. Channels are arrays of SI numbers, row 0 at the top. "
      "Immutable.");
  const auto add = [&scan](const char* name, double ScanImage::* member, const char* doc) {
    scan.def_property_readonly(name, [member](const Scan& self) { return self.image.*member; }, doc);
  };
  add("width", &ScanImage::width_m, "Width of the area, m.");
  add("height", &ScanImage::height_m, "Height of the area, m.");
  add("x_offset", &ScanImage::x_offset_m, "Left edge of the area, m.");
  add("y_offset", &ScanImage::y_offset_m, "Top edge of the area, m.");
  scan.def_property_readonly("channels", &channels_of,
                             "Every channel by its name, in SI: read-only arrays, rows by columns.")
      .def_property_readonly(
          "units",
          [](const Scan& self) {
            py::dict units;
            for (const ImageChannel& each : self.image.channels) units[py::str(each.name)] = each.unit;
            return units;
          },
          "SI unit of each channel by its name.")
      .def_property_readonly(
          "time", [](const Scan& self) { return self.time_s; }, "Time that the scan took in the instrument, s.")
      .def_property_readonly("truth", &truth_of,
                             "Heights of the surface on the same grid without any artefact, m: what the apex of this "
                             "tip would trace at rest.")
      .def("__getitem__", &channel_of, py::arg("channel"))
      .def("write", &write_scan, py::arg("path"), py::kw_only(), py::arg("channel") = "",
           "Writes .gwy with every channel, or .gsf with one, whole or not at all. FileError if it cannot be written.")
      .def(
          "as_dict", [](const Scan& self) { return dict_of_text(core::json_text(imaging::scan_json(self))); },
          "The JSON of touchafm scan --json: settings and figures of every channel.")
      .def("__repr__", [](const Scan& self) {
        return fmt::format("<touchafm.Scan {} x {}, {:.4g} m>", self.image.columns, self.image.rows,
                           self.image.width_m);
      });
}

}  // namespace

void add_scans(py::module_& module) {
  add_scan_class(module);
  module.def(
      "scan", &make_scan, py::arg("contact") = py::none(), py::kw_only(), py::arg("sample") = py::none(),
      py::arg("sample_channel") = "", py::arg("level") = py::none(), py::arg("size") = py::none(),
      py::arg("pixels") = py::none(), py::arg("x") = py::none(), py::arg("y") = py::none(),
      py::arg("direction") = py::none(), py::arg("feedback").noconvert() = true, py::arg("tip") = py::none(),
      py::arg("tip_angle") = py::none(), py::arg("show_truth").noconvert() = false, py::arg("seed") = py::none(),
      py::arg("mode") = "contact", py::arg("drive") = py::none(),
      "An image of a contact's sample, or of one's own, as touchafm scan takes it.\n\n"
      "contact: of a material, such as Contact.material(\"gold\"), or a surface(); with sample it may be left out.\n"
      "sample: a glTF model or an image, with sample_channel and level (\"none\", \"plane\", \"lines\") of that\n"
      "image, or \"gratings\".\n"
      "size, x and y, m; pixels of a line, and lines; direction \"down\" or \"up\"; tip: \"paraboloid\", \"sphere\",\n"
      "\"cone\", \"pyramid-3\" or \"pyramid-4\" of the contact's radius, with tip_angle, rad; show_truth adds "
      "channels.\n"
      "mode: \"contact\", or \"tapping\", which needs free_amplitude, m, and takes amplitude_setpoint, m (default: "
      "0.8\n"
      "of it), drive, Hz, viscosity, Pa*s, contact_gap, m, resonance, Hz, and quality_factor; or drive is a\n"
      "Drive with these numbers.\n"
      "Further numbers in SI have the names of the command's options: rate Hz, setpoint N, integral_gain 1/s, ...\n"
      "Raises ValueError as the command refuses its options, FileError for a file that cannot be used.\n"
      "docs/physics.md and docs/tapping.md have the equations with their sources.");
  module.def("level", &level_heights, py::arg("heights"), py::arg("how") = "plane",
             "Heights without their tilt, as --level of touchafm analyse: \"plane\" subtracts the plane of least\n"
             "squares, \"lines\" the steps between lines, too. An array of rows by columns, m, in which NaN is not\n"
             "measured and is filled from beside it. The mean stays. Raises ValueError for another shape.");
}

}  // namespace afm::python
