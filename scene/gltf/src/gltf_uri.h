// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace afm::scene {

bool is_data_uri(std::string_view uri);

// Decodes "data:[type];base64,..." (RFC 2397, RFC 4648 section 4). Throws GltfError.
std::vector<std::uint8_t> decode_data_uri(std::string_view uri);

// Decodes "%20" to a space (RFC 3986, section 2.1); anything else stays unchanged.
std::string decode_percent(std::string_view uri);

}  // namespace afm::scene
