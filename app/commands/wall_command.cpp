// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/command.h"
#include "app/options/exhibit_options.h"
#include "app/options/pixel_size_option.h"
#include "cluster/network.h"
#include "core/enumerators.h"
#include "core/log.h"
#include "core/written_by.h"
#include "exhibit/frame/calibration.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/wall_drawing.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/scenery/stage_place.h"
#include "exhibit/scenery/wall_layout.h"
#include "scene/display/disparity.h"
#include "scene/display/wall_doubts.h"

namespace afm::app {

namespace {

struct WallOptions {
  std::string file;
  std::optional<scene::HeadPose> head;  // pose that replaces the viewer's sweet spot
  bool json = false;
  bool test_pattern = false;
  bool start = false;
  std::string out;
  exhibit::PictureOptions picture;
  exhibit::ExhibitFiles files;  // used only for their language
};

core::Result<scene::HeadPose> parse_head(std::string_view text) {
  const auto wrong = [&] {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("\"{}\" is not x,y,z or x,y,z,qx,qy,qz,qw: metres, then a unit quaternion", text));
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

// Adds a screen's overlaps with other screens and its outputs' corrections.
void add_corrections(const scene::Wall& wall, std::size_t screen, nlohmann::json& entry) {
  if (const auto& blend = wall.screens[screen].blend) {
    nlohmann::json edges = nlohmann::json::object();
    for (std::size_t edge = 0; edge < blend->ramps.size(); ++edge) {
      const scene::EdgeRamp& ramp = blend->ramps.at(edge);
      if (ramp.width_m > 0.0) {
        edges[std::string(scene::kScreenEdgeNames.at(edge))] = {{"begin_m", ramp.begin_m}, {"width_m", ramp.width_m}};
      }
    }
    nlohmann::json overlapping = nlohmann::json::array();
    for (const std::size_t other : blend->neighbours) overlapping.push_back(wall.screens[other].name);
    entry["blend"] = {{"screens", std::move(overlapping)}, {"edges", std::move(edges)}};
  }
  nlohmann::json outputs = nlohmann::json::array();
  for (const scene::Output& output : wall.outputs) {
    if (output.screen != screen || (!output.blend && !output.warp)) continue;
    nlohmann::json corrected{{"name", output.name}};
    if (output.blend) {
      const scene::Blend& blend = *output.blend;
      corrected["gamma"] = blend.gamma ? nlohmann::json(*blend.gamma) : nlohmann::json("sRGB");
      corrected["black_level"] = blend.fields.front().black;
      corrected["brightest_black"] = blend.brightest_black;
    }
    if (output.warp) corrected["warp_mesh"] = {{"columns", output.warp->columns}, {"rows", output.warp->rows}};
    outputs.push_back(std::move(corrected));
  }
  if (!outputs.empty()) entry["corrected_outputs"] = std::move(outputs);
}

core::Result<nlohmann::json> frusta(const scene::Wall& wall, const scene::HeadPose& head, double ipd_m) {
  nlohmann::json all = nlohmann::json::array();
  for (std::size_t index = 0; index < wall.screens.size(); ++index) {
    const scene::Screen& screen = wall.screens[index];
    const auto views = exhibit::eyes_before(screen, head, ipd_m);
    if (!views) return tl::unexpected(views.error());
    for (std::size_t i = 0; i < views->size(); ++i) {
      const scene::EyeView& view = views->at(i);
      const glm::dvec3& position = view.eye_position_m;
      all.push_back({{"screen", screen.name},
                     {"eye", i == 0 ? "left" : "right"},
                     {"eye_position_m", {position.x, position.y, position.z}},
                     {"projection", row_major(view.projection)},
                     {"view", row_major(view.view)}});
      add_corrections(wall, index, all.back());
      core::name_software(all.back());
    }
  }
  return all;
}

void explain_blend(const scene::Wall& wall, const scene::ScreenBlend& blend) {
  std::string edges, screens;
  for (std::size_t edge = 0; edge < blend.ramps.size(); ++edge) {
    const double width_m = blend.ramps.at(edge).width_m;
    if (width_m <= 0.0) continue;
    edges +=
        fmt::format("{}{} edge {:.0f} mm", edges.empty() ? "" : ", ", scene::kScreenEdgeNames.at(edge), width_m * 1e3);
  }
  for (const std::size_t other : blend.neighbours) {
    screens += fmt::format("{}{}", screens.empty() ? "" : ", ", wall.screens[other].name);
  }
  std::printf("  blended with %s: %s\n", screens.c_str(), edges.c_str());
}

void explain_screen(const scene::Wall& wall, const scene::Screen& screen, const scene::HeadPose& head, double ipd_m) {
  const double distance = glm::dot(head.position_m - screen.lower_left, screen.normal());
  std::printf("screen %s: %.3f m x %.3f m, the head is %.3f m in front of it\n", screen.name.c_str(), screen.width_m(),
              screen.height_m(), distance);
  const scene::ComfortZone zone = scene::comfort_zone(distance, ipd_m, scene::kComfortableDisparityRad);
  const std::string farthest =
      std::isfinite(zone.farthest_m) ? fmt::format("{:.2f} m", zone.farthest_m) : std::string("any distance");
  std::printf("  comfortable depth: %.2f m to %s in front of the eyes\n", zone.nearest_m, farthest.c_str());
  if (screen.blend) explain_blend(wall, *screen.blend);
}

// Explains distortion: non-square pixels make circles oval, except in modes whose display stretches the picture back.
void explain_output(const scene::Wall& wall, const scene::Output& output) {
  const scene::Screen& screen = wall.screens[output.screen];
  const glm::uvec2 size = output.rect.size_px;
  const std::string where = output.monitor.empty() ? fmt::format("{} x {} pixels at {}, {}", size.x, size.y,
                                                                 output.rect.offset_px.x, output.rect.offset_px.y)
                                                   : fmt::format("all of monitor {}", output.monitor);
  const std::string on_node = output.node ? fmt::format("node {}, ", wall.nodes[*output.node].name) : std::string();
  std::printf("output %s: %sscreen %s, %s%s%s, %s%s\n", output.name.c_str(), on_node.c_str(), screen.name.c_str(),
              std::string(scene::name_of(output.mode)).c_str(),
              !output.eye                       ? ""
              : *output.eye == scene::Eye::Left ? ", left eye"
                                                : ", right eye",
              output.order == scene::EyeOrder::Swapped ? ", eyes swapped" : "", where.c_str(),
              output.picture_from_output == glm::dmat3(1.0) ? "" : ", with a keystone");
  if (output.warp) {
    std::printf("  warp mesh of %u x %u nodes\n", output.warp->columns, output.warp->rows);
  }
  if (output.blend) {
    const scene::Blend& blend = *output.blend;
    std::printf("  blended by %s; black %g of white, raised to %g\n",
                blend.gamma ? fmt::format("gamma {:g}", *blend.gamma).c_str() : "the sRGB curve",
                blend.fields.front().black, blend.brightest_black);
  }
  if (size == glm::uvec2(0) || scene::frame_packing(output.mode)) return;
  const glm::dvec2 eye(scene::eye_size(output.mode, size));
  const double oval = (screen.width_m() / eye.x) / (screen.height_m() / eye.y);
  if (std::abs(oval - 1.0) > 0.01) {
    std::printf("  note: its pixels are %.3f times as wide as they are high; check the corners or the rectangle\n",
                oval);
  }
}

// Explains how the scene is placed on this wall, and whether its text is readable from the head's position.
void explain_composition(const scene::Wall& wall, const scene::HeadPose& head) {
  const exhibit::StagePlace stage = exhibit::stage_place(wall);
  const exhibit::WallShape shape = exhibit::wall_shape(stage);
  constexpr auto kPanels = std::to_array({"next to the instrument", "below the shelf", "on the side screens"});
  static_assert(kPanels.size() == core::kEnumerators<exhibit::Arrangement>.size());
  // tiles of one plane count as one screen, whose name is not in the file
  const bool is_one = std::any_of(wall.screens.begin(), wall.screens.end(),
                                  [&](const scene::Screen& screen) { return screen.name == stage.main.name; });
  std::printf("composition: scene on %s%s, panels %s\n", is_one ? "screen " : "", stage.main.name.c_str(),
              kPanels[static_cast<std::size_t>(shape.arrangement)]);
  // A line of the smallest text is 30 mm high on the paper's wall; a capital of Inter has 0.60 of its line.
  constexpr double kSmallestCapitalM = 0.018;
  constexpr double kReadableArcMinutes = 6.0;  // capital height in arc minutes; a sharp eye needs 5
  constexpr double kArcMinutesPerRad = 3437.75;
  const double distance_m = glm::distance(head.position_m, stage.main.center());
  const double capital = kSmallestCapitalM * shape.unit_m / distance_m * kArcMinutesPerRad;
  std::printf("  the smallest capital letters are %.1f mm high, %.0f arc minutes as seen from the head\n",
              kSmallestCapitalM * shape.unit_m * 1e3, capital);
  if (capital < kReadableArcMinutes) {
    std::printf("  note: many people cannot read capitals below %.0f arc minutes; move closer or use a larger screen\n",
                kReadableArcMinutes);
  }
}

// A scene of one invisible point, because only the pattern is drawn.
scene::Scene nothing() {
  scene::Scene scene;
  scene.materials.push_back({});
  scene::Primitive point;
  point.vertices.resize(3);
  point.indices = {0, 1, 2};
  scene.meshes.push_back({.name = "nothing", .primitives = {point}});
  scene.nodes.push_back({.name = "nothing", .parent = {}, .mesh = 0});
  return scene;
}

core::Result<void> draw_test_pattern(const scene::Wall& wall, const WallOptions& options) {
  const auto phrases = exhibit::load_phrases(options.files);
  if (!phrases) return tl::unexpected(phrases.error());
  exhibit::PictureOptions picture = options.picture;
  picture.mesh_lines = true;
  auto drawing = exhibit::WallDrawing::open(wall, picture);
  if (!drawing) return tl::unexpected(drawing.error());
  const scene::Scene scene = nothing();
  const double millimetre_m = 1e-3 * exhibit::wall_shape(exhibit::stage_place(wall)).unit_m;
  const double ipd_m = options.picture.ipd_m.value_or(wall.viewers.front().ipd_m);
  const auto build = [&](const exhibit::OutputPicture& output, const std::array<scene::EyeView, 2>& eyes) {
    render::FrameState frame;
    frame.eyes = eyes;
    frame.room_from_node.assign(scene.nodes.size(), glm::dmat4(1.0));
    exhibit::show_calibration(output.screen, output.mode, ipd_m, phrases->wall, frame);
    return frame;
  };
  return drawing->write(scene, millimetre_m, build, options.out);
}

// Prints the command that starts each node, and finally the one for this machine.
core::Result<void> print_start(const scene::Wall& wall, const std::string& file) {
  if (wall.nodes.empty()) {
    return core::wrong_usage(
        fmt::format("{} names no other machine: add [[node]] to it, with a name and a host", file));
  }
  for (const scene::WallNode& node : wall.nodes) {
    const auto address = cluster::address_of_host(node.host);
    if (!address) return tl::unexpected(address.error());
    std::printf("ssh %s DISPLAY=:0 touchafm node %s --interface %s\n", node.host.c_str(), node.name.c_str(),
                address->c_str());
  }
  std::printf("touchafm view --wall %s --cluster\n", file.c_str());
  return {};
}

// `head_doubt` is that of a head on the command line, which the others may have said.
void conclude(const std::vector<std::string>& doubts, const std::string& head_doubt) {
  for (const std::string& doubt : doubts) std::printf("note: %s\n", doubt.c_str());
  const bool said = std::any_of(doubts.begin(), doubts.end(),
                                [&](const std::string& doubt) { return doubt.find(head_doubt) != std::string::npos; });
  if (!head_doubt.empty() && !said) std::printf("note: the head is %s\n", head_doubt.c_str());
  if (doubts.empty()) {
    std::printf("the wall file is valid\n");
  } else {
    std::printf("the wall file can be used, but check %s\n", doubts.size() == 1 ? "the note above" : "the notes above");
  }
}

core::Result<void> run_wall(const WallOptions& options) {
  if (options.test_pattern == options.out.empty()) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         "--test-pattern needs --out FILE.png, and --out needs --test-pattern");
  }
  const auto wall = scene::load_wall(options.file);
  if (!wall) return tl::unexpected(wall.error());
  scene::Wall seen_wall = *wall;
  if (options.head) seen_wall.viewers.front().sweet_spot = *options.head;
  const scene::Viewer& viewer = seen_wall.viewers.front();
  const double ipd_m = options.picture.ipd_m.value_or(viewer.ipd_m);
  const scene::HeadPose& head = viewer.sweet_spot;
  const auto seen = frusta(*wall, head, ipd_m);
  if (!seen) return tl::unexpected(seen.error());
  const std::vector<std::string> doubts = scene::doubts_of(seen_wall);
  if (options.test_pattern || options.start || options.json) {
    for (const std::string& note : scene::notes_of(seen_wall)) {
      core::log_line(fmt::format("wall file {}: {}", options.file, note));
    }
  }
  if (options.test_pattern) return draw_test_pattern(*wall, options);
  if (options.start) return print_start(*wall, options.file);
  if (options.json) {
    std::printf("%s\n", seen->dump(2).c_str());
    return {};
  }
  for (const scene::Screen& screen : wall->screens) explain_screen(*wall, screen, head, ipd_m);
  for (const scene::Output& output : wall->outputs) explain_output(*wall, output);
  explain_composition(*wall, head);
  std::printf("viewer %s: %.1f mm between the eyes, head %s\n", viewer.name.c_str(), ipd_m * 1e3,
              viewer.head == "none" ? "not tracked" : viewer.head.c_str());
  for (const std::string& unused : wall->unused) std::printf("note: %s\n", unused.c_str());
  conclude(doubts, scene::doubt_of_head(*wall, head.position_m));
  return {};
}

}  // namespace

void add_wall_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command("wall", "check a wall file and print the view of each eye");
  command.footer("example: touchafm wall powerwall --json --head 0.2,1.7,2.1");
  auto options = std::make_shared<WallOptions>();
  command
      .add_option("file", options->file,
                  "wall file (TOML), a ParaView configuration (.pvx), or the name of an included wall, such as "
                  "cave")
      .or_included_in(context.assets_dir + "/walls")
      .required()
      .type_name("FILE");
  const auto read_head = [head = &options->head](const std::string& text) -> core::Result<void> {
    const auto parsed = parse_head(text);
    if (!parsed) return tl::unexpected(parsed.error());
    *head = *parsed;
    return {};
  };
  command
      .add_parsed_option("--head", read_head,
                         "head position in metres and orientation as a unit quaternion; default: the sweet spot")
      .type_name("X,Y,Z[,QX,QY,QZ,QW]");
  command.add_flag("--json", options->json,
                   "print the projection and view matrices of each eye as JSON: row-major, reversed infinite depth, y "
                   "down, near plane 0.1 m");
  command.add_flag("--test-pattern", options->test_pattern,
                   "draw the calibration picture: grid, cross, circle, ruler, L and R; needs --out");
  command.add_option("--out", options->out, "PNG file for the test pattern").picture_file(".png").type_name("FILE.png");
  command.add_flag("--start", options->start, "print the commands that start a wall of several machines, one for each");
  pixel_size_option(command, "--size", options->picture.size_px, "size of the whole test pattern in pixels");
  add_stereo_options(command, options->picture, "the outputs of the wall file, otherwise side-by-side");
  add_gpu_option(command, options->picture.gpu);
  add_phrase_options(command, options->files, context);
  command.when_chosen([options] { return run_wall(*options); });
}

}  // namespace afm::app
