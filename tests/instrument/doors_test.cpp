// SPDX-License-Identifier: Apache-2.0
// Invariant: only processes of the same user enter the socket of `touchafm serve`, which has mode 0600 and is removed
// at the end
#include "instrument/listener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "instrument/json_door.h"
#include "instrument/nanonis_door.h"
#include "instrument/simulated_instrument.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::instrument {
namespace doors_test {

using testing::HasSubstr;
using testing::StartsWith;

core::FileDescriptor connected_to(const std::string& path) {
  core::FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::copy(path.begin(), path.end(), address.sun_path);
  EXPECT_EQ(::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  return socket;
}

// 0, or errno of a server that has left.
int send_all(const core::FileDescriptor& socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

// Up to the end that the server makes.
std::string rest_of(const core::FileDescriptor& socket) {
  std::string text;
  std::array<char, 4096> bytes;
  for (ssize_t count = 0; (count = ::read(socket.get(), bytes.data(), bytes.size())) > 0;) {
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return text;
}

class DoorsTest : public testing::Test {
 protected:
  // Answers on a thread until "quit" or, with `once`, until the first client has left.
  void start(bool once) {
    auto listener = Listener::on_socket(path_);
    ASSERT_TRUE(listener) << listener.error().message;
    thread_ = std::thread([this, once, listener = std::move(*listener)] {
      JsonDoor door(instrument_, "");
      EXPECT_TRUE(serve(std::array{OpenDoor{&listener, &door}}, once));
    });
  }
  void TearDown() override {
    if (thread_.joinable()) thread_.join();
  }

  support::ScratchFolder folder_;
  std::string path_ = folder_.file("afm.sock");
  SimulatedInstrument instrument_ = std::move(SimulatedInstrument::create(support::source("assets"), 1)).value();
  std::thread thread_;
};

TEST_F(DoorsTest, AnswersEveryRequestOfAClientThatHasClosedItsHalf) {
  start(true);
  const core::FileDescriptor client = connected_to(path_);
  EXPECT_EQ(send_all(client, "{\"id\":1,\"do\":\"truth\"}\n{\"id\":2,\"do\":\"get\"}\n{\"id\":3"), 0);
  ::shutdown(client.get(), SHUT_WR);
  const std::string answers = rest_of(client);
  EXPECT_EQ(std::count(answers.begin(), answers.end(), '\n'), 3);
  EXPECT_THAT(answers, StartsWith("{\"id\":1,\"ok\":true"));
  EXPECT_THAT(answers, HasSubstr("{\"id\":null,\"ok\":false")) << "half a request";
}

// Such as printf '{"do": "get"}' | nc -NU afm.sock.
TEST_F(DoorsTest, AnswersALastLineWithoutItsEnd) {
  start(true);
  const core::FileDescriptor client = connected_to(path_);
  EXPECT_EQ(send_all(client, "{\"id\":1,\"do\":\"truth\"}\n{\"id\":2,\"do\":\"get\"}"), 0);
  ::shutdown(client.get(), SHUT_WR);
  EXPECT_THAT(rest_of(client), HasSubstr("{\"id\":2,\"ok\":true"));
}

TEST_F(DoorsTest, LetsManyClientsWait) {
  start(false);
  std::vector<core::FileDescriptor> waiting;
  waiting.reserve(100);
  for (int i = 0; i < 100; ++i) waiting.push_back(connected_to(path_));
  EXPECT_EQ(send_all(waiting.back(), "{\"do\":\"quit\"}\n"), 0);
  const core::FileDescriptor last = std::move(waiting.back());
  waiting.clear();
  EXPECT_THAT(rest_of(last), HasSubstr("\"ok\":true"));
}

TEST_F(DoorsTest, ServesOneClientAfterTheOther) {
  start(false);
  for (int i = 0; i < 3; ++i) {
    const core::FileDescriptor client = connected_to(path_);
    EXPECT_EQ(send_all(client, "{\"do\":\"wait\",\"time_s\":1}\n"), 0);
    ::shutdown(client.get(), SHUT_WR);
    EXPECT_THAT(rest_of(client), HasSubstr("\"time_s\":" + std::to_string(i + 1)));
  }
  const core::FileDescriptor client = connected_to(path_);
  EXPECT_EQ(send_all(client, "{\"do\":\"quit\"}\n"), 0);
  EXPECT_THAT(rest_of(client), HasSubstr("\"ok\":true"));
}

TEST_F(DoorsTest, GivesUpARequestWithoutEnd) {
  start(true);
  const core::FileDescriptor client = connected_to(path_);
  const std::string much((std::size_t{1} << 20) + 200'000, 'x');
  send_all(client, much);
  EXPECT_THAT(rest_of(client), HasSubstr("more than 1 MiB"));
}

// Such as a browser at the port.
TEST_F(DoorsTest, GivesUpAClientOfAnotherProtocol) {
  auto listener = Listener::on_socket(path_);
  ASSERT_TRUE(listener) << listener.error().message;
  thread_ = std::thread([this, listener = std::move(*listener)] {
    NanonisDoor door(instrument_);
    EXPECT_TRUE(serve(std::array{OpenDoor{&listener, &door}}, true));
  });
  const core::FileDescriptor client = connected_to(path_);
  EXPECT_EQ(send_all(client, "GET / HTTP/1.1\r\nHost: 127.0.0.1:6501\r\nAccept: */*\r\n\r\n"), 0);
  EXPECT_EQ(rest_of(client), "");
}

TEST_F(DoorsTest, SurvivesAClientThatLeavesDuringAScan) {
  start(false);
  {
    const core::FileDescriptor client = connected_to(path_);
    EXPECT_EQ(
        send_all(client, "{\"do\":\"approach\"}\n{\"do\":\"set\",\"values\":{\"lines\":1024}}\n{\"do\":\"scan\"}\n"),
        0);
  }
  const core::FileDescriptor client = connected_to(path_);
  EXPECT_EQ(send_all(client, "{\"do\":\"quit\"}\n"), 0);
  EXPECT_THAT(rest_of(client), HasSubstr("\"ok\":true"));
}

TEST_F(DoorsTest, IsPrivateAndLeavesNothingBehind) {
  {
    const auto server = Listener::on_socket(path_);
    ASSERT_TRUE(server);
    struct stat facts{};
    ASSERT_EQ(::lstat(path_.c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777U, 0600U);
    const auto second = Listener::on_socket(path_);
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().message, HasSubstr("already"));
    EXPECT_TRUE(std::filesystem::exists(path_)) << "the second one must not remove it";
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(DoorsTest, ReplacesASocketThatNobodyListensOnAndNothingElse) {
  {
    const core::FileDescriptor left(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::copy(path_.begin(), path_.end(), address.sun_path);
    ASSERT_EQ(::bind(left.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  EXPECT_TRUE(Listener::on_socket(path_));
  const std::string file = folder_.write("file.sock", "mine");
  EXPECT_FALSE(Listener::on_socket(file));
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_FALSE(Listener::on_socket(std::string(200, 'a')));
  EXPECT_FALSE(Listener::on_socket(folder_.file("no/such/folder.sock")));
}

}  // namespace doors_test
}  // namespace afm::instrument
