// SPDX-License-Identifier: Apache-2.0
#include "descriptor_letter.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace afm::servo {

Letter::Letter() {
  header_.msg_iov = &part_;
  header_.msg_iovlen = 1;
}

bool Letter::send(int socket, std::string_view text, std::span<const int> descriptors) {
  if (text.size() > text_.size() || descriptors.size() > kMostLetterDescriptors) return false;
  std::copy(text.begin(), text.end(), text_.begin());
  part_ = {.iov_base = text_.data(), .iov_len = text.size()};
  header_.msg_control = descriptors.empty() ? nullptr : control_.data();
  header_.msg_controllen = descriptors.empty() ? 0 : CMSG_SPACE(descriptors.size_bytes());
  if (!descriptors.empty()) {
    cmsghdr* rights = CMSG_FIRSTHDR(&header_);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(descriptors.size_bytes());
    std::memcpy(CMSG_DATA(rights), descriptors.data(), descriptors.size_bytes());
  }
  return ::sendmsg(socket, &header_, MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(text.size());
}

std::optional<std::string_view> Letter::read(int socket, std::span<core::FileDescriptor> descriptors) {
  part_ = {.iov_base = text_.data(), .iov_len = text_.size()};
  header_.msg_control = control_.data();
  header_.msg_controllen = control_.size();
  const ssize_t length = ::recvmsg(socket, &header_, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
  if (length == 0) errno = EPIPE;
  if (length <= 0) return std::nullopt;
  const cmsghdr* rights = CMSG_FIRSTHDR(&header_);
  std::array<int, kMostLetterDescriptors> numbers{};
  std::size_t count = 0;
  if (rights != nullptr && rights->cmsg_level == SOL_SOCKET && rights->cmsg_type == SCM_RIGHTS) {
    count = (rights->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    std::memcpy(numbers.data(), CMSG_DATA(rights), count * sizeof(int));
  }
  const bool fits = count == 0 || count == descriptors.size();
  for (std::size_t i = 0; i < count; ++i) {
    core::FileDescriptor received(numbers[i]);  // owner that closes the descriptor if there is no room for it
    if (fits) descriptors[i] = std::move(received);
  }
  if (!fits) {
    errno = EBADMSG;
    return std::nullopt;
  }
  return std::string_view(text_.data(), static_cast<std::size_t>(length));
}

}  // namespace afm::servo
