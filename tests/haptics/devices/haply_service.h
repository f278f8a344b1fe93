// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace afm::test {

// A stand-in for Haply's Inverse Service: reports the hand's position, and answers each force with the next state, as
// documented for the service. One client at a time; the last one may reconnect.
class HaplyService {
 public:
  // Mute: no handshake. Silent: accepts forces but reports nothing. TooLong: reports a state of 100 kB, then waits for
  // input. Late: as TooLong, 50 ms after a force.
  enum class Manner { Proper, Silent, Babbling, NoDevice, TooLong, Late, Mute };

  HaplyService() : HaplyService(Manner::Proper) {}
  explicit HaplyService(Manner first);
  HaplyService(const HaplyService&) = delete;
  HaplyService& operator=(const HaplyService&) = delete;
  ~HaplyService();

  std::uint16_t port() const;

  // Ends the connection, as a service does that is restarted.
  void hang_up();

  struct Force {
    double x, y, z;  // the service's axes
  };
  std::vector<Force> forces() const;

  std::atomic<Manner> manner;
  std::atomic<double> up_m{0.18};  // height of the cursor
  std::atomic<bool> button{false};

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace afm::test
