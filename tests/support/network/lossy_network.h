// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace afm::support {

// Machines in private network namespaces, on a switch that loses and delays frames from a seed: a process
// that holds the other end of each machine's TAP interface. Needs the right to make namespaces; throws, saying so,
// where there is none.
class LossyNetwork {
 public:
  struct Line {
    double lost = 0;  // fraction of the frames lost, in each direction
    double delay_ms = 0, jitter_ms = 0;
  };

  enum class Multicast { Carried, Forbidden };

  explicit LossyNetwork(const std::vector<Line>& machines, Multicast multicast = Multicast::Carried);
  LossyNetwork(const LossyNetwork&) = delete;
  LossyNetwork& operator=(const LossyNetwork&) = delete;
  ~LossyNetwork();

  static std::string address(std::size_t machine) { return "10.77.0." + std::to_string(machine + 1); }

  // Command line that runs on a machine.
  std::vector<std::string> on(std::size_t machine, const std::vector<std::string>& command) const;

  void pull_cable(std::size_t machine) { shared_->out[machine] = true; }
  void plug_cable(std::size_t machine) { shared_->out[machine] = false; }

  std::uint64_t lost() const { return shared_->lost; }  // number of frames lost

 private:
  static constexpr std::size_t kMost = 8;
  struct Shared {  // memory shared with the switch
    std::array<std::atomic<bool>, kMost> out{};
    std::atomic<std::uint64_t> lost{0};
  };

  std::string name(std::size_t machine) const;
  void add_machine(std::size_t machine);
  void remove();

  std::vector<int> taps_;
  Shared* shared_ = nullptr;
  pid_t switch_ = -1;
};

}  // namespace afm::support
