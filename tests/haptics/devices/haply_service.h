// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace afm::test {

// A stand-in for Haply's Inverse Service: reports the hand's position, and answers each force with the next state, as
// documented for the service. One client at a time; the last one may reconnect.
class HaplyService {
 public:
  // Crowd: a Minverse and a device of an unknown family beside the Inverse3, in the list of an Inverse3. Mute: no
  // handshake. Silent: accepts forces but reports nothing. TooLong: reports a state of 100 kB, then waits for input.
  // Late: as TooLong, 50 ms after a force.
  enum class Manner { Proper, Crowd, Silent, Babbling, NoDevice, TooLong, Late, Mute };

  HaplyService() : HaplyService(Manner::Proper) {}
  explicit HaplyService(Manner first);
  HaplyService(const HaplyService&) = delete;
  HaplyService& operator=(const HaplyService&) = delete;
  ~HaplyService();

  std::uint16_t port() const;

  // Ends the connection, like a restarted service.
  void hang_up();
  // Number of states sent so far.
  unsigned states() const;

  struct Force {
    double x, y, z;  // the service's axes
    std::string id;  // device that received the force
  };
  std::vector<Force> forces() const;

  std::atomic<Manner> manner;
  std::atomic<double> up_m{0.18};  // height of the cursor
  std::atomic<bool> button{false};
  std::atomic<bool> second_only{false};  // true: the Inverse3 has left the crowd

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace afm::test
