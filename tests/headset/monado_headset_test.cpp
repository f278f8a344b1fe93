// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>

#include "core/whole_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

// The program on the service of Monado (Debian 13: monado-service, libopenxr1-monado), whose null compositor asks a
// simulated headset's picture 20 times a second. For machines that have it: the label monado.
namespace afm {
namespace monado_headset_test {

constexpr const char* kService = "/usr/bin/monado-service";
constexpr const char* kManifest = "/usr/share/openxr/1/openxr_monado.json";
constexpr std::ptrdiff_t kFrames = 60;

class MonadosNullCompositor : public ::testing::Test {
 protected:
  MonadosNullCompositor() {
    ::chmod(folder_.path().c_str(), 0700);
    ::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    ::setenv("XR_RUNTIME_JSON", kManifest, 1);
    for (const char* name : {"XRT_COMPOSITOR_NULL", "SIMULATED_ENABLE", "XRT_NO_STDIN"}) ::setenv(name, "1", 1);
    for (const char* name : {"SIMULATED_LEFT", "SIMULATED_RIGHT"}) ::setenv(name, "simple", 1);
  }

  // The frames of which the log says that they were shown.
  std::ptrdiff_t shown() const {
    std::istringstream log(core::read_file(folder_.file("frames.csv")).value_or(""));
    std::ptrdiff_t count = 0;
    for (std::string line; std::getline(log, line);) count += line.ends_with(",shown") ? 1 : 0;
    return count;
  }

  template <class Condition>
  static bool comes(Condition&& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition() && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return condition();
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{640, 480};
};

TEST_F(MonadosNullCompositor, GetsSixtyFramesAndAGoodEnd) {
  for (const char* file : {kService, kManifest}) {
    ASSERT_TRUE(std::filesystem::exists(file)) << "install monado-service and libopenxr1-monado: there is no " << file;
  }
  support::LiveProgram service({kService}, display_.name());
  ASSERT_TRUE(comes([&] { return std::filesystem::exists(folder_.file("monado_comp_ipc")); })) << service.said();
  // without --validate: to the features of our device Monado 25 adds one that Vulkan 1.2's already hold, and the
  // validation layer reports it
  support::LiveProgram view({support::touchafm(), "view", "--headset", "--size", "320x240", "--haptics", "sim",
                             "--servo", support::servo_mode(), "--frame-log", folder_.file("frames.csv")},
                            display_.name());
  EXPECT_TRUE(view.says("headset: has the controllers")) << view.said() << service.said();
  EXPECT_TRUE(comes([&] { return shown() >= kFrames; })) << view.said() << service.said();
  view.signal(SIGTERM);
  EXPECT_EQ(view.ends(), 0) << view.said();
}

}  // namespace monado_headset_test
}  // namespace afm
