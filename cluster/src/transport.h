// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <thread>

#include "cluster/network.h"
#include "core/enumerators.h"
#include "core/file_descriptor.h"
#include "core/result.h"

namespace afm::cluster {

// Name of the thread that owns a Transport, as shown by the system.
inline constexpr const char* kThreadName = "wall network";

// Wakes a thread that waits in poll(), through an eventfd.
class Doorbell {
 public:
  static core::Result<Doorbell> create();

  void ring() const noexcept;  // any thread; never waits
  // Waits until it has been rung since the last call, or `timeout_ms` have passed.
  void wait(int timeout_ms) const noexcept;

 private:
  core::FileDescriptor event_;
};

enum class ClusterRole { Master, Node };

// Topics of a wall in DDS; no other code calls Cyclone. A write may block for seconds when a cable is unplugged,
// whatever its limits, so only one dedicated thread may call this, which neither draws nor sends the servo's heartbeat.
// DDS's threads ring `doorbell` when data has arrived; it must outlive this object.
class Transport {
 public:
  enum class Topic : std::uint32_t { Model, Frame, Journal, History, Ready, Swap };
  static constexpr std::size_t kTopics = core::kEnumerators<Topic>.size();

  // Failed: DDS rejects the configuration, its ports are taken, or there is no such interface.
  static core::Result<std::unique_ptr<Transport>> open(const ClusterNetwork& network, ClusterRole role,
                                                       const Doorbell& doorbell);
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  ~Transport();

  // Makes the calling thread the only one that may write and take; calls from another thread abort the program.
  void belong_to_this_thread() { owner_ = std::this_thread::get_id(); }

  // Writes to a topic of this role: Ready for a node, all others for the master. False: DDS took too long.
  bool write(Topic topic, std::uint32_t key, std::span<const std::byte> datagram);

  // Number of bytes sent again because a reader had lost them.
  std::uint64_t resent_bytes() const;

  // Passes on everything that has arrived since the last call, in order.
  void take(Topic topic, const std::function<void(std::span<const std::byte>)>& each);

 private:
  Transport() = default;
  core::Result<void> create(const ClusterNetwork& network, ClusterRole role, const Doorbell& doorbell);

  std::thread::id owner_ = std::this_thread::get_id();
  std::int32_t domain_ = 0, participant_ = 0;  // DDS handles; 0: none
  std::array<std::int32_t, kTopics> writers_{};
  std::array<std::int32_t, kTopics> readers_{};
};

}  // namespace afm::cluster
