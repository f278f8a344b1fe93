// SPDX-License-Identifier: Apache-2.0
// touchafm-hdf5: reads and writes afmformats' HDF5 curves for touchafm in a confined process, because HDF5 1.10 crashes
// on damaged files, and Debian's library loads curl, Kerberos and LDAP, which no other command needs.
//
// touchafm-hdf5 read INDEX   reads an .h5 from stdin, writes its curve as afmformats .tab to stdout
// touchafm-hdf5 write        the reverse
//
// Exit codes are those of formats/confined_child.h; a fault of the file is reported on stdout.
#include <unistd.h>

#include <charconv>
#include <exception>
#include <string>
#include <string_view>

#include "core/log.h"
#include "core/write_all.h"
#include "curves/curve_error.h"
#include "formats/confined_child.h"
#include "formats/confinement.h"
#include "formats/tab_file.h"
#include "hdf5_file.h"

namespace {

using namespace afm;

std::string read_stdin() {
  std::string bytes;
  char buffer[65536];
  for (ssize_t count = 0; (count = ::read(STDIN_FILENO, buffer, sizeof(buffer))) > 0;) {
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
  return bytes;
}

curves::ChildExit convert(std::string_view how, std::string_view index_text) {
  std::size_t index = 0;
  std::from_chars(index_text.data(), index_text.data() + index_text.size(), index);
  try {
    const std::string bytes = read_stdin();
    curves::confine_this_process();
    const std::string converted =
        how == "read" ? tab_bytes(curves::read_hdf5(bytes, index)) : curves::hdf5_bytes(curves::read_tab(bytes));
    return core::write_all(STDOUT_FILENO, converted) == 0 ? curves::ChildExit::Done : curves::ChildExit::Failed;
  } catch (const curves::CurveError& fault) {
    return core::write_all(STDOUT_FILENO, fault.what()) == 0 ? curves::ChildExit::Fault : curves::ChildExit::Failed;
  } catch (const std::exception& fault) {
    core::log_line(fault.what());
    return curves::ChildExit::Failed;
  }
}

}  // namespace

int main(int count, char** arguments) {
  const std::string_view how = count > 1 ? arguments[1] : "";
  if (how != "read" && how != "write") {
    core::log_line("touchafm-hdf5 is started by touchafm; run 'touchafm analyse FILE.h5' instead");
    return 2;
  }
  // skips HDF5's own clean-up, which may crash
  ::_exit(static_cast<int>(convert(how, count > 2 ? arguments[2] : "0")));
}
