// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "instrument/door.h"

namespace afm::instrument {

class KeptResults;
class SimulatedInstrument;

// Requests to an instrument and their answers, one JSON object a line (docs/serve.md).
class JsonDoor final : public Door {
 public:
  // `folder` is the folder into which "save" writes; empty: none. The instrument must outlive the object.
  JsonDoor(SimulatedInstrument& instrument, std::string folder);
  ~JsonDoor() override;

  std::optional<std::size_t> request_size(std::string_view bytes) const override;
  std::size_t most_request_bytes() const override { return std::size_t{1} << 20; }
  std::string_view too_long() const override;
  std::string_view omitted_end() const override { return "\n"; }

  // Sends the lines of a scan, and one answer.
  Then answer(std::string_view request, const Send& send) override;

 private:
  struct Verbs;

  SimulatedInstrument& instrument_;
  std::unique_ptr<KeptResults> results_;
};

}  // namespace afm::instrument
