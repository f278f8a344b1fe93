// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <termios.h>

#include <optional>
#include <utility>

#include "core/file_descriptor.h"

namespace afm::core {

struct PseudoTerminal {
  FileDescriptor reader;
  FileDescriptor terminal;
};

namespace detail {

// A container without /dev/pts lacks a working /dev/ptmx; root mounts a private one.
inline FileDescriptor terminal_device() {
  FileDescriptor device(::posix_openpt(O_RDWR | O_NOCTTY));
  if (device.get() >= 0) return device;
  const FileDescriptor context(::fsopen("devpts", FSOPEN_CLOEXEC));
  if (::fsconfig(context.get(), FSCONFIG_CMD_CREATE, nullptr, nullptr, 0) != 0) return device;
  const FileDescriptor mount(::fsmount(context.get(), FSMOUNT_CLOEXEC, 0));
  return FileDescriptor(::openat(mount.get(), "ptmx", O_RDWR | O_NOCTTY));
}

}  // namespace detail

// Empty if the machine has no pseudo-terminals and the user is not root.
inline std::optional<PseudoTerminal> open_pseudo_terminal() {
  FileDescriptor reader = detail::terminal_device();
  const int unlock = 0;
  if (reader.get() < 0 || ::ioctl(reader.get(), TIOCSPTLCK, &unlock) != 0) return std::nullopt;
  FileDescriptor terminal(::ioctl(reader.get(), TIOCGPTPEER, O_RDWR | O_NOCTTY));
  if (terminal.get() < 0) return std::nullopt;
  return PseudoTerminal{std::move(reader), std::move(terminal)};
}

}  // namespace afm::core
