// SPDX-License-Identifier: Apache-2.0
#include "curves/conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/file_kind.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/curve_file.h"
#include "curves/curve_series.h"
#include "curves/image_file.h"
#include "curves/image_output.h"
#include "curves/unread_kinds.h"
#include "physics/imaging/scan_image.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

using core::wrong_usage;

// Text on the differences between the converted curve, read back, and the original; empty: none. An error if it cannot
// be read.
core::Result<std::string> rounding(const RecordedCurve& original, const WritableFormat& format,
                                   const std::string& bytes) {
  const auto back = parse_curve(bytes, "the converted curve");
  if (!back) return core::failure(core::ErrorCategory::Failed, back.error().message);
  if (back->points.size() != original.points.size()) {
    return fmt::format("{} points became {}: the format needs even heights and branches of one length",
                       original.points.size(), back->points.size());
  }
  physics::Length height(0);
  physics::Force force(0);
  for (std::size_t i = 0; i < original.points.size(); ++i) {
    height.si = std::max(height.si, std::abs(back->points[i].z.si - original.points[i].z.si));
    force.si = std::max(force.si, std::abs(back->points[i].force.si - original.points[i].force.si));
  }
  if (height.si == 0.0 && force.si == 0.0) return std::string();
  return fmt::format("as {}, heights differ by at most {}, forces by at most {}", format.word,
                     physics::format_quantity(height, physics::kLengthUnits, 2),
                     physics::format_quantity(force, physics::kForceUnits, 2));
}

struct ReadCurves {
  std::vector<RecordedCurve> curves;
  std::vector<std::string> remarks;
};

void add_remark(std::vector<std::string>& remarks, const std::string& remark) {
  const bool known = std::find(remarks.begin(), remarks.end(), remark) != remarks.end();
  if (!known && remarks.size() < kMostRemarks) remarks.push_back(remark);
}

// All curves of the file, or the requested one.
core::Result<ReadCurves> read_all(const std::string& file, const ConversionOptions& options, std::size_t count) {
  ReadCurves all;
  if (options.index || count == 1) {
    CurveReading reading = options.reading;
    reading.index = options.index.value_or(0);
    auto curve = load_curve(file, reading);
    if (!curve) return tl::unexpected(curve.error());
    all.remarks = curve->metadata.remarks;
    all.curves.push_back(std::move(*curve));
    return all;
  }
  std::size_t points = 0;
  std::optional<core::Error> first_fault;
  read_curves(file, count, {}, options.reading, [&](std::size_t index, core::Result<RecordedCurve> curve) {
    if (!curve) {
      if (!first_fault) first_fault = curve.error();
      add_remark(all.remarks, fmt::format("curve {} is left out: {}", index, curve.error().message));
      return true;
    }
    for (const std::string& remark : curve->metadata.remarks) add_remark(all.remarks, remark);
    points += curve->points.size();
    all.curves.push_back(std::move(*curve));
    return points <= kMostConvertedPoints;
  });
  if (all.curves.empty() && first_fault) return tl::unexpected(*first_fault);
  if (points > kMostConvertedPoints) {
    return wrong_usage(fmt::format("{} has more than {} million points in its {} curves; convert one by --curve INDEX",
                                   file, kMostConvertedPoints / 1'000'000, count));
  }
  return all;
}

core::Result<Converted> converted_curves(const std::string& file, const std::string& name,
                                         const ConversionOptions& options) {
  const auto format = writable_format_of(name);
  if (!format) {
    return wrong_usage(fmt::format("{} has curves, and {} is no name for them; {}", file, name, kConvertedFiles));
  }
  if (!options.channel.empty()) return wrong_usage(fmt::format("--channel is for images, and {} has curves", file));
  const auto count = curve_count(file, options.reading);
  if (!count) return tl::unexpected(count.error());
  const bool holds_several = format->format == CurveFormat::Hdf5;
  if (*count > 1 && !options.index && !holds_several) {
    return wrong_usage(
        fmt::format("{} has {} curves, and {} holds one: choose it by --curve INDEX, or name a file "
                    "that ends in .h5",
                    file, *count, name));
  }
  auto all = read_all(file, options, *count);
  if (!all) return tl::unexpected(all.error());
  auto bytes = series_bytes(format->format, all->curves);
  if (!bytes) return tl::unexpected(bytes.error());
  Converted result{.bytes = std::move(*bytes), .contents = {}, .remarks = std::move(all->remarks)};
  std::size_t points = 0;
  for (const RecordedCurve& curve : all->curves) points += curve.points.size();
  result.contents = all->curves.size() == 1 ? fmt::format("1 curve of {} points", points)
                                            : fmt::format("{} curves of {} points", all->curves.size(), points);
  if (all->curves.size() == 1) {
    auto rounded = rounding(all->curves.front(), *format, result.bytes);
    if (!rounded) return tl::unexpected(rounded.error());
    if (!rounded->empty()) result.remarks.push_back(std::move(*rounded));
  }
  return result;
}

core::Result<Converted> converted_image(const std::string& file, const std::string& name,
                                        const ConversionOptions& options) {
  const auto format = image_format(name);
  if (!format) {
    return wrong_usage(fmt::format("{} is an image, and {} is no name for one; {}", file, name, kConvertedFiles));
  }
  if (options.index || options.reading.spring_constant || options.reading.sensitivity_m_per_v) {
    return wrong_usage(
        fmt::format("--curve, --spring-constant and --sensitivity are for curves, and {} is an image", file));
  }
  auto loaded = load_image(file, {.channel = options.channel});
  if (!loaded) return tl::unexpected(loaded.error());
  constexpr const char* kConverter = "Converted by";  // metadata key, kept only for the newest conversion
  std::erase_if(loaded->image.metadata, [](const auto& entry) { return entry.first == kConverter; });
  loaded->image.metadata.emplace_back(kConverter, core::written_by());
  const physics::ScanImage& image = loaded->image;
  Converted result{.bytes = {}, .contents = {}, .remarks = loaded->remarks};
  for (const std::string& other : loaded->left_out) {
    result.remarks.push_back(fmt::format("{} is left out: it has another size or number of points", other));
  }
  for (const UnreadChannel& unread : loaded->unread) {
    result.remarks.push_back(fmt::format("{} is left out: {}", unread.name, unread.reason));
  }
  const physics::ImageChannel& chosen = image.channels[loaded->chosen];
  if (*format == ImageFormat::Gwy) {
    result.bytes = gwy_bytes(image);
    result.contents = fmt::format("{} channel{} of {} x {} points", image.channels.size(),
                                  image.channels.size() == 1 ? "" : "s", image.columns, image.rows);
    return result;
  }
  result.bytes = gsf_bytes(image, loaded->chosen);
  result.contents = fmt::format("{}, {} x {} points", chosen.name, image.columns, image.rows);
  result.remarks.push_back("a .gsf holds one channel, its numbers with seven digits");
  return result;
}

// Refusal of a file that is neither curve nor image.
core::Error refusal_of_other(const std::string& file) {
  const auto beginning = core::read_beginning(file, core::kFileKindBytes);
  if (!beginning) return beginning.error();
  std::error_code unknown;
  std::string kind = unread_kind_of(*beginning, std::filesystem::file_size(file, unknown));
  if (kind.empty()) kind = "of no known kind; a table of numbers needs --columns \"height:um force:nN\"";
  return {core::ErrorCategory::BadInputFile,
          fmt::format("cannot convert {}: it is {}; known are curves: {}; images: {}", file, kind, kCurveFiles,
                      kImageFiles)};
}

}  // namespace

core::Result<Converted> converted(const std::string& file, const std::string& name, const ConversionOptions& options) {
  if (!options.reading.columns && is_image_file(file)) return converted_image(file, name, options);
  if (!options.reading.columns && !is_curve_file(file)) return tl::unexpected(refusal_of_other(file));
  return converted_curves(file, name, options);
}

}  // namespace afm::curves
