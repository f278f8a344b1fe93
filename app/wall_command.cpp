// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/command.h"
#include "scene/wall.h"

namespace afm::app {

namespace {

struct WallOptions {
  std::string file;
  std::string head;  // empty: the viewer's sweet spot
  bool json = false;
};

core::Result<scene::HeadPose> parse_head(std::string_view text) {
  const auto wrong = [&] {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("--head: \"{}\" is not x,y,z in metres, with or without a unit quaternion ,qx,qy,qz,qw", text));
  };
  std::vector<double> v;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view field = rest.substr(0, comma);
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) return wrong();
    v.push_back(value);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (v.size() != 3 && v.size() != 7) return wrong();
  scene::HeadPose head{.position_m = {v[0], v[1], v[2]}};
  if (v.size() == 7) {
    const glm::dquat orientation(v[6], v[3], v[4], v[5]);
    if (std::abs(glm::length(orientation) - 1.0) > 1e-3) return wrong();
    head.room_from_head = glm::normalize(orientation);
  }
  return head;
}

nlohmann::json row_major(const glm::dmat4& m) {
  nlohmann::json values = nlohmann::json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) values.push_back(m[column][row]);
  }
  return values;
}

core::Result<void> run_wall(const WallOptions& options) {
  const auto wall = scene::load_wall(options.file);
  if (!wall) return tl::unexpected(wall.error());
  const scene::Viewer& viewer = wall->viewers.front();
  scene::HeadPose head = viewer.sweet_spot;
  if (!options.head.empty()) {
    const auto parsed = parse_head(options.head);
    if (!parsed) return tl::unexpected(parsed.error());
    head = *parsed;
  }

  nlohmann::json frusta = nlohmann::json::array();
  for (const scene::Screen& screen : wall->screens) {
    for (const scene::Eye eye : scene::kEyes) {
      const glm::dvec3 position = scene::eye_position(head, eye, viewer.ipd_m);
      const auto view =
          scene::off_axis_view(screen, position, scene::DepthConvention::VulkanReversedInfinite, scene::kNearM, 0.0);
      if (!view) return tl::unexpected(view.error());
      frusta.push_back({{"screen", screen.name},
                        {"eye", eye == scene::Eye::Left ? "left" : "right"},
                        {"eye_position_m", {position.x, position.y, position.z}},
                        {"projection", row_major(view->projection)},
                        {"view", row_major(view->view)}});
    }
  }
  if (options.json) {
    std::printf("%s\n", frusta.dump(2).c_str());
    return {};
  }
  for (const scene::Screen& screen : wall->screens) {
    const double distance = glm::dot(head.position_m - screen.lower_left, screen.normal());
    std::printf("screen %s: %.3f m x %.3f m, the head is %.3f m in front of it\n", screen.name.c_str(),
                screen.width_m(), screen.height_m(), distance);
  }
  std::printf("viewer %s: %.1f mm between the eyes\nthe wall file is in order\n", viewer.name.c_str(),
              viewer.ipd_m * 1e3);
  return {};
}

}  // namespace

void add_wall_command(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("wall", "check a wall file and print what each eye sees of it");
  command->footer("example: touchafm wall assets/walls/powerwall.toml --json --head 0.2,1.7,2.1");
  auto options = std::make_shared<WallOptions>();
  command->add_option("file", options->file, "wall file (TOML)")->required()->type_name("FILE");
  command
      ->add_option("--head", options->head,
                   "head position in metres, and orientation as a unit quaternion; default: the sweet spot")
      ->type_name("X,Y,Z[,QX,QY,QZ,QW]");
  command->add_flag(
      "--json", options->json,
      "print each eye's projection and view, row-major, reversed infinite depth, y down, near plane 0.1 m");
  command->callback([options, &context] { context.chosen = [options] { return run_wall(*options); }; });
}

}  // namespace afm::app
