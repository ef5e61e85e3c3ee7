#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library has it so
class App;
class Option;
}  // namespace CLI

/// The command line by CLI11, which no command includes: its templates would take five seconds in each.
namespace veldt {

/// Options of every command.
struct CommonOptions {
  bool quiet = false;
  std::string progress = "auto";
  int threads = 0;
};

/// An option or an argument of a command, to which conditions are added.
class Option {
 public:
  explicit Option(CLI::Option& option);

  Option& required();
  /// Placeholder of the value in the help, such as FILE.
  Option& type_name(const std::string& name);
  /// Shows the variable's value as the default.
  Option& shows_default();
  Option& shows_default(const std::string& text);
  Option& one_of(const std::vector<std::string>& values);
  Option& between(int lowest, int highest);
  Option& between(double lowest, double highest);
  Option& positive();
  /// Splits one word into several values.
  Option& comma_separated();
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

  /// Is it on the command line? Known after parsing.
  [[nodiscard]] bool is_given() const;

 private:
  CLI::Option* option_;
};

/// A command of the program, to which options are added. Their values are stored in variables, which must outlive
/// parsing.
class Command {
 public:
  using Run = std::function<int(const CommonOptions&)>;

  /// If the user wants this command, parsing stores what it does in `chosen`.
  Command(CLI::App& command, Run& chosen);

  /// `names`: "--out", or "config" of an argument.
  template <typename Value>
  Option add_option(const std::string& names, Value& value, const std::string& help) {
    return add(names, &value, help);
  }
  /// `store` gets the value, such as to turn a name into a constant.
  Option add_option(const std::string& names, const std::function<void(const std::string&)>& store,
                    const std::string& help);
  Option add_flag(const std::string& name, bool& value, const std::string& help);
  /// Text after the options in the help; its paragraphs end with full stops, and examples begin with "Example: ".
  void footer(const std::string& text);
  /// What the command does; returns the exit code.
  void runs(Run run);

 private:
  using Variable =
      std::variant<std::string*, int*, double*, std::uint32_t*, std::optional<int>*, std::optional<double>*,
                   std::optional<std::uint32_t>*, std::vector<std::string>*, std::vector<double>*>;
  Option add(const std::string& names, const Variable& variable, const std::string& help);

  CLI::App* command_;
  Run* chosen_;
};

/// The program's command line.
class Parser {
 public:
  explicit Parser(const std::string& description);
  ~Parser();
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  /// A command with the common options.
  Command add_command(const std::string& name, const std::string& purpose);

  /// Parses a line. Returns the exit code if nothing is to be run: help, version or the line's fault is then printed.
  [[nodiscard]] std::optional<int> parse(int argc, const char* const* argv);
  /// Runs the command that was parsed.
  [[nodiscard]] int run() const { return chosen_(common_); }

  [[nodiscard]] const CommonOptions& common() const noexcept { return common_; }
  [[nodiscard]] const CLI::App& app() const noexcept { return *app_; }

 private:
  std::unique_ptr<CLI::App> app_;
  CommonOptions common_;
  Command::Run chosen_;
};

}  // namespace veldt
