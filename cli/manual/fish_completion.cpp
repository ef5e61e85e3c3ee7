#include <fmt/format.h>

#include "cli/manual/completions.h"

namespace veldt {
namespace {

/// Single-quoted for fish.
std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string line(const std::string& condition, const std::string& rest) {
  return fmt::format("complete -c veldt -n {} {}\n", fish_quoted(condition), rest);
}

/// -r: an option with a value, completed with files; -x: without files.
std::string option_line(const std::string& condition, const OptionText& option) {
  std::string rest;
  for (const std::string& name : option.names)
    rest += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.choices.empty())
    rest += fmt::format(" -x -a {}", fish_quoted(shell_words(option.choices)));
  else if (!option.value.empty())
    rest += " -r";
  return line(condition, rest.substr(1) + " -d " + fish_quoted(option.purpose));
}

/// Choices of an argument are offered until one is given.
std::string argument_line(const std::string& condition, const OptionText& argument) {
  if (argument.choices.empty()) return "";
  const std::string choices = shell_words(argument.choices);
  return line(condition + "; and not __fish_seen_subcommand_from " + choices,
              "-f -a " + fish_quoted(choices) + " -d " + fish_quoted(argument.purpose));
}

}  // namespace

std::string fish_completion(const ProgramText& text) {
  const std::string no_command = "__fish_use_subcommand";
  std::string script = "# Completions of veldt for fish, made from the program's table of commands.\n";
  std::string names;
  for (const OptionText& option : text.program.options) script += option_line(no_command, option);
  for (const CommandText& command : text.commands) {
    names += command.name + " ";
    script += line(no_command, "-f -a " + command.name + " -d " + fish_quoted(command.purpose));
  }
  script += line(no_command, "-f -a help -d 'Help, also of a command'");
  script += line("__fish_seen_subcommand_from help", "-f -a " + fish_quoted(names));
  for (const CommandText& command : text.commands) {
    const std::string condition = "__fish_seen_subcommand_from " + command.name;
    for (const OptionText& option : command.options) script += option_line(condition, option);
    for (const OptionText& argument : command.arguments) script += argument_line(condition, argument);
  }
  return script;
}

}  // namespace veldt
