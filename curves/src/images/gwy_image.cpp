// SPDX-License-Identifier: Apache-2.0
#include "images/gwy_image.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <map>
#include <string>

#include "bytes/file_bytes.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostObjects = 100'000;

// Reads the bytes of a file sequentially.
class GwyReader {
 public:
  explicit GwyReader(std::string_view bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }

  std::string_view take(std::size_t size) {
    const std::string_view taken = part(rest_, 0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  template <class T>
  T number() {
    return number_at<T>(take(sizeof(T)), 0);
  }

  // Reads up to the NUL and skips it.
  std::string_view text() {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos) throw CutShort();
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return found;
  }

 private:
  std::string_view rest_;
};

struct Component {
  char type = 0;
  std::string_view payload;  // string without its NUL, or components of an object
  std::string_view object;   // name of an object's type
};

using Components = std::map<std::string_view, Component>;

// Components of one object. Objects inside it stay bytes, which limits the recursion for any file.
Components components_of(std::string_view bytes) {
  Components found;
  GwyReader reader(bytes);
  while (!reader.at_end()) {
    if (found.size() > kMostObjects) throw CurveError("it holds more than an image does");
    const std::string_view name = reader.text();
    Component component{.type = reader.number<char>(), .payload = {}, .object = {}};
    const auto array = [&](std::size_t size) { return reader.take(size * reader.number<std::uint32_t>()); };
    switch (component.type) {
      case 'b':
      case 'c':
        component.payload = reader.take(1);
        break;
      case 'i':
        component.payload = reader.take(4);
        break;
      case 'q':
      case 'd':
        component.payload = reader.take(8);
        break;
      case 's':
        component.payload = reader.text();
        break;
      case 'o':
        component.object = reader.text();
        component.payload = array(1);
        break;
      case 'C':
        component.payload = array(1);
        break;
      case 'I':
        component.payload = array(4);
        break;
      case 'Q':
      case 'D':
        component.payload = array(8);
        break;
      case 'S':
        for (auto left = reader.number<std::uint32_t>(); left > 0; --left) reader.text();
        break;
      case 'O':
        for (auto left = reader.number<std::uint32_t>(); left > 0; --left) {
          reader.text();
          array(1);
        }
        break;
      default:
        throw CurveError("it is damaged: it has a component of an unknown type");
    }
    found.insert_or_assign(name, component);
  }
  return found;
}

const Component* find_component(const Components& components, std::string_view name, char type) {
  const auto found = components.find(name);
  return found != components.end() && found->second.type == type ? &found->second : nullptr;
}

double gwy_number(const Components& components, std::string_view name, double otherwise) {
  const Component* found = find_component(components, name, 'd');
  return found != nullptr ? number_at<double>(found->payload, 0) : otherwise;
}

std::size_t gwy_side(const Components& components, std::string_view name) {
  const Component* found = find_component(components, name, 'i');
  if (found == nullptr) throw CurveError(fmt::format("it has no {}", name));
  return image_side(number_at<std::int32_t>(found->payload, 0));
}

ScaledUnit gwy_unit(const Components& components, std::string_view name) {
  const Component* unit = find_component(components, name, 'o');
  if (unit == nullptr || unit->object != "GwySIUnit") return {};
  const Components parts = components_of(unit->payload);
  const Component* text = find_component(parts, "unitstr", 's');
  return text != nullptr ? scaled_unit(text->payload) : ScaledUnit{};
}

ImagePage gwy_page(std::string_view field, std::string name, ImagePages& found) {
  const Components parts = components_of(field);
  const std::size_t columns = gwy_side(parts, "xres"), rows = gwy_side(parts, "yres");
  const Component* data = find_component(parts, "data", 'D');
  if (data == nullptr || data->payload.size() != columns * rows * sizeof(double)) {
    throw CurveError(fmt::format("its data do not fill {} x {} points", columns, rows));
  }
  const ScaledUnit xy = gwy_unit(parts, "si_unit_xy"), z = gwy_unit(parts, "si_unit_z");
  found.remark_if_without(xy);
  const std::string_view numbers = data->payload;
  return {.name = std::move(name),
          .unit = z.unit,
          .columns = columns,
          .rows = rows,
          .width_m = image_length_m(gwy_number(parts, "xreal", 1.0), xy),
          .height_m = image_length_m(gwy_number(parts, "yreal", 1.0), xy),
          .x_offset_m = gwy_number(parts, "xoff", 0.0) * xy.factor,
          .y_offset_m = gwy_number(parts, "yoff", 0.0) * xy.factor,
          .values = [=, factor = z.factor] {
            return grid_values(columns, rows, false,
                               [=](std::size_t i) { return factor * number_at<double>(numbers, i * sizeof(double)); });
          }};
}

// Text N of a name "/N/data", or empty.
std::string_view index_in(std::string_view name) {
  constexpr std::string_view kEnd = "/data";
  if (!name.starts_with('/') || !name.ends_with(kEnd)) return {};
  const std::string_view index = name.substr(1, name.size() - 1 - kEnd.size());
  return index.find_first_not_of("0123456789") == std::string_view::npos ? index : std::string_view{};
}

}  // namespace

ImagePages read_gwy(std::string_view bytes) {
  if (bytes.starts_with(kOldGwyMagic)) throw CurveError("it is a file of Gwyddion 1; save it again with Gwyddion 2");
  GwyReader reader(bytes.substr(kGwyMagic.size()));
  if (reader.text() != "GwyContainer") throw CurveError("it does not begin with Gwyddion's container");
  const auto size = reader.number<std::uint32_t>();
  const Components container = components_of(reader.take(size));

  // sorted by number
  std::map<unsigned long, std::string_view> fields;
  for (const auto& [name, component] : container) {
    const std::string_view index = index_in(name);
    unsigned long number = 0;
    if (index.empty() || component.type != 'o' || component.object != "GwyDataField" ||
        std::from_chars(index.data(), index.data() + index.size(), number).ec != std::errc()) {
      continue;
    }
    fields.emplace(number, name);
  }
  ImagePages found;
  for (const auto& [number, name] : fields) {
    const std::string prefix(name.substr(0, name.size() - std::string_view("data").size()));
    const Component* title = find_component(container, prefix + "data/title", 's');
    const std::string channel = title != nullptr ? std::string(title->payload) : fmt::format("Channel {}", number);
    add_page(channel, found, [&, field = container.at(name).payload] { return gwy_page(field, channel, found); });
    const Component* meta = find_component(container, prefix + "meta", 'o');
    if (meta == nullptr || !found.metadata.empty()) continue;
    for (const auto& [key, value] : components_of(meta->payload)) {
      if (value.type == 's' && found.metadata.size() < kMostImageMetadata)
        found.metadata.emplace_back(key, value.payload);
    }
  }
  return found;
}

}  // namespace afm::curves
