// SPDX-License-Identifier: Apache-2.0
// Invariant: a blocked log never delays a release
#include "core/log.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/file_descriptor.h"
#include "pseudo_terminal.h"

// The log never waits for its reader: stderr is a full pipe or a stopped terminal.
namespace afm::core {
namespace log_test {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class Stderr {
 public:
  explicit Stderr(int descriptor) : before_(::dup(STDERR_FILENO)) { ::dup2(descriptor, STDERR_FILENO); }
  Stderr(const Stderr&) = delete;
  Stderr& operator=(const Stderr&) = delete;
  ~Stderr() { ::dup2(before_.get(), STDERR_FILENO); }

 private:
  FileDescriptor before_;
};

// Reads until `end` arrives, or nothing arrives for five seconds.
std::string read_until(int descriptor, std::string_view end) {
  std::string text;
  std::array<char, 4096> part{};
  for (pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
       text.find(end) == std::string::npos && ::poll(&watched, 1, 5000) == 1;) {
    const ssize_t length = ::read(descriptor, part.data(), part.size());
    if (length <= 0) break;
    text.append(part.data(), static_cast<std::size_t>(length));
  }
  return text;
}

TEST(Log, WritesAtOnceWhereItsReaderReads) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
  const FileDescriptor reader(ends[0]), writer(ends[1]);
  const Stderr captured(writer.get());
  log_line("one line");
  std::array<char, 64> text{};
  const ssize_t length = ::read(reader.get(), text.data(), text.size());
  EXPECT_EQ(std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(0, length))), "touchafm: one line\n");
}

// This test ends only if no line waits.
TEST(Log, NeitherWaitsForAFullPipeNorLosesWhatItCanKeep) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  const FileDescriptor reader(ends[0]);
  FileDescriptor writer(ends[1]);
  const int capacity = ::fcntl(writer.get(), F_SETPIPE_SZ, 4096);
  const Stderr captured(writer.get());
  const std::string long_text(200, 'x');
  const int kept = capacity / 210 + 256, all = kept + 100;
  for (int i = 0; i < all; ++i) log_line(fmt::format("{:04} {}", i, long_text));
  const std::string text = read_until(reader.get(), "nobody read it");
  EXPECT_THAT(text, AllOf(HasSubstr("touchafm: 0000 x"), HasSubstr("touchafm: 0256 x"), Not(HasSubstr("0350 "))));
  EXPECT_THAT(text, HasSubstr(" lines of the log were dropped: nobody read it"));
  log_line("as before");
  EXPECT_THAT(read_until(reader.get(), "as before\n"), EndsWith("touchafm: as before\n"));
}

TEST(Log, DoesNotWaitForAStoppedTerminal) {
  const auto opened = open_pseudo_terminal();
  ASSERT_TRUE(opened) << "no pseudo-terminal: mount /dev/pts, or run this with CAP_SYS_ADMIN";
  const Stderr captured(opened->terminal.get());
  ASSERT_EQ(::tcflow(opened->terminal.get(), TCOOFF), 0);  // Ctrl-S
  for (int i = 0; i < 10; ++i) log_line(fmt::format("line {}", i));
  ASSERT_EQ(::tcflow(opened->terminal.get(), TCOON), 0);
  EXPECT_THAT(read_until(opened->reader.get(), "line 9"), AllOf(HasSubstr("line 0"), HasSubstr("line 9")));
}

// Other processes share the open file.
TEST(Log, LeavesTheModeOfStderrAsItIs) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  const FileDescriptor reader(ends[0]), writer(ends[1]);
  const Stderr captured(writer.get());
  log_line("one line");
  EXPECT_EQ(::fcntl(STDERR_FILENO, F_GETFL) & O_NONBLOCK, 0);
}

}  // namespace log_test
}  // namespace afm::core
