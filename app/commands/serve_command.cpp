// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/cluster/cluster_start.h"
#include "app/commands/view_command.h"
#include "app/display/spectator_window.h"
#include "app/display/view_display.h"
#include "app/options/command.h"
#include "app/options/exhibit_options.h"
#include "app/options/pixel_size_option.h"
#include "core/clock.h"
#include "core/log.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "instrument/json_door.h"
#include "instrument/listener.h"
#include "instrument/nanonis_door.h"
#include "instrument/showcase.h"
#include "instrument/simulated_instrument.h"
#include "render/device_failure.h"

namespace afm::app {

namespace {

struct ServeOptions {
  std::string socket;
  std::string sample;
  std::string out;
  std::uint64_t seed = 1;
  std::optional<std::uint16_t> port;
  bool once = false;
  bool view = false;
  exhibit::ExhibitFiles files;  // files of the view
  DisplayOptions display;
};

// The instrument with its interfaces, which listen after open().
class Served {
 public:
  static core::Result<std::unique_ptr<Served>> create(const ServeOptions& options, const std::string& assets_dir) {
    auto made =
        instrument::SimulatedInstrument::create(assets_dir, options.seed, {.file = options.sample, .reading = {}});
    if (!made) return tl::unexpected(made.error());
    return std::unique_ptr<Served>(new Served(std::move(*made), options.out));
  }

  core::Result<void> open(const ServeOptions& options) {
    listeners_.reserve(2);
    if (!options.socket.empty()) {
      auto listener = instrument::Listener::on_socket(options.socket);
      if (!listener) return tl::unexpected(listener.error());
      listeners_.push_back(std::move(*listener));
      doors_.push_back({&listeners_.back(), &json_});
      core::log_line(fmt::format("a microscope in simulated time listens on {}; end it with Ctrl-C", options.socket));
    }
    if (options.port) {
      auto listener = instrument::Listener::on_loopback(*options.port);
      if (!listener) return tl::unexpected(listener.error());
      core::log_line(fmt::format("it speaks Nanonis' protocol on port {} of 127.0.0.1", listener->port()));
      listeners_.push_back(std::move(*listener));
      doors_.push_back({&listeners_.back(), &nanonis_});
      instrument_.approach(instrument::NanonisDoor::kApproachSpeedM);  // these clients expect a tip in contact
    }
    return {};
  }

  instrument::SimulatedInstrument& instrument() { return instrument_; }
  core::Result<void> run(bool once) { return instrument::serve(doors_, once); }

 private:
  Served(instrument::SimulatedInstrument instrument, const std::string& out)
      : instrument_(std::move(instrument)), json_(instrument_, out), nanonis_(instrument_) {}

  instrument::SimulatedInstrument instrument_;
  instrument::JsonDoor json_;
  instrument::NanonisDoor nanonis_;
  std::vector<instrument::Listener> listeners_;
  std::vector<instrument::OpenDoor> doors_;
};

// A wall with the samples that have been under the tip so far, and its windows.
struct ShownWall {
  exhibit::Stage stage;
  std::vector<curves::SampleModel> materials;
  std::unique_ptr<ViewDisplay> display;
};

core::Result<std::unique_ptr<ShownWall>> open_wall(const ServeOptions& options, const core::Clock& clock) {
  auto stage = exhibit::load_exhibit(options.files);
  if (!stage) return tl::unexpected(stage.error());
  if (auto alone = check_one_machine(stage->wall, options.display.window, ""); !alone) {
    return tl::unexpected(alone.error());
  }
  auto materials = exhibit::felt_samples(*stage, physics::FrictionLaw::None);
  if (!materials) return tl::unexpected(materials.error());
  auto wall = std::make_unique<ShownWall>(ShownWall{std::move(*stage), std::move(*materials), nullptr});
  auto display = ViewDisplay::open(wall->stage, options.display, nullptr, clock);
  if (!display) return tl::unexpected(display.error());
  wall->display = std::move(*display);
  return wall;
}

// Shows the instrument until the window is closed or `over`; reopens for another material. Failures only end the
// view.
void show(ServeOptions options, std::unique_ptr<ShownWall> wall, instrument::Showcase& showcase,
          const core::Clock& clock, const std::function<bool()>& over) {
  while (wall) {
    std::optional<std::string> other;
    try {
      SpectatorWindow window(wall->stage, wall->materials, *wall->display, showcase, clock);
      other = window.run(over);
    } catch (const render::DeviceFailure& failure) {
      core::log_line(fmt::format("the view has ended: {}; the microscope goes on", failure.what()));
      return;
    }
    if (!other) break;
    std::vector<std::string> shown = wall->stage.materials.names();
    if (shown.size() == exhibit::kMostMaterials) shown.erase(shown.begin());
    shown.push_back(*other);
    options.files.shown = std::move(shown);
    wall.reset();
    auto next = open_wall(options, clock);
    if (!next)
      return core::log_line(fmt::format("the view has ended: {}; the microscope goes on", next.error().message));
    wall = std::move(*next);
  }
  if (!over()) core::log_line("the view is closed; the microscope goes on until Ctrl-C or \"quit\"");
}

core::Result<void> serve(const ServeOptions& options, const std::string& assets_dir) {
  std::error_code error;
  if (!options.out.empty() && !std::filesystem::create_directories(options.out, error) &&
      !std::filesystem::is_directory(options.out, error)) {
    return core::wrong_usage(fmt::format("--out {}: cannot make this folder: {}", options.out, error.message()));
  }
  const auto served = Served::create(options, assets_dir);
  if (!served) return tl::unexpected(served.error());
  if (options.socket.empty() && !options.port) {
    return core::wrong_usage("no client could connect; give --socket PATH, --nanonis PORT, or both");
  }
  if (!options.view) {
    if (auto opened = (*served)->open(options); !opened) return opened;
    return (*served)->run(options.once);
  }
  // before anybody can enter, so that a missing display is known at once
  const core::MonotonicClock clock;
  auto wall = open_wall(options, clock);
  if (!wall) return tl::unexpected(wall.error());
  instrument::Showcase showcase;
  (*served)->instrument().show_in(showcase);
  if (auto opened = (*served)->open(options); !opened) return opened;
  std::atomic<bool> over = false;
  core::Result<void> ran;
  std::jthread server([&] {
    ran = (*served)->run(options.once);
    over = true;
  });
  show(options, std::move(*wall), showcase, clock, [&over] { return over.load(); });
  server.join();
  return ran;
}

}  // namespace

void add_serve_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "serve", "run a simulated microscope that other programs control by JSON, and whose truth is known");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<ServeOptions>();
  command
      .add_option(
          "--socket", options->socket,
          "Unix socket to create, for requests in JSON; only programs of the same user may connect, one at a time")
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
          "your own sample instead of the material's: a glTF model with a node for the role surface, or an image; or "
          "gratings, as for touchafm scan")
      .type_name("FILE");
  command
      .add_option("--out", options->out,
                  "folder in which clients may save images and curves, made if there is none; default: nowhere")
      .type_name("DIR");
  command.add_flag("--once", options->once, "end when the first client has left");
  Option view = command.add_flag("--view", options->view,
                                 "show the microscope in a window, as a spectator: tip, sample, the newest curve and "
                                 "the image line by line; the picture lags, the microscope does not wait for it");
  options->files.assets_dir = context.assets_dir;
  options->files.language = context.language;
  add_wall_option(command, options->files).needs(view);
  options->display.keys_hint = "Escape ends the view";
  pixel_size_option(command, "--size", options->display.window.size_px,
                    "open one window of this size in pixels; default: as touchafm view", PixelRange{64, 16384})
      .needs(view);
  command.footer(
      "A request and its answer are one JSON object on one line each; docs/serve.md lists them. Nothing else listens.\n"
      "example: touchafm serve --socket afm.sock --seed 7\n"
      R"(example: echo '{"id": 1, "do": "curve", "points": 5}' | nc -U -N afm.sock)");
  command.when_chosen([options, assets = context.assets_dir] { return serve(*options, assets); });
}

}  // namespace afm::app
