// SPDX-License-Identifier: Apache-2.0
#include "transport.h"

#include <dds/dds.h>
#include <dds/ddsc/dds_statistics.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <cerrno>
#include <chrono>
#include <utility>

#include "bound_receivers.h"
#include "cluster/messages.h"
#include "core/check.h"
#include "core/log.h"
#include "core/system_error.h"
#include "network_lines.h"
#include "wire.h"

namespace afm::cluster {

namespace {

static_assert(kMostDatagramBytes == 1300, "the bound in wire.idl");

constexpr dds_duration_t kLongestWrite = DDS_MSECS(20);

enum class Keeps { Late, Now };  // Late: a late reader gets earlier data

struct TopicRow {
  Transport::Topic topic;
  const char* name;
  ClusterRole writer;
  Keeps keeps;
  int depth;  // number of newest values kept per key; no writer waits for a slow reader
};

constexpr std::array<TopicRow, Transport::kTopics> kTopicRows{
    {{Transport::Topic::Model, "wall/model", ClusterRole::Master, Keeps::Late, 1},
     {Transport::Topic::Frame, "wall/frame", ClusterRole::Master, Keeps::Now, 1},
     {Transport::Topic::Journal, "wall/journal", ClusterRole::Master, Keeps::Now, 256},
     {Transport::Topic::History, "wall/history", ClusterRole::Master, Keeps::Now, 256},
     {Transport::Topic::Ready, "wall/ready", ClusterRole::Node, Keeps::Now, 4},
     {Transport::Topic::Swap, "wall/swap", ClusterRole::Master, Keeps::Now, 1}}};
static_assert(core::has_row_for_each(kTopicRows, &TopicRow::topic));

struct QosDelete {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
struct ListenerDelete {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};

struct StatisticsDelete {
  void operator()(dds_statistics* statistics) const { dds_delete_statistics(statistics); }
};

std::unique_ptr<dds_qos_t, QosDelete> qos_of(const TopicRow& row) {
  std::unique_ptr<dds_qos_t, QosDelete> qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, kLongestWrite);
  dds_qset_durability(qos.get(), row.keeps == Keeps::Late ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, row.depth);
  dds_qset_destination_order(qos.get(), DDS_DESTINATIONORDER_BY_RECEPTION_TIMESTAMP);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

// Log function for DDS, which would write a line to stderr for each malformed packet, whatever its verbosity.
void log_of_dds(void* lines, const dds_log_data_t* said) {
  const std::int64_t now_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  if (const auto line = static_cast<NetworkLines*>(lines)->line(said->message, now_ns)) core::log_line(*line);
}

// Installs that function, once for the process. Never destroyed: DDS's threads may outlive main's statics.
void take_log_of_dds() {
  static auto* const lines = new NetworkLines;
  dds_set_log_sink(log_of_dds, lines);
}

auto dds_refused(const char* what, dds_entity_t code, const ClusterNetwork& network) {
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("cannot open the wall's network on {}, domain {}: {}: {}", network.interface_address,
                                   network.domain, what, dds_strretcode(code)));
}

}  // namespace

core::Result<Doorbell> Doorbell::create() {
  Doorbell bell;
  bell.event_ = core::FileDescriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (bell.event_.is_open()) return bell;
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("cannot create an event: {}", core::system_error(errno)));
}

void Doorbell::ring() const noexcept {
  const std::uint64_t one = 1;
  // a full counter has already been rung
  [[maybe_unused]] const auto written = ::write(event_.get(), &one, sizeof(one));
}

void Doorbell::wait(int timeout_ms) const noexcept {
  pollfd waited{.fd = event_.get(), .events = POLLIN, .revents = 0};
  if (::poll(&waited, 1, timeout_ms) <= 0) return;
  std::uint64_t rung = 0;
  [[maybe_unused]] const auto read = ::read(event_.get(), &rung, sizeof(rung));
}

core::Result<std::unique_ptr<Transport>> Transport::open(const ClusterNetwork& network, ClusterRole role,
                                                         const Doorbell& doorbell) {
  std::unique_ptr<Transport> transport(new Transport());
  if (auto created = transport->create(network, role, doorbell); !created) return tl::unexpected(created.error());
  return transport;
}

core::Result<void> Transport::create(const ClusterNetwork& network, ClusterRole role, const Doorbell& doorbell) {
  take_log_of_dds();
  // the configuration is complete: environment variables do not change it
  domain_ = dds_create_domain(network.domain, dds_configuration(network).c_str());
  // a process may play both roles, with the configuration of the first
  if (domain_ == DDS_RETCODE_PRECONDITION_NOT_MET) domain_ = 0;
  if (domain_ < 0) return dds_refused("its configuration", std::exchange(domain_, 0), network);
  if (domain_ > 0) {
    const auto bound = bind_receivers(network);
    if (!bound) return tl::unexpected(bound.error());
  }
  participant_ = dds_create_participant(network.domain, nullptr, nullptr);
  if (participant_ < 0) return dds_refused("its ports", std::exchange(participant_, 0), network);
  const std::unique_ptr<dds_listener_t, ListenerDelete> listener(dds_create_listener(const_cast<Doorbell*>(&doorbell)));
  dds_lset_data_available(listener.get(), [](dds_entity_t, void* bell) { static_cast<const Doorbell*>(bell)->ring(); });
  for (const TopicRow& row : kTopicRows) {
    const auto index = static_cast<std::size_t>(row.topic);
    const auto qos = qos_of(row);
    const dds_entity_t topic = dds_create_topic(participant_, &afm_wire_Datagram_desc, row.name, qos.get(), nullptr);
    if (topic < 0) return dds_refused(row.name, topic, network);
    // a master detects another one by its frames
    const bool reads = row.writer != role || row.topic == Topic::Frame;
    if (reads) readers_[index] = dds_create_reader(participant_, topic, qos.get(), listener.get());
    if (row.writer == role) writers_[index] = dds_create_writer(participant_, topic, qos.get(), nullptr);
    if (readers_[index] < 0) return dds_refused(row.name, readers_[index], network);
    if (writers_[index] < 0) return dds_refused(row.name, writers_[index], network);
  }
  return {};
}

Transport::~Transport() {
  if (participant_ > 0) dds_delete(participant_);
  if (domain_ > 0) dds_delete(domain_);
}

bool Transport::write(Topic topic, std::uint32_t key, std::span<const std::byte> datagram) {
  AFM_CHECK(owner_ == std::this_thread::get_id());
  afm_wire_Datagram sample{};
  sample.key = key;
  // DDS copies the bytes and frees nothing
  sample.bytes._buffer = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(datagram.data()));
  sample.bytes._length = sample.bytes._maximum = static_cast<std::uint32_t>(datagram.size());
  return dds_write(writers_[static_cast<std::size_t>(topic)], &sample) == DDS_RETCODE_OK;
}

std::uint64_t Transport::resent_bytes() const {
  std::uint64_t bytes = 0;
  for (const dds_entity_t writer : writers_) {
    if (writer <= 0) continue;
    const std::unique_ptr<dds_statistics, StatisticsDelete> statistics(dds_create_statistics(writer));
    const dds_stat_keyvalue* const resent = dds_lookup_statistic(statistics.get(), "rexmit_bytes");
    if (resent != nullptr) bytes += resent->u.u64;
  }
  return bytes;
}

void Transport::take(Topic topic, const std::function<void(std::span<const std::byte>)>& each) {
  AFM_CHECK(owner_ == std::this_thread::get_id());
  constexpr std::size_t kAtOnce = 64;
  const dds_entity_t reader = readers_[static_cast<std::size_t>(topic)];
  for (;;) {
    std::array<void*, kAtOnce> samples{};
    std::array<dds_sample_info_t, kAtOnce> infos{};
    const dds_return_t count = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (!infos[i].valid_data) continue;
      const auto& bytes = static_cast<const afm_wire_Datagram*>(samples[i])->bytes;
      each(std::as_bytes(std::span(bytes._buffer, bytes._length)));
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

}  // namespace afm::cluster
