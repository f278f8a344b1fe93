// SPDX-License-Identifier: Apache-2.0
#include "hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "core/version.h"
#include "curves/curve_error.h"
#include "formats/afmformats_metadata.h"
#include "formats/segments.h"
#include "hdf5_handles.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostCurves = 1'000'000;

// Writes a text of variable length: h5py returns texts of fixed length as bytes, which afmformats does not recognise.
void put_attribute(hid_t at, const std::string& name, const std::string& text) {
  const Handle type = must(H5Tcopy(H5T_C_S1), "make a type"), space = must(H5Screate(H5S_SCALAR), "make a space");
  must_do(H5Tset_size(type.get(), H5T_VARIABLE), "size a text");
  must_do(H5Tset_cset(type.get(), H5T_CSET_UTF8), "encode a text");
  const Handle attribute =
      must(H5Acreate2(at, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), "make an attribute");
  const char* characters = text.c_str();
  must_do(H5Awrite(attribute.get(), type.get(), static_cast<const void*>(&characters)), "write an attribute");
}

void put_attribute(hid_t at, const std::string& name, double number) {
  const Handle space = must(H5Screate(H5S_SCALAR), "make a space");
  const Handle attribute =
      must(H5Acreate2(at, name.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT), "make an attribute");
  must_do(H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, &number), "write an attribute");
}

template <class T>
void put_column(hid_t group, const char* name, const char* unit, hid_t file_type, hid_t memory_type,
                const std::vector<T>& values) {
  const hsize_t count = values.size();
  const Handle space = must(H5Screate_simple(1, &count, nullptr), "make a space");
  const Handle made = must(H5Pcreate(H5P_DATASET_CREATE), "prepare a data set");
  must_do(H5Pset_obj_track_times(made.get(), false), "leave the time out");
  const Handle column =
      must(H5Dcreate2(group, name, file_type, space.get(), H5P_DEFAULT, made.get(), H5P_DEFAULT), "make a data set");
  must_do(H5Dwrite(column.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write a data set");
  put_attribute(column.get(), "unit", std::string(unit));
}

void put_curve(hid_t group, const RecordedCurve& curve) {
  const nlohmann::ordered_json metadata = afmformats_metadata(curve);
  for (const auto& [key, value] : metadata.items()) {
    if (value.is_string()) {
      put_attribute(group, key, value.get<std::string>());
    } else {
      put_attribute(group, key, value.get<double>());
    }
  }
  std::vector<double> force, height;
  std::vector<unsigned char> segment;
  for (const physics::CurvePoint& point : curve.points) {
    force.push_back(point.force.si);
    height.push_back(point.z.si);
    segment.push_back(point.branch == physics::Branch::Approach ? 0 : 1);
  }
  put_column(group, "force", "N", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, force);
  put_column(group, "height (measured)", "m", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, height);
  put_column(group, "segment", "", H5T_STD_U8LE, H5T_NATIVE_UCHAR, segment);
  if (!curve.time_s.empty()) put_column(group, "time", "s", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, curve.time_s);
}

// Writes to the file's root: afmformats rejects a curve with unknown keys but ignores them at the root.
void put_parameters(hid_t file, const CurveMetadata& metadata) {
  for (const auto& [key, value] : metadata.parameters) {
    if (H5Aexists(file, key.c_str()) != 0) continue;
    if (const auto number = number_of(value)) {
      put_attribute(file, key, *number);
    } else {
      put_attribute(file, key, value);
    }
  }
}

// Attributes that afmformats may have written, as JSON in its format.
nlohmann::json metadata_of(hid_t group) {
  constexpr std::array kKeys{"imaging mode",  "spring constant", "sensitivity",  "speed approach",   "speed retract",
                             "setpoint",      "instrument",      "software",     "software version", "date",
                             "time",          "curve id",        "position x",   "position y",       "grid center x",
                             "grid center y", "grid index x",    "grid index y", "grid shape x",     "grid shape y",
                             "grid size x",   "grid size y"};
  nlohmann::json metadata = nlohmann::json::object();
  for (const char* key : kKeys) {
    if (H5Aexists(group, key) <= 0) continue;
    const Handle attribute = must(H5Aopen(group, key, H5P_DEFAULT), "open an attribute");
    const Handle type = must(H5Aget_type(attribute.get()), "read a type");
    const Handle space = must(H5Aget_space(attribute.get()), "read a space");
    if (H5Sget_simple_extent_npoints(space.get()) != 1) continue;
    if (H5Tget_class(type.get()) == H5T_STRING) {
      metadata[key] = text_of(attribute.get(), type.get());
    } else if (double number = 0; H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &number) >= 0) {
      metadata[key] = number;
    }
  }
  return metadata;
}

// Reads the root's attributes except afmformats' own two.
void read_parameters(hid_t file, CurveMetadata& metadata) {
  constexpr hsize_t kMostAttributes = 200;
  constexpr std::size_t kLongestName = 200;
  for (hsize_t i = 0; i < kMostAttributes; ++i) {
    // fails beyond the last one; the function for their number differs between HDF5 1.10 and 1.14
    const Handle attribute(H5Aopen_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT));
    if (!attribute.is_open()) break;
    std::array<char, kLongestName> name{};
    if (H5Aget_name(attribute.get(), name.size(), name.data()) < 0) continue;
    const std::string key(name.data());
    if (key == "software" || key == "software version") continue;
    const Handle type = must(H5Aget_type(attribute.get()), "read a type");
    const Handle space = must(H5Aget_space(attribute.get()), "read a space");
    if (H5Sget_simple_extent_npoints(space.get()) != 1) continue;
    if (H5Tget_class(type.get()) == H5T_STRING) {
      add_parameter(fmt::format("{}: {}", key, text_of(attribute.get(), type.get())), metadata);
    } else if (double number = 0; H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &number) >= 0) {
      add_parameter(fmt::format("{}: {}", key, number), metadata);
    }
  }
}

// Message on a missing curve: afmformats' files have the groups "0", "1", ...; other programs' files have others.
std::string missing_curve(hid_t file, const std::string& name, std::size_t curves) {
  if (curves > 0) return fmt::format("it has no curve \"{}\"; it has {}, counted from 0", name, curves);
  std::array<char, 64> first{};
  const ssize_t size =
      H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, 0, first.data(), first.size(), H5P_DEFAULT);
  return fmt::format("it is HDF5, but no curve file of afmformats, whose curves are groups \"0\", \"1\" and so on; {}",
                     size > 0 ? fmt::format("it begins with \"{}\"", first.data()) : std::string("it is empty"));
}

std::vector<double> column_of(hid_t group, const char* name) {
  const Handle column(has(group, name) ? H5Dopen2(group, name, H5P_DEFAULT) : H5I_INVALID_HID);
  if (!column.is_open()) throw CurveError(fmt::format("it has no readable column \"{}\"", name));
  must_hold_its_data(column.get(), name);
  const Handle space = must(H5Dget_space(column.get()), "read a space");
  hsize_t count = 0;
  if (H5Sget_simple_extent_ndims(space.get()) != 1 || H5Sget_simple_extent_dims(space.get(), &count, nullptr) != 1) {
    throw CurveError(fmt::format("its column \"{}\" is not a list of numbers", name));
  }
  if (count > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
  std::vector<double> values(count);
  if (H5Dread(column.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw CurveError(fmt::format("its column \"{}\" is damaged or of no numbers", name));
  }
  return values;
}

}  // namespace

Hdf5Curves::Hdf5Curves(std::string_view bytes) : file_(open_in_memory(bytes)) {}

std::size_t Hdf5Curves::size() const {
  std::size_t curves = 0;
  while (curves < kMostCurves && has(file_.get(), std::to_string(curves).c_str())) ++curves;
  return curves;
}

RecordedCurve Hdf5Curves::curve(std::size_t index, const CurveReading&) const {
  const std::string name = std::to_string(index);
  if (!has(file_.get(), name.c_str())) throw CurveError(missing_curve(file_.get(), name, size()));
  const Handle group(H5Gopen2(file_.get(), name.c_str(), H5P_DEFAULT));
  if (!group.is_open()) throw CurveError(fmt::format("its curve \"{}\" is damaged", name));

  RecordedCurve curve;
  read_parameters(file_.get(), curve.metadata);
  read_afmformats_metadata(metadata_of(group.get()), curve.metadata);
  const std::vector<double> force = column_of(group.get(), "force"), segment = column_of(group.get(), "segment");
  const std::vector<double> height =
      column_of(group.get(), has(group.get(), "height (measured)") ? "height (measured)" : "height (piezo)");
  if (has(group.get(), "time")) curve.time_s = column_of(group.get(), "time");
  if (height.size() != force.size() || segment.size() != force.size() ||
      (!curve.time_s.empty() && curve.time_s.size() != force.size())) {
    throw CurveError("its columns differ in length");
  }
  for (std::size_t i = 0; i < force.size(); ++i) {
    curve.points.push_back({physics::Length(height[i]), physics::Force(force[i])});
  }
  assign_branches(segment, curve);
  return curve;
}

std::string hdf5_bytes(std::span<const RecordedCurve> curves) {
  const Handle access = access_to_memory();
  const Handle file = must(H5Fcreate("curve", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), "make a file");
  put_attribute(file.get(), "software", std::string("TouchAFM"));
  put_attribute(file.get(), "software version", std::string(core::kVersion));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (i == 0) put_parameters(file.get(), curves[i].metadata);
    const std::string name = std::to_string(i);
    const Handle group =
        must(H5Gcreate2(file.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "make a group");
    put_curve(group.get(), curves[i]);
  }
  must_do(H5Fflush(file.get(), H5F_SCOPE_LOCAL), "finish a file");
  const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
  must_do(size < 0 ? -1 : 0, "measure a file");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  must_do(H5Fget_file_image(file.get(), bytes.data(), bytes.size()) < 0 ? -1 : 0, "read a file back");
  return bytes;
}

}  // namespace afm::curves
