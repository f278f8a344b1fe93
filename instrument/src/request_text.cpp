// SPDX-License-Identifier: Apache-2.0
#include "request_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "refused_request.h"

namespace afm::instrument {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeepestRequest = 8;

// True for text nested so deeply that no JSON library should build it.
bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && (text[i] == '[' || text[i] == '{')) {
      if (++depth > kDeepestRequest) return true;
    } else if (!quoted && (text[i] == ']' || text[i] == '}')) {
      --depth;
    }
  }
  return false;
}

// Names of the members of each open object, to find one that is given twice.
class MemberNames {
 public:
  void take(int depth, Json::parse_event_t event, const Json& parsed) {
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::object_start) names_.at(level).clear();
    if (event != Json::parse_event_t::key) return;
    const auto& name = parsed.get_ref<const std::string&>();
    if (names_.at(level - 1).insert(name).second) return;
    throw RefusedRequest(fmt::format("\"{}\" is given twice", name));
  }

 private:
  std::array<std::set<std::string>, kDeepestRequest + 1> names_;
};

// The part "number overflow parsing '1e400'" of "[json.exception.out_of_range.406] number overflow parsing '1e400'".
std::string reason_of(const Json::exception& error) {
  constexpr std::size_t kMostLetters = 200;
  const std::string_view text = error.what();
  const std::size_t end_of_name = text.find("] ");
  return std::string(text.substr(end_of_name == std::string_view::npos ? 0 : end_of_name + 2).substr(0, kMostLetters));
}

}  // namespace

Json parsed_request(std::string_view line) {
  constexpr const char* kWanted = "a request is a JSON object on one line: {\"id\": 1, \"do\": \"hello\"}";
  if (is_too_deep(line)) throw RefusedRequest("the request is nested too deep");
  MemberNames names;
  const auto take = [&names](int depth, Json::parse_event_t event, const Json& parsed) {
    names.take(depth, event, parsed);
    return true;
  };
  try {
    Json request = Json::parse(line, take);
    if (!request.is_object()) throw RefusedRequest(kWanted);
    return request;
  } catch (const Json::exception& error) {
    throw RefusedRequest(fmt::format("{}; {}", kWanted, reason_of(error)));
  }
}

Json id_of(const Json& request) {
  constexpr double kLargestExact = 9007199254740992.0;  // limit above which a double loses digits of integers
  const auto found = request.find("id");
  if (found == request.end() || found->is_null()) return nullptr;
  if (!found->is_number() && !found->is_string()) throw RefusedRequest("\"id\": give a number or a text");
  if (found->is_number_float() && std::abs(found->get<double>()) > kLargestExact) {
    throw RefusedRequest("\"id\": so large a number cannot be repeated with all its digits; give a text");
  }
  return *found;
}

}  // namespace afm::instrument
