// SPDX-License-Identifier: Apache-2.0
#include "app/options/written_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <system_error>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/image_file.h"
#include "curves/image_output.h"
#include "servo/session_file.h"

namespace afm::app {

namespace {

// Name of a measurement's format, from the file's first bytes; empty: none.
std::string_view measurement_in(const std::string& path) {
  if (servo::is_session_file(path)) return "a session";
  if (curves::is_image_file(path)) return "an image";
  return curves::is_curve_file(path) ? "a curve" : "";
}

// Same, but only for files that an instrument or the live window writes; results replace older results.
std::string_view foreign_measurement_in(const std::string& path) {
  const std::string_view measurement = measurement_in(path);
  if (measurement == "an image" && curves::image_format(path)) return "";
  if (measurement != "a curve") return measurement;
  if (curves::writable_format_of(path)) return "";
  constexpr std::string_view kOwn = "# TouchAFM";
  const auto beginning = core::read_beginning(path, kOwn.size());
  return beginning && *beginning == kOwn ? "" : measurement;
}

bool is_one_file(const std::string& a, const std::string& b) {
  std::error_code missing;
  return std::filesystem::is_regular_file(a, missing) && std::filesystem::equivalent(a, b, missing);
}

core::Result<void> check_not_read(const std::string& written, const GivenOption& out, const GivenOption& in) {
  for (const std::string& text : in.values) {
    const std::size_t colon = text.find(':');
    const std::string behind = colon == std::string::npos ? text : text.substr(colon + 1);
    if (!is_one_file(written, text) && !is_one_file(written, behind)) continue;
    return core::wrong_usage(fmt::format("{} {}: this file is read, too ({}), and would be lost; choose another",
                                         out.name, written, in.name));
  }
  return {};
}

}  // namespace

core::Result<void> check_written_files(std::span<const GivenOption> given) {
  for (const GivenOption& out : given) {
    if (!out.writes) continue;
    const std::string& path = out.values.back();
    const std::string_view measurement = out.draws ? measurement_in(path) : foreign_measurement_in(path);
    for (const GivenOption& in : given) {
      if (!in.reads) continue;
      if (auto checked = check_not_read(path, out, in); !checked) return checked;
    }
    if (measurement.empty()) continue;
    return core::wrong_usage(fmt::format("{} {}: it is {}, which {}; name a new file", out.name, path, measurement,
                                         out.draws ? "a picture would replace" : "would be lost"));
  }
  return {};
}

}  // namespace afm::app
