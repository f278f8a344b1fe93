// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "curves/map_place.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::curves {
class CurveMap;
struct SampleModel;
}  // namespace afm::curves
namespace afm::scene {
struct TipState;
}

namespace afm::exhibit {

// Quantities for the picture of a force map. All except the height need fits.
enum class MapQuantity { Height, Modulus, Adhesion };

// Name for the log and for sessions: "modulus".
std::string_view name_of(MapQuantity quantity);

// Quantity with that name; empty if there is none.
std::optional<MapQuantity> map_quantity_of(std::string_view name);

// Quantity shown first for a map: the modulus if its curves were fitted.
MapQuantity first_quantity(const curves::CurveMap& map);

// Next available quantity of the map; the same without fits.
MapQuantity next_quantity(const curves::CurveMap& map, MapQuantity shown);

// One quantity of a force map in false colours, between the 1st and the 99th percentile, with `felt` marked: heights
// above the lowest one; the modulus of all usable fits; the hardest pull. A pixel without a value has
// the colour of a place without a measurement.
render::MapPicture map_picture(const curves::CurveMap& map, const curves::MapPlace& felt, const Phrases& phrases,
                               MapQuantity quantity = MapQuantity::Height);

// Notes for the panel on a whole map that is felt: "map: E 2.3 MPa, W 40 mJ/m² here", and one more if that pixel has
// no fit or a doubtful one, or if no pixel lies below the tip. Empty without a map below the tip.
std::vector<std::string> felt_map_notes(const curves::SampleModel& model, const scene::TipState& tip,
                                        const Phrases& phrases);

// Position of a pixel in the picture, as ControlTarget::index, and back.
std::size_t target_index(const curves::MapPlace& place, const curves::CurveMap& map);
curves::MapPlace place_of(const render::ControlTarget& target, const curves::CurveMap& map);

}  // namespace afm::exhibit
