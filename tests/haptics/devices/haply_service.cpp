// SPDX-License-Identifier: Apache-2.0
#include "haply_service.h"

#include <sys/socket.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace afm::test {

class HaplyService::Server {
 public:
  explicit Server(const HaplyService& told)
      : told_(told), acceptor_(context_, {boost::asio::ip::address_v4::loopback(), 0}), thread_([this] { serve(); }) {}
  ~Server() {
    ending_ = true;
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);
    hang_up();
    thread_.join();
  }

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  void hang_up() {
    const std::lock_guard lock(mutex_);
    if (client_ >= 0) ::shutdown(client_, SHUT_RDWR);
  }
  std::vector<Force> forces() const {
    const std::lock_guard lock(mutex_);
    return forces_;
  }

  unsigned states() const { return states_; }

 private:
  using Tcp = boost::asio::ip::tcp;
  using Stream = boost::beast::websocket::stream<Tcp::socket>;

  std::string state() const {
    if (told_.manner == Manner::Babbling)
      return "{\"inverse3\": [{\"device_id\": \"049D\", \"state\": {\"cursor_position\": ";
    if (told_.manner == Manner::NoDevice) return "{\"inverse3\": []}";
    const nlohmann::json place{{"x", 0.01 + tremor_m()}, {"y", -0.12}, {"z", told_.up_m.load()}};
    if (told_.manner == Manner::Crowd) {
      const nlohmann::json inverse3{{"device_id", "049D"}, {"state", {{"cursor_position", place}}}};
      const nlohmann::json minverse{
          {"device_id", "0012"}, {"config", {{"type", "minverse"}}}, {"state", {{"cursor_position", place}}}};
      nlohmann::json arms = nlohmann::json::array({inverse3, minverse});
      if (told_.second_only) arms.erase(0);
      return nlohmann::json{{"inverse3", arms}, {"hexaverse", {{{"device_id", "9"}}}}}.dump();
    }
    return nlohmann::json{
        {"inverse3", {{{"device_id", "049D"}, {"state", {{"cursor_position", place}}}}}},
        {"wireless_verse_grip",
         {{{"device_id", "61548"}, {"state", {{"buttons", {{"a", told_.button.load()}, {"b", false}}}}}}}}}
        .dump();
  }

  // the places flicker, as those of encoders under a hand do
  double tremor_m() const { return ++states_ % 2 == 0 ? 1e-7 : 0.0; }

  void serve() {
    while (!ending_) {
      boost::beast::error_code error;
      Tcp::socket socket(context_);
      acceptor_.accept(socket, error);
      if (error) return;
      {
        const std::lock_guard lock(mutex_);
        client_ = socket.native_handle();
      }
      talk(Stream(std::move(socket)));
    }
  }

  void talk(Stream stream) {
    boost::beast::error_code error;
    while (told_.manner == Manner::Mute && !ending_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stream.accept(error);
    stream.text(true);
    boost::beast::flat_buffer buffer;
    bool reading = false;
    // Takes the next force, if it comes within `patience`.
    const auto take = [&](std::chrono::milliseconds patience) {
      if (!reading) {
        reading = true;
        stream.async_read(buffer, [&](const boost::beast::error_code& result, std::size_t) {
          reading = false;
          error = result;
        });
      }
      context_.restart();
      const auto end = std::chrono::steady_clock::now() + patience;
      while (reading && context_.run_one_until(end) > 0) {
      }
      if (!reading && !error) keep(buffer);
    };
    while (!error && !ending_) {
      while (told_.manner == Manner::Silent && !ending_ && !error) take(std::chrono::milliseconds(1));
      if (error) break;
      if (told_.manner == Manner::Late) std::this_thread::sleep_for(std::chrono::milliseconds(50));
      const bool too_long = told_.manner == Manner::TooLong || told_.manner == Manner::Late;
      stream.write(boost::asio::buffer(state() + std::string(too_long ? 100'000 : 0, ' ')), error);
      if (told_.manner == Manner::NoDevice) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (error || told_.manner == Manner::NoDevice) continue;
      do take(std::chrono::milliseconds(10));
      while (reading && !error && !ending_ && told_.manner != Manner::Silent);
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    boost::beast::error_code ignored;
    stream.next_layer().close(ignored);
    context_.restart();
    context_.run();  // ends everything that refers to this frame
    const std::lock_guard lock(mutex_);
    client_ = -1;
  }

  void keep(boost::beast::flat_buffer& buffer) {
    const auto message = nlohmann::json::parse(
        std::string_view(static_cast<const char*>(buffer.cdata().data()), buffer.size()), nullptr, false);
    buffer.clear();
    const auto& device = message["inverse3"][0];
    const auto& values = device["commands"]["set_cursor_force"]["values"];
    const std::lock_guard lock(mutex_);
    forces_.push_back({values["x"], values["y"], values["z"], device["device_id"]});
  }

  const HaplyService& told_;
  boost::asio::io_context context_;
  Tcp::acceptor acceptor_;
  std::atomic<bool> ending_{false};
  mutable std::mutex mutex_;
  int client_ = -1;
  mutable std::atomic<unsigned> states_{0};  // number of states sent
  std::vector<Force> forces_;
  std::thread thread_;
};

HaplyService::HaplyService(Manner first) : manner(first), server_(std::make_unique<Server>(*this)) {}
HaplyService::~HaplyService() = default;
std::uint16_t HaplyService::port() const { return server_->port(); }
void HaplyService::hang_up() { server_->hang_up(); }
unsigned HaplyService::states() const { return server_->states(); }
std::vector<HaplyService::Force> HaplyService::forces() const { return server_->forces(); }

}  // namespace afm::test
