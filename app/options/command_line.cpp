// SPDX-License-Identifier: Apache-2.0
#include "app/options/command_line.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace afm::app {

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
  option_->check(CLI::Range(least, most));
  return *this;
}

Option& Option::within(double least, double most) {
  // CLI11's own check lets through what is not a number
  option_->check(CLI::Range(least, most))->check([](const std::string& text) {
    double value = 0.0;
    return CLI::detail::lexical_cast(text, value) && std::isnan(value) ? text + " is no number" : std::string();
  });
  return *this;
}

Option& Option::one_of(std::initializer_list<int> values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

Option& Option::one_of(std::initializer_list<const char*> words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

Option& Option::existing_folder() {
  option_->check(CLI::ExistingDirectory);
  return *this;
}

Option& Option::one_value_each() {
  option_->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

bool Option::given() const { return !option_->empty(); }

template <class Value>
Option OptionList::add_option(const std::string& name, Value& target, const std::string& help) {
  CLI::Option* const option = app_->add_option(name, target, help);
  if constexpr (std::same_as<Value, std::string> || std::same_as<Value, std::vector<std::string>>) {
    option->check([](const std::string& text) { return std::string(text.empty() ? "its value is empty" : ""); });
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
  app_->set_version_flag("--version", program + " " + version);
}

CommandLine::CommandLine(std::unique_ptr<CLI::App> app) : OptionList(*app, chosen_), app_(std::move(app)) {}

CommandLine::~CommandLine() = default;

core::Result<std::string> CommandLine::parse(int count, const char* const* arguments) {
  try {
    app_->parse(count, arguments);
    return "";
  } catch (const CLI::Success& asked) {  // --help, --version
    std::ostringstream answer;
    app_->exit(asked, answer);
    return answer.str();
  } catch (const CLI::ParseError& wrong) {
    return core::wrong_usage(wrong.what());
  }
}

}  // namespace afm::app
