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

// Messages between processes of one user, over a SOCK_SEQPACKET socket, that can bring descriptors with them.
namespace afm::servo {

inline constexpr std::size_t kMostLetterBytes = 4096;
inline constexpr std::size_t kMostLetterDescriptors = 2;

// Room for one message. Neither sending nor reading allocates.
class Letter {
 public:
  Letter();
  Letter(const Letter&) = delete;
  Letter& operator=(const Letter&) = delete;
  ~Letter() = default;

  // False: too long, the other side is gone, or does not read and the socket is full. Waits for nobody.
  bool send(int socket, std::string_view text, std::span<const int> descriptors = {});

  // The next letter, without waiting; the text is valid until the next call. Empty, with errno EAGAIN: nothing yet;
  // EPIPE: the other side is gone; EBADMSG: more or fewer descriptors than `descriptors` has room for, and not none.
  std::optional<std::string_view> read(int socket, std::span<core::FileDescriptor> descriptors);

 private:
  std::array<char, kMostLetterBytes> text_{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostLetterDescriptors * sizeof(int))> control_{};
  iovec part_{};
  msghdr header_{};
};

}  // namespace afm::servo
