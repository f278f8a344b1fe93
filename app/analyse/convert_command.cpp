// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "app/analyse/reading_options.h"
#include "app/options/command.h"
#include "app/options/standard_output.h"
#include "core/log.h"
#include "core/new_file.h"
#include "core/printable.h"
#include "core/whole_file.h"
#include "curves/conversion.h"
#include "curves/image_file.h"

namespace afm::app {

namespace {

struct ConvertOptions {
  std::string from, to;
  std::size_t index = 0;
  curves::ConversionOptions conversion;
};

core::Result<void> convert(const ConvertOptions& options) {
  std::error_code none;  // unused, since a missing file is no other name of the first one
  if (std::filesystem::equivalent(options.from, options.to, none)) {
    return core::wrong_usage(fmt::format("{} and {} are one file, which would be lost", options.from, options.to));
  }
  // a pattern may name a second measurement in its place
  if (std::filesystem::is_regular_file(options.to, none)) {
    return core::wrong_usage(
        fmt::format("there is already a file {}, and no file is replaced; choose another name", options.to));
  }
  if (const auto writable = core::check_writable(options.to); !writable) {
    return core::wrong_usage(writable.error().message);
  }
  const auto made = curves::converted(options.from, options.to, options.conversion);
  if (!made) return tl::unexpected(made.error());
  if (const auto written = core::write_new_file(options.to, made->bytes); !written) return written;
  for (const std::string& remark : made->remarks) core::log_line(fmt::format("{}: {}", options.from, remark));
  return write_stdout(core::printable_line(fmt::format("{}: {}", options.to, made->contents)) + "\n");
}

}  // namespace

void add_convert_command(OptionList& program, const CommandContext&) {
  OptionList command = program.add_command("convert", "convert measured curves or an image into an open format");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<ConvertOptions>();
  command
      .add_option("file", options->from,
                  fmt::format("curves: {}; images: {}", curves::kCurveFiles, curves::kImageFiles))
      .required()
      .type_name("FILE");
  command
      .add_option("new-file", options->to,
                  fmt::format("file to write; its ending decides the format: {}", curves::kConvertedFiles))
      .required()
      .type_name("NEW");
  const Option index =
      command
          .add_option("--curve", options->index,
                      "number of the curve in a file with several, from 0; without it all of them, into an .h5")
          .type_name("INDEX");
  command
      .add_option("--channel", options->conversion.channel, "channel of an image that becomes a .gsf; default: height")
      .type_name("NAME");
  add_reading_options(command, options->conversion.reading);
  command.footer(
      "docs/curves.md says what each format holds. The log names what is left out or rounded. No file is replaced.\n"
      "example: touchafm convert gel.jpk-force gel.tab\n"
      "         touchafm convert cell.jpk-qi-data cell.h5\n"
      "         touchafm convert mica.spm mica.gwy\n"
      "         touchafm convert mica.nid mica.gsf --channel Z-Axis");
  command.when_chosen([options, index] {
    if (index.given()) options->conversion.index = options->index;
    return convert(*options);
  });
}

}  // namespace afm::app
