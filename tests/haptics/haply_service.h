// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace afm::test {

// A stand-in for Haply's Inverse Service: it says where the hand is, and each force that it gets is answered with the
// next state, as the service's documentation tells. One client at a time; the last one may come back.
class HaplyService {
 public:
  // Silent: it takes forces and tells nothing. TooLong: it tells a state of 100 kB, then waits for what comes. Late: the
  // same, 50 ms after it took a force.
  enum class Manner { Proper, Silent, Babbling, NoDevice, TooLong, Late };

  HaplyService() : HaplyService(Manner::Proper) {}
  explicit HaplyService(Manner first)
      : manner(first),
        acceptor_(context_, {boost::asio::ip::address_v4::loopback(), 0}),
        thread_([this] { serve(); }) {}
  HaplyService(const HaplyService&) = delete;
  HaplyService& operator=(const HaplyService&) = delete;
  ~HaplyService() {
    ending_ = true;
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);
    hang_up();
    thread_.join();
  }

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  // Ends the connection, as a service does that is restarted.
  void hang_up() {
    const std::lock_guard lock(mutex_);
    if (client_ >= 0) ::shutdown(client_, SHUT_RDWR);
  }

  struct Force {
    double x, y, z;  // the service's axes
  };
  std::vector<Force> forces() {
    const std::lock_guard lock(mutex_);
    return forces_;
  }

  std::atomic<Manner> manner;
  std::atomic<double> up_m{0.18};  // of the cursor
  std::atomic<bool> button{false};

 private:
  using Tcp = boost::asio::ip::tcp;
  using Stream = boost::beast::websocket::stream<Tcp::socket>;

  std::string state() const {
    if (manner == Manner::Babbling)
      return "{\"inverse3\": [{\"device_id\": \"049D\", \"state\": {\"cursor_position\": ";
    if (manner == Manner::NoDevice) return "{\"inverse3\": []}";
    const nlohmann::json place{{"x", 0.01}, {"y", -0.12}, {"z", up_m.load()}};
    return nlohmann::json{{"inverse3", {{{"device_id", "049D"}, {"state", {{"cursor_position", place}}}}}},
                          {"wireless_verse_grip",
                           {{{"device_id", "61548"}, {"state", {{"buttons", {{"a", button.load()}, {"b", false}}}}}}}}}
        .dump();
  }

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
      while (manner == Manner::Silent && !ending_ && !error) take(std::chrono::milliseconds(1));
      if (error) break;
      if (manner == Manner::Late) std::this_thread::sleep_for(std::chrono::milliseconds(50));
      const bool too_long = manner == Manner::TooLong || manner == Manner::Late;
      stream.write(boost::asio::buffer(state() + std::string(too_long ? 100'000 : 0, ' ')), error);
      if (manner == Manner::NoDevice) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (error || manner == Manner::NoDevice) continue;
      do take(std::chrono::milliseconds(10));
      while (reading && !error && !ending_ && manner != Manner::Silent);
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    boost::beast::error_code ignored;
    stream.next_layer().close(ignored);
    context_.restart();
    context_.run();  // what refers to this frame ends now
    const std::lock_guard lock(mutex_);
    client_ = -1;
  }

  void keep(boost::beast::flat_buffer& buffer) {
    const auto message = nlohmann::json::parse(
        std::string_view(static_cast<const char*>(buffer.cdata().data()), buffer.size()), nullptr, false);
    buffer.clear();
    const auto& values = message["inverse3"][0]["commands"]["set_cursor_force"]["values"];
    const std::lock_guard lock(mutex_);
    forces_.push_back({values["x"], values["y"], values["z"]});
  }

  boost::asio::io_context context_;
  Tcp::acceptor acceptor_;
  std::atomic<bool> ending_{false};
  std::mutex mutex_;
  int client_ = -1;
  std::vector<Force> forces_;
  std::thread thread_;
};

}  // namespace afm::test
