// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "app/options/command.h"
#include "core/log.h"
#include "instrument/json_door.h"
#include "instrument/listener.h"
#include "instrument/nanonis_door.h"
#include "instrument/simulated_instrument.h"

namespace afm::app {

namespace {

struct ServeOptions {
  std::string socket;
  std::string sample;
  std::string out;
  std::uint64_t seed = 1;
  std::optional<std::uint16_t> port;
  bool once = false;
};

core::Result<void> serve(const ServeOptions& options, const std::string& assets_dir) {
  std::error_code error;
  if (!options.out.empty() && !std::filesystem::is_directory(options.out, error)) {
    return core::wrong_usage(fmt::format("--out {}: there is no such folder; create it first", options.out));
  }
  auto made =
      instrument::SimulatedInstrument::create(assets_dir, options.seed, {.file = options.sample, .reading = {}});
  if (!made) return tl::unexpected(made.error());
  if (options.socket.empty() && !options.port) {
    return core::wrong_usage("nobody could enter; give --socket PATH, --nanonis PORT, or both");
  }
  instrument::JsonDoor json(*made, options.out);
  instrument::NanonisDoor nanonis(*made);
  std::vector<instrument::Listener> listeners;
  listeners.reserve(2);
  std::vector<instrument::OpenDoor> doors;
  if (!options.socket.empty()) {
    auto listener = instrument::Listener::on_socket(options.socket);
    if (!listener) return tl::unexpected(listener.error());
    listeners.push_back(std::move(*listener));
    doors.push_back({&listeners.back(), &json});
    core::log_line(fmt::format("a microscope in simulated time listens on {}; end it with Ctrl-C", options.socket));
  }
  if (options.port) {
    auto listener = instrument::Listener::on_loopback(*options.port);
    if (!listener) return tl::unexpected(listener.error());
    core::log_line(fmt::format("it speaks Nanonis' protocol on port {} of 127.0.0.1", listener->port()));
    listeners.push_back(std::move(*listener));
    doors.push_back({&listeners.back(), &nanonis});
    made->approach(instrument::NanonisDoor::kApproachSpeedM);  // these clients expect a tip in contact
  }
  return instrument::serve(doors, options.once);
}

}  // namespace

void add_serve_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "serve", "be a microscope in simulated time that other programs control by JSON, and whose truth is known");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<ServeOptions>();
  command
      .add_option(
          "--socket", options->socket,
          "Unix socket to create, for requests in JSON; only programs of the same user may enter, one after the "
          "other")
      .type_name("PATH");
  command
      .add_parsed_option(
          "--nanonis",
          [options](const std::string& text) -> core::Result<void> {
            unsigned port = 0;
            const auto read = std::from_chars(text.data(), text.data() + text.size(), port);
            if (read.ec != std::errc() || read.ptr != text.data() + text.size() || port > 65535) {
              return core::wrong_usage("give a port from 1 to 65535, or 0 for any free one");
            }
            options->port = static_cast<std::uint16_t>(port);
            return {};
          },
          "port of 127.0.0.1 for clients of Nanonis' protocol, which use 6501; default: none")
      .type_name("PORT");
  command.add_option("--seed", options->seed, "seed of noise and chance; the same requests get the same bytes")
      .show_default()
      .type_name("NUMBER");
  command
      .add_option(
          "--sample", options->sample,
          "your own sample instead of the material's: a glTF model with a node for the role surface, or an image")
      .type_name("FILE");
  command.add_option("--out", options->out, "folder in which clients may save images and curves; default: nowhere")
      .type_name("DIR");
  command.add_flag("--once", options->once, "end when the first client has left");
  command.footer(
      "A request and its answer are one JSON object on one line each; docs/serve.md lists them. Nothing else listens.\n"
      "example: touchafm serve --socket afm.sock --seed 7\n"
      R"(example: echo '{"id": 1, "do": "curve", "points": 5}' | nc -U -N afm.sock)");
  command.when_chosen([options, assets = context.assets_dir] { return serve(*options, assets); });
}

}  // namespace afm::app
