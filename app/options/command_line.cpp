// SPDX-License-Identifier: Apache-2.0
#include "app/options/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "app/options/nearest_word.h"
#include "app/options/usage_errors.h"
#include "app/options/written_files.h"
#include "core/file_names.h"
#include "core/whole_file.h"

namespace afm::app {

namespace {

// Names of the checks of an option that writes its file, and of one that draws a picture into it.
constexpr const char* kWrites = "writes";
constexpr const char* kDraws = "draws";

std::string names_of(const char* word, const std::set<CLI::Option*>& options) {
  // sorted by name, because CLI11's sets of pointers are sorted by address
  std::set<std::string> names;
  for (const CLI::Option* option : options) names.insert(option->get_name());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? word : ", ") + name;
  return text;
}

// Accepted values, such as "PIXELS from 64 to 8192" or "{csv,json}"; empty for a flag.
std::string value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  std::string value = option.get_type_name();  // type, followed by a colon and the description of each check
  const std::size_t colon = value.find(':');
  if (colon == std::string::npos) return value;
  std::string type = value.substr(0, colon);
  if (type == "INT" || type == "UINT" || type == "FLOAT") type = "NUMBER";
  return type + (type.empty() ? "" : " ") + value.substr(colon + 1);
}

OptionDescription describe_option(const CLI::Option& option) {
  std::string rules = option.get_required() ? "required" : "";
  for (const std::string& rule :
       {names_of("needs ", option.get_needs()), names_of("not with ", option.get_excludes())}) {
    if (!rule.empty()) rules += (rules.empty() ? "" : "; ") + rule;
  }
  return {.name = option.get_name(false, true),
          .value = value_of(option),
          .help = option.get_description(),
          .fallback = option.get_default_str(),
          .rules = rules,
          .argument = option.get_positional()};
}

CommandDescription describe_command(const CLI::App& app) {
  CommandDescription command{.name = app.get_name(),
                             .help = app.get_description(),
                             .footer = app.get_footer(),
                             .options = {},
                             .alternatives = {},
                             .commands = {}};
  for (const CLI::Option* option : app.get_options()) {
    // CLI11 gives a group of options a help flag that it never shows
    const bool help_of_group = app.get_name().empty() && option == app.get_help_ptr();
    if (!help_of_group && !option->get_group().empty()) command.options.push_back(describe_option(*option));
  }
  for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
    const CommandDescription inner = describe_command(*below);
    if (!below->get_name().empty()) {
      command.commands.push_back(inner);
    } else {
      command.alternatives.push_back({.title = below->get_group(), .options = inner.options});
    }
  }
  return command;
}

TypedCommand typed_command(const CLI::App& program) {
  const auto typed_below = [](const CLI::App& app) -> const CLI::App* {
    for (const CLI::App* each : app.get_subcommands()) {
      if (!each->get_name().empty()) return each;  // a command, not a group of options
    }
    return nullptr;
  };
  const CLI::App* last = &program;
  std::string words = program.get_name();
  for (const CLI::App* below = typed_below(*last); below != nullptr; below = typed_below(*last)) {
    last = below;
    words += " " + last->get_name();
  }
  return {.words = words, .command = describe_command(*last), .left = last->remaining(true)};
}

// Refuses a text that is no number of the limits' type, NaN, and a number outside the limits.
template <class Number>
void check_range(CLI::Option& option, Number least, Number most) {
  const auto refusal = [&option, least, most](std::string& text) -> std::string {
    Number value{};
    if (!CLI::detail::lexical_cast(text, value)) return no_number(value_of(option), text);
    // written so that NaN is refused
    if (value >= least && value <= most) return "";
    return fmt::format("{} is out of range; give {}", text, value_of(option));
  };
  std::string limits;
  if constexpr (std::integral<Number>) {
    limits = fmt::format("from {} to {}", least, most);
  } else {
    limits = fmt::format("from {:g} to {:g}", least, most);
  }
  option.check(CLI::Validator(refusal, limits));
}

bool has_check(CLI::Option& option, const char* name) {
  try {
    return option.get_validator(name) != nullptr;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

bool writes(CLI::Option& option) { return has_check(option, kWrites); }

// True if the value is a file, alone or after a word and a colon.
bool reads(CLI::Option& option) {
  const std::string value = value_of(option);
  const auto names = [&](const char* word) { return value.find(word) != std::string::npos; };
  return !writes(option) &&
         (names("FILE") || names("SESSION") || option.get_description().find(":FILE") != std::string::npos);
}

void add_given_options(CLI::App& app, std::vector<GivenOption>& given) {
  for (CLI::Option* option : app.get_options()) {
    if (option->empty()) continue;
    given.push_back({.name = option->get_name(),
                     .values = option->results(),
                     .reads = reads(*option),
                     .writes = writes(*option),
                     .draws = has_check(*option, kDraws)});
  }
  for (CLI::App* below : app.get_subcommands([](CLI::App*) { return true; })) add_given_options(*below, given);
}

// CLI11's help, except for an option's value, default and rules, whose wording differs between CLI11 versions.
class HelpFormatter : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override {
    const std::string value = value_of(*option);
    return value.empty() ? "" : " " + value;
  }

  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override {
    const OptionDescription described = describe_option(*option);
    std::string text = described.help;
    if (!described.fallback.empty()) text += "; default: " + described.fallback;
    if (!described.rules.empty()) text += "; " + described.rules;
    return text;
  }
};

// True for "cove.toml", which is nearly "cave.toml"; not for "wall.toml", which is only a part of "powerwall.toml".
bool is_misspelt(const std::string& name, const std::vector<std::string>& known) {
  const std::filesystem::path file(name);
  if (file.extension() != ".toml") return false;
  const std::string stem = file.stem().string(), nearest = nearest_word(stem, known);
  return !nearest.empty() && nearest.find(stem) == std::string::npos;
}

}  // namespace

Option& Option::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::show_default(const std::string& text) {
  option_->default_str(text);
  return *this;
}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::within(int least, int most) {
  check_range(*option_, least, most);
  return *this;
}

Option& Option::within(double least, double most) {
  check_range(*option_, least, most);
  return *this;
}

Option& Option::one_of(std::initializer_list<int> values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

Option& Option::existing_folder() {
  option_->check(CLI::Validator(CLI::ExistingDirectory).description(""));
  return *this;
}

Option& Option::or_included_in(const std::string& folder) {
  option_->transform([folder](const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (name.find('/') != std::string::npos || fs::exists(name, ignored)) return name;
    std::vector<std::string> known;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".toml") continue;
      if (name == file.filename() || name == file.stem()) return file.string();
      known.push_back(file.stem().string());
    }
    if (known.empty() || (name.find('.') != std::string::npos && !is_misspelt(name, known))) return name;
    std::sort(known.begin(), known.end());
    throw CLI::ValidationError(fmt::format(
        "\"{}\" is neither a file nor included; choose {}, or give the path of a file", name, fmt::join(known, ", ")));
  });
  return *this;
}

Option& Option::writable_file() {
  option_->check([](const std::string& path) {
    const auto writable = core::check_writable(path);
    return writable ? std::string() : writable.error().message;
  });
  return written();
}

Option& Option::written() {
  option_->check(CLI::Validator([](std::string&) { return std::string(); }, "", kWrites));
  return *this;
}

Option& Option::ends_in(const char* ending) {
  option_->check([ending](const std::string& path) {
    if (!core::is_named_as_another(path, ending)) return std::string();
    return fmt::format("{}: name a file that ends in {}, which it will be", path, ending);
  });
  return *this;
}

Option& Option::picture_file(const char* ending) {
  ends_in(ending);
  option_->check(CLI::Validator([](std::string&) { return std::string(); }, "", kDraws));
  return writable_file();
}

Option& Option::one_value_each() {
  option_->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

Option& Option::hidden() {
  option_->group("");
  return *this;
}

bool Option::given() const { return !option_->empty(); }

template <class Value>
Option OptionList::add_option(const std::string& name, Value& target, const std::string& help) {
  CLI::Option* const option = app_->add_option(name, target, help);
  if constexpr (std::same_as<Value, std::string> || std::same_as<Value, std::vector<std::string>>) {
    option->check([](const std::string& text) { return std::string(text.empty() ? "its value is empty" : ""); });
  }
  // CLI11 would report a negative number as one beyond all limits
  if constexpr (std::unsigned_integral<Value>) {
    option->check([](const std::string& text) {
      return text.starts_with('-') ? fmt::format("\"{}\" is negative", text) : std::string();
    });
  }
  return Option(*option);
}

template Option OptionList::add_option(const std::string&, std::string&, const std::string&);
template Option OptionList::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option OptionList::add_option(const std::string&, int&, const std::string&);
template Option OptionList::add_option(const std::string&, std::uint32_t&, const std::string&);
template Option OptionList::add_option(const std::string&, std::int64_t&, const std::string&);
template Option OptionList::add_option(const std::string&, std::size_t&, const std::string&);
template Option OptionList::add_option(const std::string&, double&, const std::string&);
template Option OptionList::add_option(const std::string&, std::optional<double>&, const std::string&);

Option OptionList::add_parsed_option(const std::string& name,
                                     std::function<core::Result<void>(const std::string& text)> read,
                                     const std::string& help) {
  const auto parse = [name, read = std::move(read)](const std::string& text) {
    if (const auto done = read(text); !done) throw CLI::ValidationError(name, done.error().message);
  };
  return Option(*app_->add_option_function<std::string>(name, parse, help));
}

Option OptionList::add_flag(const std::string& name, bool& target, const std::string& help) {
  return Option(*app_->add_flag(name, target, help));
}

Option OptionList::add_flag(const std::string& name, std::function<void()> when_given, const std::string& help) {
  return Option(*app_->add_flag_callback(name, std::move(when_given), help));
}

OptionList OptionList::add_alternatives(const std::string& title) {
  CLI::App* group = app_->add_option_group(title);
  group->require_option(1);
  return OptionList(*group, *chosen_);
}

OptionList OptionList::add_command(const std::string& name, const std::string& help) {
  app_->require_subcommand(1);
  return OptionList(*app_->add_subcommand(name, help), *chosen_);
}

void OptionList::footer(const std::string& text) { app_->footer(text); }

void OptionList::when_chosen(Action action) {
  app_->callback([chosen = chosen_, action = std::move(action)] { *chosen = action; });
}

CommandLine::CommandLine(const std::string& program, const std::string& version, const std::string& help)
    : CommandLine(std::make_unique<CLI::App>(help, program)) {
  app_->formatter(std::make_shared<HelpFormatter>());
  app_->set_version_flag("--version", program + " " + version);
}

CommandLine::CommandLine(std::unique_ptr<CLI::App> app) : OptionList(*app, chosen_), app_(std::move(app)) {}

CommandLine::~CommandLine() = default;

CommandDescription CommandLine::describe() const { return describe_command(*app_); }

core::Result<std::string> CommandLine::parse(int count, const char* const* arguments) {
  try {
    app_->parse(count, arguments);
    std::vector<GivenOption> given;
    add_given_options(*app_, given);
    if (const auto checked = check_written_files(given); !checked) return tl::unexpected(checked.error());
    return "";
  } catch (const CLI::Success& asked) {  // --help or --version
    std::ostringstream answer;
    app_->exit(asked, answer);
    return answer.str();
  } catch (const CLI::ConversionError& wrong) {
    // "Could not convert: --seed = -1"
    const std::string text = wrong.what();
    const std::size_t name = text.find(": "), value = text.find(" = ");
    if (name == std::string::npos || value == std::string::npos) return core::wrong_usage(text);
    const std::string option = text.substr(name + 2, value - name - 2), written = text.substr(value + 3);
    return core::wrong_usage(option + ": " + no_number(taken_by(typed_command(*app_).command, option), written));
  } catch (const CLI::ParseError& wrong) {
    const int code = wrong.get_exit_code();
    const bool incomplete = code == static_cast<int>(CLI::ExitCodes::RequiredError) ||
                            code == static_cast<int>(CLI::ExitCodes::ExtrasError);
    return core::wrong_usage(usage_text(typed_command(*app_), wrong.what(), incomplete));
  }
}

}  // namespace afm::app
