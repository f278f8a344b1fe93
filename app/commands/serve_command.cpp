// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>

#include "app/options/command.h"
#include "core/log.h"
#include "instrument/json_door.h"
#include "instrument/socket_server.h"

namespace afm::app {

namespace {

struct ServeOptions {
  std::string socket;
  std::string sample;
  std::string out;
  std::uint64_t seed = 1;
  bool once = false;
};

core::Result<void> serve(const ServeOptions& options, const std::string& assets_dir) {
  std::error_code error;
  if (!options.out.empty() && !std::filesystem::is_directory(options.out, error)) {
    return core::wrong_usage(fmt::format("--out {}: there is no such folder; create it first", options.out));
  }
  auto made = instrument::SimulatedInstrument::create(assets_dir, options.seed, {.file = options.sample, .reading = {}});
  if (!made) return tl::unexpected(made.error());
  auto server = instrument::SocketServer::listen(options.socket);
  if (!server) return tl::unexpected(server.error());
  core::log_line(fmt::format("a microscope in simulated time listens on {}; end it with Ctrl-C", options.socket));
  instrument::JsonDoor door(*made, options.out);
  using Clients = instrument::SocketServer::Clients;
  return server->run(door, options.once ? Clients::One : Clients::Many);
}

}  // namespace

void add_serve_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "serve", "be a microscope in simulated time that other programs control by JSON, and whose truth is known");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<ServeOptions>();
  command
      .add_option("--socket", options->socket,
                  "Unix socket to create; only programs of the same user may enter, one after the other")
      .required()
      .type_name("PATH");
  command.add_option("--seed", options->seed, "seed of noise and chance; the same requests get the same bytes")
      .show_default()
      .type_name("NUMBER");
  command
      .add_option("--sample", options->sample,
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
