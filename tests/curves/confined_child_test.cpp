// SPDX-License-Identifier: Apache-2.0
#include "confined/confined_child.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "curves/curve_error.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace confined_child_test {

using testing::HasSubstr;

std::string failure_of(int result) {
  return result >= 0 ? "allowed" : errno == EPERM || errno == EACCES ? "refused" : "failed";
}

// Waits in the kernel indefinitely, which costs no processor time.
std::string hang() {
  std::timed_mutex never;
  never.lock();
  std::thread::id nobody;
  while (std::this_thread::get_id() != nobody) static_cast<void>(never.try_lock_for(std::chrono::hours(1)));
  return {};
}

TEST(ConfinedChild, GivesBackWhatTheWorkReturnsAndItsFault) {
  EXPECT_EQ(in_confined_child([] { return std::string(3'000'000, 'x'); }, "died"), std::string(3'000'000, 'x'));
  const auto fault = [] { in_confined_child([]() -> std::string { throw CurveError("it is odd"); }, "died"); };
  EXPECT_THAT(fault, testing::ThrowsMessage<CurveError>("it is odd"));
  const auto death = [] { in_confined_child([]() -> std::string { ::_exit(3); }, "died"); };
  EXPECT_THAT(death, testing::ThrowsMessage<CurveError>("died"));
}

TEST(ConfinedChild, OpensNothing) {
  const support::ScratchFolder folder;
  const std::string file = folder.file("secret");
  std::ofstream(file) << "42";
  const int open_here = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(open_here, 0);
  const auto tried = [&](const std::function<int()>& call) {
    return in_confined_child([&] { return failure_of(call()); }, "died");
  };
  EXPECT_EQ(tried([&] { return ::open(file.c_str(), O_RDONLY); }), "refused");
  EXPECT_EQ(tried([&] { return ::open((file + "2").c_str(), O_WRONLY | O_CREAT, 0600); }), "refused");
  EXPECT_EQ(tried([&] { return ::unlink(file.c_str()); }), "refused");
  EXPECT_EQ(tried([] { return ::socket(AF_UNIX, SOCK_STREAM, 0); }), "refused");
  EXPECT_EQ(tried([] { return static_cast<int>(::fork()); }), "refused");
  EXPECT_EQ(tried([] { return ::kill(::getppid(), 0); }), "refused");
  EXPECT_EQ(tried([] { return ::execl("/bin/true", "true", nullptr); }), "refused");
  char byte = 0;
  EXPECT_EQ(tried([&] { return static_cast<int>(::read(open_here, &byte, 1)); }), "failed")
      << "the parent's descriptor is open";
  ::close(open_here);
}

TEST(ConfinedChild, IsKilledWhenItTakesTooLong) {
  const auto begin = std::chrono::steady_clock::now();
  const auto slow = [] { in_confined_child(hang, "died", {std::chrono::milliseconds(200), std::chrono::seconds(3)}); };
  EXPECT_THAT(slow, testing::ThrowsMessage<CurveError>(HasSubstr("longer than 0.2 s")));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(ConfinedStream, GivesMessagesAsTheyComeAndAFaultAsTheLast) {
  ConfinedStream stream(
      [](const PutMessage& put) {
        put({false, std::string(300'000, 'x')});
        put({true, "one of them is odd"});
        put({false, ""});
        throw CurveError("the rest is odd");
      },
      "died");
  EXPECT_EQ(stream.next()->text, std::string(300'000, 'x'));
  const auto odd = stream.next();
  EXPECT_TRUE(odd->fault);
  EXPECT_EQ(odd->text, "one of them is odd");
  EXPECT_EQ(stream.next()->text, "");
  EXPECT_EQ(stream.next()->text, "the rest is odd");
  EXPECT_FALSE(stream.next());
  EXPECT_FALSE(stream.next()) << "after its end";
}

TEST(ConfinedStream, SaysThatItsChildDied) {
  ConfinedStream stream(
      [](const PutMessage& put) {
        put({false, "first"});
        ::_exit(3);
      },
      "died");
  EXPECT_EQ(stream.next()->text, "first");
  EXPECT_THAT([&] { stream.next(); }, testing::ThrowsMessage<CurveError>("died"));
}

TEST(ConfinedStream, WaitsForEachMessageSoLongAndNoLonger) {
  const auto begin = std::chrono::steady_clock::now();
  {
    ConfinedStream stream([](const PutMessage&) { hang(); }, "died",
                          {std::chrono::milliseconds(200), std::chrono::seconds(3)});
    EXPECT_THAT([&] { stream.next(); }, testing::ThrowsMessage<CurveError>(HasSubstr("longer than 0.2 s")));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

// State of a process, such as "S" or "R"; "Z" or empty once it is dead.
std::string state_of(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  stat >> number >> name >> state;
  return state;
}

TEST(ConfinedChild, DiesWithItsParent) {
  const pid_t parent = ::fork();
  ASSERT_GE(parent, 0);
  if (parent == 0) {
    try {
      in_confined_child(hang, "died");
    } catch (const CurveError&) {
    }
    ::_exit(0);
  }
  pid_t child = -1;
  const std::string children = "/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children";
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!(std::ifstream(children) >> child) && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_GT(child, 0);
  // time for the process to set its parent-death signal; it then sleeps for an hour
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  while (!(state_of(child).empty() || state_of(child) == "Z") && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_THAT(state_of(child), testing::AnyOf("", "Z"));
}

}  // namespace confined_child_test
}  // namespace afm::curves
