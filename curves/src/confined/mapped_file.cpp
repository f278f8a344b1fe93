// SPDX-License-Identifier: Apache-2.0
#include "confined/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>

#include "core/file_descriptor.h"
#include "core/system_error.h"
#include "core/whole_file.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 30U;

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  if (const std::string kind = core::kind_of_no_file(path); !kind.empty()) {
    throw CurveError(fmt::format("it is {}", kind));
  }
  const core::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status{};
  if (!file.is_open() || ::fstat(file.get(), &status) != 0) throw CurveError(core::system_error(errno));
  const auto size = static_cast<std::size_t>(status.st_size);
  if (!S_ISREG(status.st_mode) || size == 0) throw CurveError("it is empty");
  if (size > kMostBytes) throw CurveError(fmt::format("it is larger than {} GiB", kMostBytes >> 30U));
  const void* const begin = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (begin == MAP_FAILED) throw CurveError(core::system_error(errno));
  begin_ = static_cast<const char*>(begin);
  size_ = size;
}

MappedFile::~MappedFile() {
  if (begin_ != nullptr) ::munmap(const_cast<char*>(begin_), size_);
}

void MappedFile::forget() const { ::madvise(const_cast<char*>(begin_), size_, MADV_DONTNEED); }

}  // namespace afm::curves
