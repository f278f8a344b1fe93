// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

namespace afm::instrument {

// A protocol through which a client controls an instrument. All input is untrusted. One thread.
class Door {
 public:
  Door() = default;
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;
  virtual ~Door() = default;

  // Size of the first whole request at the beginning of `bytes`; empty: not all of it has come.
  virtual std::optional<std::size_t> request_size(std::string_view bytes) const = 0;

  // Limit of a request. A client that sends more without ending one is sent too_long() and given up.
  virtual std::size_t most_request_bytes() const = 0;
  virtual std::string_view too_long() const = 0;
  // True if the request at the beginning of `bytes`, of which not all has come, will be too long.
  virtual bool announces_too_much(std::string_view /*bytes*/) const { return false; }
  // Bytes that the last request may lack if its client sends nothing more.
  virtual std::string_view omitted_end() const { return {}; }

  // Function that sends bytes; false: nobody reads any more.
  using Send = std::function<bool(std::string_view bytes)>;
  enum class Then { GoOn, Quit };

  // Answers one request of request_size() bytes, whatever it is.
  virtual Then answer(std::string_view request, const Send& send) = 0;

  // Input that the client has sent after the request being answered; does not wait. For work that the next request may
  // stop.
  using Look = std::function<std::string_view()>;
  void look_with(Look look) { look_ = std::move(look); }

 protected:
  std::string_view sent_meanwhile() const { return look_ ? look_() : std::string_view(); }

 private:
  Look look_;  // callback for further input; empty: none can arrive meanwhile
};

}  // namespace afm::instrument
