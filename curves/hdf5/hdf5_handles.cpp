// SPDX-License-Identifier: Apache-2.0
#include "hdf5_handles.h"

#include <cstddef>

#include "curves/curve_error.h"

namespace afm::curves {

Handle access_to_memory() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // turns off HDF5's error stack on stderr
  H5PLset_loading_state(0);                     // turns off filters from plug-ins
  Handle access = must(H5Pcreate(H5P_FILE_ACCESS), "prepare a file");
  must_do(H5Pset_fapl_core(access.get(), std::size_t{1} << 20U, 0), "keep a file in memory");
  return access;
}

Handle open_in_memory(std::string_view bytes) {
  const Handle access = access_to_memory();
  // HDF5 copies the image
  must_do(H5Pset_file_image(access.get(), const_cast<char*>(bytes.data()), bytes.size()), "take the file");
  Handle file(H5Fopen("file", H5F_ACC_RDONLY, access.get()));
  if (!file.is_open()) throw CurveError(std::string("it is damaged or cut short; ") + kCopyAgain);
  return file;
}

std::string text_of(hid_t attribute, hid_t type) {
  constexpr std::size_t kLongestText = 65536;
  const Handle memory = must(H5Tcopy(H5T_C_S1), "make a type");
  H5Tset_cset(memory.get(), H5Tget_cset(type));
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    H5Tset_size(memory.get(), H5T_VARIABLE);
    if (H5Aread(attribute, memory.get(), static_cast<void*>(&text)) < 0 || text == nullptr) return {};
    std::string copy(text);
    H5free_memory(text);
    return copy;
  }
  const std::size_t size = H5Tget_size(type);
  if (size > kLongestText) throw CurveError("one of its attributes is too long");
  std::string text(size + 1, '\0');
  H5Tset_size(memory.get(), text.size());
  if (H5Aread(attribute, memory.get(), text.data()) < 0) return {};
  return text.substr(0, text.find('\0'));
}

bool has(hid_t group, const char* name) {
  if (H5Lexists(group, name, H5P_DEFAULT) <= 0) return false;
  H5L_info_t link{};
  if (H5Lget_info(group, name, &link, H5P_DEFAULT) < 0)
    throw CurveError(fmt::format("its link \"{}\" is damaged", name));
  if (link.type == H5L_TYPE_HARD) return true;
  throw CurveError(fmt::format("its \"{}\" is a link, which is not followed; copy the data into the file", name));
}

void must_hold_its_data(hid_t column, const char* name) {
  const Handle made = must(H5Dget_create_plist(column), "read how a data set was made");
  if (H5Pget_layout(made.get()) != H5D_VIRTUAL && H5Pget_external_count(made.get()) == 0) return;
  throw CurveError(fmt::format("its column \"{}\" lies in another file, which is not read", name));
}

}  // namespace afm::curves
