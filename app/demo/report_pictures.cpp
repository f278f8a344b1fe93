// SPDX-License-Identifier: Apache-2.0
#include "app/demo/report_pictures.h"

#include <utility>

#include "core/whole_file.h"
#include "exhibit/report/report.h"

namespace afm::app {

ReportPictures::ReportPictures(render::Context& context, render::Renderer& renderer, const core::OutputFolder& out)
    : saver_(context, renderer), out_(out) {}

ReportPictures::~ReportPictures() = default;

void ReportPictures::keep_errors(std::vector<render::SavedPicture> saved) {
  for (render::SavedPicture& picture : saved) {
    if (!picture.written) errors_.push_back(std::move(picture.written.error()));
  }
}

void ReportPictures::add(const std::string& file, const std::string& caption) {
  paths_.push_back(out_.staged(file));
  pictures_.push_back({caption, {}});
  keep_errors(saver_.collect());
  if (saver_.save({}, paths_.back())) return;
  keep_errors(saver_.finish());
  saver_.save({}, paths_.back());
}

core::Result<std::vector<exhibit::ReportPicture>> ReportPictures::finish() {
  keep_errors(saver_.finish());
  if (!errors_.empty()) return tl::unexpected(errors_.front());
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    auto bytes = core::read_file(paths_[i]);
    if (!bytes) return tl::unexpected(bytes.error());
    pictures_[i].png = std::move(*bytes);
  }
  return std::exchange(pictures_, {});
}

}  // namespace afm::app
