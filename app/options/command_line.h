// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

// CLI11 parses the command line. Only command_line.cpp includes it, because it takes longer to compile than the rest of
// a command.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace afm::app {

// One option, or one positional argument. A handle: a copy refers to the same option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  // Placeholder for the value in the help.
  Option& type_name(const std::string& name);
  // Shows the target's current value, or the text, as the default in the help.
  Option& show_default();
  Option& show_default(const std::string& text);

  // Rules whose violation is WrongUsage: the option is required, needs another, or excludes another.
  Option& required();
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

  // Rejects all values outside the range as WrongUsage. Both ends are legal. Values are compared in the type of the
  // limits.
  Option& within(int least, int most);
  Option& within(double least, double most);
  Option& one_of(std::initializer_list<int> values);
  Option& one_of(const std::vector<std::string>& words);
  Option& existing_folder();
  // A name without a folder that is no file of the current folder may be that of a TOML file in `folder`, with or
  // without its extension. WrongUsage, with all names, if none fits and it has no extension or looks like a misspelt
  // name.
  Option& or_included_in(const std::string& folder);
  Option& writable_file();  // checked early, so that no result is lost after long work

  // The value is a file or folder to be written, as implied by writable_file(). WrongUsage if it is a file that
  // another option reads.
  Option& written();
  Option& ends_in(const char* ending);  // WrongUsage for the name of another kind of file, such as a.mp3 for ".wav"
  // As writable_file(), for a picture of the format with this ending. Also WrongUsage if its name is that of another
  // kind of file, or the file is a measurement, which the picture would replace.
  Option& picture_file(const char* ending);

  // Hides the option from help, man page and completion: for our own programs.
  Option& hidden();

  // For a list: takes one value each time the option is given.
  Option& one_value_each();

  // Returns whether the option was given; false before parsing.
  bool given() const;

 private:
  CLI::Option* option_;
};

// Options, arguments and subcommands of a command or of the program. A handle: copies share one list. Every target must
// outlive the CommandLine.
class OptionList {
 public:
  using Action = std::function<core::Result<void>()>;

  // "--name" is an option, "name" a positional argument. command_line.cpp lists the supported types: texts, numbers,
  // and lists of texts.
  template <class Value>
  Option add_option(const std::string& name, Value& target, const std::string& help);

  // Passes the text to `read` while parsing. An error of `read` is WrongUsage of this option.
  Option add_parsed_option(const std::string& name, std::function<core::Result<void>(const std::string& text)> read,
                           const std::string& help);

  Option add_flag(const std::string& name, bool& target, const std::string& help);
  Option add_flag(const std::string& name, std::function<void()> when_given, const std::string& help);

  // Adds options of which exactly one must be given, under a title in the help.
  OptionList add_alternatives(const std::string& title);

  // Adds a command, of which exactly one must be given.
  OptionList add_command(const std::string& name, const std::string& help);

  // Sets the last lines of the help.
  void footer(const std::string& text);

  // Sets the action of CommandLine::run for this command.
  void when_chosen(Action action);

 protected:
  OptionList(CLI::App& app, Action& chosen) : app_(&app), chosen_(&chosen) {}

 private:
  CLI::App* app_;
  Action* chosen_;
};

// Help of one option or positional argument.
struct OptionDescription {
  std::string name;   // name such as "--model"; for a positional argument "file"
  std::string value;  // accepted values as in the help; empty for a flag
  std::string help;
  std::string fallback;  // default value, or empty
  std::string rules;     // "required", "needs --gltf", "not with --size", or empty
  bool argument = false;
};

// Options of which exactly one must be given.
struct AlternativesDescription {
  std::string title;
  std::vector<OptionDescription> options;
};

// Help of a command, or of the program with its subcommands.
struct CommandDescription {
  std::string name;
  std::string help;
  std::string footer;
  std::vector<OptionDescription> options;
  std::vector<AlternativesDescription> alternatives;
  std::vector<CommandDescription> commands;
};

// The command line of a program, with --help and --version.
class CommandLine : public OptionList {
 public:
  CommandLine(const std::string& program, const std::string& version, const std::string& help);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  ~CommandLine();

  // Returns the text for --help or --version; empty if a command was chosen. WrongUsage reports the first error.
  core::Result<std::string> parse(int count, const char* const* arguments);

  // Descriptions for the man page and the shell's completion.
  CommandDescription describe() const;

  // Runs the chosen command.
  core::Result<void> run() const { return chosen_(); }

 private:
  explicit CommandLine(std::unique_ptr<CLI::App> app);

  std::unique_ptr<CLI::App> app_;
  Action chosen_;
};

}  // namespace afm::app
