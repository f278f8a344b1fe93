// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

// Code shared by readers and writers of HDF5: owned identifiers, and checks that all data lie in the file itself.
namespace afm::curves {

// Owns an HDF5 identifier of any kind; all kinds are reference-counted in the same way.
class Handle {
 public:
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }

  hid_t get() const { return id_; }
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
};

inline Handle must(hid_t id, const char* what) {
  if (id < 0) throw std::runtime_error(fmt::format("HDF5 cannot {}", what));
  return Handle(id);
}

inline void must_do(herr_t status, const char* what) {
  if (status < 0) throw std::runtime_error(fmt::format("HDF5 cannot {}", what));
}

// Access to a file that exists only in memory.
Handle access_to_memory();

// Opens a file of these bytes, for reading; they are copied. Throws CurveError.
Handle open_in_memory(std::string_view bytes);

// Text of fixed or variable length. Throws CurveError beyond 64 KiB.
std::string text_of(hid_t attribute, hid_t type);

// Returns whether the link exists and stays within the file. Throws CurveError for any other link: it is not followed.
bool has(hid_t group, const char* name);

// Throws CurveError for a data set whose data are in another file.
void must_hold_its_data(hid_t column, const char* name);

}  // namespace afm::curves
