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

// Of the thread that owns a Transport, as the system lists it.
inline constexpr const char* kThreadName = "wall network";

// Wakes a thread that waits in poll(): an eventfd.
class Doorbell {
 public:
  static core::Result<Doorbell> create();

  void ring() const noexcept;  // any thread; never waits
  // Waits until it has been rung since the last time, or `timeout_ms` have passed.
  void wait(int timeout_ms) const noexcept;

 private:
  core::FileDescriptor event_;
};

enum class ClusterRole { Master, Node, Observer };

// A wall's topics in DDS; nothing else calls Cyclone. A write may block for seconds when a cable is out, whatever its
// limits say, so only one dedicated thread may call this, one that neither draws nor sends the servo's heartbeat. DDS's
// threads ring `doorbell` when data has arrived; it must outlive this.
class Transport {
 public:
  enum class Topic : std::uint32_t { Model, Frame, Journal, History, Ready, Swap };
  static constexpr std::size_t kTopics = core::kEnumerators<Topic>.size();

  // Failed: DDS refuses the configuration, its ports are taken, or there is no such interface.
  static core::Result<std::unique_ptr<Transport>> open(const ClusterNetwork& network, ClusterRole role,
                                                       const Doorbell& doorbell);
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  ~Transport();

  // From now on the calling thread is the only one that may write and take; another one aborts the program.
  void belong_to_this_thread() { owner_ = std::this_thread::get_id(); }

  // Of a topic that the role writes: the master all but Ready, a node that alone. False: DDS took too long.
  bool write(Topic topic, std::uint32_t key, std::span<const std::byte> datagram);

  // What was sent more than once, since a reader had lost it.
  std::uint64_t resent_bytes() const;

  // Everything that has come since, in its order.
  void take(Topic topic, const std::function<void(std::span<const std::byte>)>& each);

 private:
  Transport() = default;
  core::Result<void> create(const ClusterNetwork& network, ClusterRole role, const Doorbell& doorbell);

  std::thread::id owner_ = std::this_thread::get_id();
  std::int32_t domain_ = 0, participant_ = 0;  // what DDS counts its entities by; 0: none
  std::array<std::int32_t, kTopics> writers_{};
  std::array<std::int32_t, kTopics> readers_{};
};

}  // namespace afm::cluster
