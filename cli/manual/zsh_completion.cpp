#include <algorithm>

#include <fmt/format.h>

#include "cli/manual/completions.h"

namespace veldt {
namespace {

/// {0}: specifications of the program's own options; {1}: commands; {2}: a case for each command.
constexpr const char* kZsh = R"(#compdef veldt
# Completions of veldt for zsh, made from the program's table of commands.
_veldt() {{
  local curcontext=$curcontext context state state_descr line
  typeset -A opt_args
  _arguments -C{0} \
    '1:command:->command' \
    '*::argument:->argument'
  case $state in
    command)
      local -a commands=({1}
      )
      _describe command commands
      ;;
    argument)
      case $words[1] in
{2}      esac
      ;;
  esac
}}
if [[ $funcstack[1] == _veldt ]]; then _veldt "$@"; else compdef _veldt veldt; fi
)";

/// Inside single quotes, with a backslash before each of `special`.
std::string zsh_quoted(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) result += '\\';
    result += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return result;
}

/// ":DIR:_files", ":NAME:(blender embree)", or nothing.
std::string action(const OptionText& option, const std::string& value) {
  if (value.empty()) return "";
  const std::string values = option.choices.empty() ? "_files" : "(" + shell_words(option.choices) + ")";
  return fmt::format(":{}:{}", zsh_quoted(value, "\\:"), values);
}

/// One specification per name, which excludes the others; a repeatable option excludes nothing.
std::string option_specification(const OptionText& option) {
  std::vector<std::string> barred = option.excluded;
  barred.insert(barred.end(), option.names.begin(), option.names.end());
  const std::string before = option.repeated ? "*" : fmt::format("({})", fmt::join(barred, " "));
  std::string specifications;
  for (const std::string& name : option.names)
    specifications +=
        fmt::format(" \\\n            '{}{}{}[{}]{}'", before, name, option.value.empty() ? "" : "=",
                    zsh_quoted(option.purpose, "\\[]:"), action(option, option.value));
  return specifications;
}

std::string argument_specification(const OptionText& argument) {
  return fmt::format(" \\\n            '{}{}'",
                     argument.repeated   ? "*"
                     : argument.required ? ""
                                         : ":",
                     action(argument, argument.names.front()));
}

std::string case_of(const CommandText& command) {
  std::string specifications;
  for (const OptionText& option : command.options) specifications += option_specification(option);
  for (const OptionText& argument : command.arguments) specifications += argument_specification(argument);
  return fmt::format("        {})\n          _arguments{}\n          ;;\n", command.name, specifications);
}

}  // namespace

std::string zsh_completion(const ProgramText& text) {
  std::string options;
  std::string commands;
  std::string cases;
  std::vector<std::string> names;
  for (const OptionText& option : text.program.options) options += option_specification(option);
  for (const CommandText& command : text.commands) {
    names.push_back(command.name);
    commands += fmt::format("\n        '{}:{}'", command.name, zsh_quoted(command.purpose, "\\:"));
    cases += case_of(command);
  }
  commands += "\n        'help:Help, also of a command'";
  cases +=
      fmt::format("        help)\n          _arguments ':command:({})'\n          ;;\n", shell_words(names));
  return fmt::format(kZsh, options, commands, cases);
}

}  // namespace veldt
