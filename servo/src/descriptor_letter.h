// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>
#include <sys/uio.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/file_descriptor.h"

// Messages between processes of one user over a SOCK_SEQPACKET socket, with attached descriptors.
namespace afm::servo {

inline constexpr std::size_t kMostLetterBytes = 4096;
inline constexpr std::size_t kMostLetterDescriptors = 2;

// Buffer for one message. Neither sending nor reading allocates.
class Letter {
 public:
  Letter();
  Letter(const Letter&) = delete;
  Letter& operator=(const Letter&) = delete;
  ~Letter() = default;

  // Returns false if the text is too long, the other side is gone, or the socket is full because the other side does
  // not read. Never waits.
  bool send(int socket, std::string_view text, std::span<const int> descriptors = {});

  // Reads the next letter without waiting; the text is valid until the next call. Empty with errno EAGAIN: nothing yet;
  // EPIPE: the other side is gone; EBADMSG: some descriptors, but not as many as `descriptors` has room for.
  std::optional<std::string_view> read(int socket, std::span<core::FileDescriptor> descriptors);

 private:
  std::array<char, kMostLetterBytes> text_{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostLetterDescriptors * sizeof(int))> control_{};
  iovec part_{};
  msghdr header_{};
};

}  // namespace afm::servo
