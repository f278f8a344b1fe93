// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "render/frame.h"
#include "support/scratch_folder.h"

namespace afm::support {

// A private X server without a screen, a window manager or other clients. Throws if Xvfb is missing.
class VirtualDisplay {
 public:
  VirtualDisplay(int width, int height, int depth = 24) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe for Xvfb");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      const std::string display_fd = std::to_string(ends[1]);
      const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x" + std::to_string(depth);
      ::execlp("Xvfb", "Xvfb", "-displayfd", display_fd.c_str(), "-screen", "0", screen.c_str(), "-fbdir",
               folder_.path().c_str(), "-nolisten", "tcp", "-noreset", nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);

    // Xvfb writes its number once it takes clients; the end of the pipe without a number means that it has ended
    char c = 0;
    while (::read(ends[0], &c, 1) == 1 && c != '\n') name_ += c;
    ::close(ends[0]);
    if (name_.empty()) throw std::runtime_error("cannot start Xvfb: install the package xvfb");
    name_ = ":" + name_;
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  ~VirtualDisplay() { end(SIGTERM); }

  // Kills the server, as if it had crashed.
  void die() { end(SIGKILL); }

  const std::string& name() const { return name_; }

  // X window dump in which Xvfb keeps the whole screen.
  std::string framebuffer() const { return folder_.file("Xvfb_screen0"); }

  render::Image screenshot() const {
    const std::string dump = core::read_file(framebuffer()).value();
    const auto word = [&](std::size_t i) {
      std::uint32_t value = 0;
      for (std::size_t byte = 0; byte < 4; ++byte)
        value = value << 8 | static_cast<unsigned char>(dump.at(4 * i + byte));
      return value;
    };
    const std::uint32_t header = word(0), width = word(4), height = word(5), bytes_per_line = word(12),
                        colors = word(19);
    const bool ten_bits = word(14) == 0x3FF00000U;  // mask of red for 10 bits
    render::Image image{.width = width, .height = height, .rgba = {}};
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        const std::size_t at = header + std::size_t{12} * colors + std::size_t{y} * bytes_per_line + std::size_t{4} * x;
        std::uint32_t pixel = 0;  // pixel with blue in its lowest bits
        for (const std::size_t byte : {3U, 2U, 1U, 0U})
          pixel = pixel << 8 | static_cast<unsigned char>(dump.at(at + byte));
        for (const unsigned channel : {2U, 1U, 0U}) {
          const std::uint32_t value = ten_bits ? pixel >> (10 * channel + 2) : pixel >> (8 * channel);
          image.rgba.push_back(static_cast<std::uint8_t>(value & 0xFFU));
        }
        image.rgba.push_back(255);
      }
    }
    return image;
  }

 private:
  void end(int signal) {
    if (pid_ <= 0) return;
    ::kill(pid_, signal);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

  ScratchFolder folder_;
  pid_t pid_ = -1;
  std::string name_;
};

}  // namespace afm::support
