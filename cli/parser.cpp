#include "cli/parser.h"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.h"
#include "base/version.h"
#include "cli/output.h"

namespace veldt {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The fault of an unknown option, perhaps a misspelt one; empty if there is none.
std::string unknown_option(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining();
  const auto option =
      std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with("--"); });
  if (option == rest.end()) return "";
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> known;
  for (const CLI::Option* one : command.get_options({})) known.push_back(one->get_single_name());
  const std::string meant = thermal::near_miss(name.substr(2), known);
  if (meant.empty()) return "unknown option " + name;
  const bool is_option = command.get_option_no_throw("--" + meant) != nullptr;
  return "unknown option " + name + "; did you mean " + (is_option ? "--" + meant : meant + ", without --") +
         "?";
}

/// The fault of a command line, as one line.
std::string usage_fault(const CLI::App* app, const CLI::Error& error) {
  const std::vector<CLI::App*> named = app->get_subcommands();
  if (!named.empty()) {
    const CLI::App* command = named.front();
    const std::string misspelt = unknown_option(*command);
    return fmt::format("{}; see veldt {} --help", misspelt.empty() ? error.what() : misspelt,
                       command->get_name());
  }
  const std::vector<std::string> unknown = app->remaining();
  if (!unknown.empty() && unknown.front().starts_with('-'))
    return fmt::format("option {} before a command; see veldt --help", unknown.front());
  const std::vector<std::string> known = command_names(*app);
  const std::string choice = "expected one of " + thermal::list_names(known, known.size());
  if (unknown.empty()) return fmt::format("no command; {}; see veldt --help", choice);
  return fmt::format("unknown command \"{}\"; {}{}", unknown.front(), choice,
                     thermal::did_you_mean(unknown.front(), known));
}

/// The words after the program's name in reverse order, for the parser; `help X` is an alias of `X --help`.
std::vector<std::string> words_of(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    const std::vector<std::string> known = command_names(app);
    if (words.empty() || std::ranges::find(known, words.front()) != known.end()) words.emplace_back("--help");
  }
  std::ranges::reverse(words);
  return words;
}

/// Prints help, the version or the fault of the command line.
int print_parsed(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out;
  std::ostringstream fault;
  const int code = app.exit(error, out, fault);
  fmt::print(stdout, "{}", out.str());
  print_fault(fault.str());
  return code == 0 ? kDone : kBadUsage;
}

}  // namespace

Option::Option(CLI::Option& option) : option_(&option) {}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::shows_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::shows_default(const std::string& text) {
  option_->default_str(text);
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

Option& Option::between(int lowest, int highest) {
  option_->check(CLI::Range(lowest, highest));
  return *this;
}

Option& Option::between(double lowest, double highest) {
  option_->check(CLI::Range(lowest, highest));
  return *this;
}

Option& Option::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

Option& Option::comma_separated() {
  option_->delimiter(',')->allow_extra_args(false);  // otherwise an argument that follows would be a value
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

bool Option::is_given() const { return option_->count() > 0; }

Command::Command(CLI::App& command, Run& chosen) : command_(&command), chosen_(&chosen) {}

Option Command::add(const std::string& names, const Variable& variable, const std::string& help) {
  return std::visit([&](auto* value) { return Option(*command_->add_option(names, *value, help)); },
                    variable);
}

Option Command::add_option(const std::string& names, const std::function<void(const std::string&)>& store,
                           const std::string& help) {
  return Option(*command_->add_option_function<std::string>(names, store, help));
}

Option Command::add_flag(const std::string& name, bool& value, const std::string& help) {
  return Option(*command_->add_flag(name, value, help));
}

void Command::footer(const std::string& text) { command_->footer(text); }

void Command::runs(Run run) {
  command_->callback([chosen = chosen_, run = std::move(run)] { *chosen = run; });
}

Parser::Parser(const std::string& description) : app_(std::make_unique<CLI::App>(description, "veldt")) {
  app_->set_version_flag("-V,--version", std::string(thermal::kVersion));
  app_->require_subcommand(1);
  app_->failure_message(usage_fault);
}

Parser::~Parser() = default;

Command Parser::add_command(const std::string& name, const std::string& purpose) {
  Command command(*app_->add_subcommand(name, purpose), chosen_);
  command.add_flag("--quiet", common_.quiet, "Print errors only");
  command.add_option("--progress", common_.progress, "How to show progress, on standard error")
      .one_of({"auto", "plain", "json", "none"})
      .shows_default();
  command.add_option("--threads", common_.threads, "Number of threads; 0: one per usable core")
      .between(0, 1024)
      .shows_default();
  return command;
}

std::optional<int> Parser::parse(int argc, const char* const* argv) {
  try {
    app_->parse(words_of(*app_, argc, argv));
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return print_parsed(*app_, error);
  }
}

}  // namespace veldt
