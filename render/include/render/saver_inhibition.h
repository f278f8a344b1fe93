// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace afm::render {

// Wakes the screen, and keeps the screen saver and the monitors' power saving from blanking it while this exists, since
// pen, wand and headset are no input to them. They resume when it ends, even by a kill. Any thread; the constructor
// takes at most a second where a session bus is stuck.
class SaverInhibition {
 public:
  SaverInhibition();
  SaverInhibition(const SaverInhibition&) = delete;
  SaverInhibition& operator=(const SaverInhibition&) = delete;
  ~SaverInhibition();

  struct Way {
    bool works = false;
    std::string said;  // "suspended", or the reason for a failure
  };
  const Way& x_server() const { return x_server_; }  // MIT-SCREEN-SAVER, which also suspends DPMS
  const Way& session() const { return session_; }    // org.freedesktop.ScreenSaver on the session bus
  bool works() const { return x_server_.works || session_.works; }

 private:
  struct Connections;
  std::unique_ptr<Connections> connections_;
  Way x_server_, session_;
};

}  // namespace afm::render
