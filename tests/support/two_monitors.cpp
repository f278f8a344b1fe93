// SPDX-License-Identifier: Apache-2.0
#include "support/two_monitors.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>

#include "support/run_program.h"

namespace afm::support {
namespace {

// The server of Debian's package; the command of that name may be a wrapper that asks for a seat.
constexpr const char* kServer = "/usr/lib/xorg/Xorg";

// It starts at 640 x 480, the smallest mode that the driver knows by itself.
constexpr const char* kConfiguration = R"(
Section "Device"
  Identifier "projectors"
  Driver "dummy"
EndSection
Section "Screen"
  Identifier "desktop"
  Device "projectors"
  DefaultDepth 24
  SubSection "Display"
    Virtual 640 480
  EndSubSection
EndSection
Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "AutoAddGPU" "false"
EndSection
)";

}  // namespace

TwoMonitors::TwoMonitors() {
  folder_.write("xorg.conf", kConfiguration);
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe for Xorg");
  pid_ = ::fork();
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    const std::string configuration = folder_.file("xorg.conf"), log = folder_.file("log");
    ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
    ::execl(kServer, kServer, "-displayfd", std::to_string(ends[1]).c_str(), "-config", configuration.c_str(),
            "-logfile", log.c_str(), "-noreset", "-nolisten", "tcp", "-sharevts", "-novtswitch", nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  char c = 0;
  while (::read(ends[0], &c, 1) == 1 && c != '\n') name_ += c;
  ::close(ends[0]);
  if (name_.empty()) {
    throw std::runtime_error("cannot start Xorg: install xserver-xorg-core and xserver-xorg-video-dummy");
  }
  name_ = ":" + name_;
  xrandr("--newmode small 6.00 320 336 352 400 240 243 247 252");
  for (const char* const output : {"DUMMY0", "DUMMY1"}) xrandr("--addmode " + std::string(output) + " small");
  xrandr("--fb 640x240 --output DUMMY0 --mode small --pos 0x0 --output DUMMY1 --mode small --pos 320x0");
  xrandr("--query");  // check for connected outputs by the driver
}

TwoMonitors::~TwoMonitors() {
  ::kill(pid_, SIGTERM);
  ::waitpid(pid_, nullptr, 0);
}

void TwoMonitors::xrandr(const std::string& arguments) const {
  const auto done = run_program("xrandr --display " + name_ + " " + arguments);
  if (done.exit_code != 0) {
    throw std::runtime_error("xrandr " + arguments + ": " + done.err + " (package x11-xserver-utils)");
  }
}

render::Image TwoMonitors::screenshot() const {
  const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(name_.c_str()), XCloseDisplay);
  if (!display) throw std::runtime_error("cannot look at the display " + name_);
  const Window root = DefaultRootWindow(display.get());
  XWindowAttributes desktop;
  XGetWindowAttributes(display.get(), root, &desktop);
  XImage* const seen = XGetImage(display.get(), root, 0, 0, static_cast<unsigned>(desktop.width),
                                 static_cast<unsigned>(desktop.height), AllPlanes, ZPixmap);
  if (seen == nullptr) throw std::runtime_error("cannot read the desktop of " + name_);
  render::Image image{.width = static_cast<std::uint32_t>(desktop.width),
                      .height = static_cast<std::uint32_t>(desktop.height),
                      .rgba = {}};
  for (int y = 0; y < desktop.height; ++y) {
    for (int x = 0; x < desktop.width; ++x) {
      const unsigned long pixel = XGetPixel(seen, x, y);  // 24 bits, red first
      for (const int shift : {16, 8, 0}) image.rgba.push_back(static_cast<std::uint8_t>(pixel >> shift & 0xFF));
      image.rgba.push_back(255);
    }
  }
  XDestroyImage(seen);
  return image;
}

}  // namespace afm::support
