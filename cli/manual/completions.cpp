#include "cli/manual/completions.h"

#include <algorithm>

#include <fmt/format.h>

namespace veldt {
namespace {

/// {0}: words instead of a command; {1}: commands; {2}: cases of options with a value, and of choices before them;
/// {3}: cases of arguments with a choice; {4}: cases of the options of commands. An empty answer means files. Bash splits
/// --option=value at the sign.
constexpr const char* kBash = R"(# Completions of veldt for bash, made from the program's table of commands.
_veldt() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} command=${{COMP_WORDS[1]}}
  local choice choices=()
  COMPREPLY=()
  [[ $previous != "=" ]] || previous=${{COMP_WORDS[COMP_CWORD - 2]}}
  [[ $word != "=" ]] || word=
  if ((COMP_CWORD == 1)); then
    choices=({0})
  else
    case $command:$previous in
      help:*) choices=({1}) ;;
{2}      *)
        if [[ $word == -* ]]; then
          case $command in
{4}          esac
        else
          case $command in
{3}          esac
        fi
        ;;
    esac
  fi
  for choice in "${{choices[@]}}"; do
    printf -v choice %q "$choice"
    [[ $choice != "$word"* ]] || COMPREPLY+=("$choice")
  done
}}
complete -o bashdefault -o default -F _veldt veldt
)";

std::string case_of_values(const CommandText& command) {
  std::string cases;
  std::vector<std::string> free;
  for (const OptionText& option : command.options) {
    if (option.value.empty()) continue;
    for (const std::string& name : option.names) {
      if (option.choices.empty())
        free.push_back(command.name + ":" + name);
      else
        cases +=
            fmt::format("      {}:{}) choices=({}) ;;\n", command.name, name, shell_words(option.choices));
    }
  }
  return free.empty() ? cases : cases + fmt::format("      {}) return ;;\n", fmt::join(free, " | "));
}

/// Choices of an argument are offered until one is given.
std::string case_of_arguments(const CommandText& command) {
  std::string cases;
  for (const OptionText& argument : command.arguments) {
    if (argument.choices.empty()) continue;
    cases += fmt::format(
        "            {})\n"
        "              [[ \" ${{COMP_WORDS[*]:2:COMP_CWORD-2}} \" =~ \\ ({})\\  ]] || choices=({})\n"
        "              ;;\n",
        command.name, fmt::join(argument.choices, "|"), shell_words(argument.choices));
  }
  return cases;
}

std::vector<std::string> option_names(const CommandText& command) {
  std::vector<std::string> names;
  for (const OptionText& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

}  // namespace

std::string bash_completion(const ProgramText& text) {
  std::vector<std::string> commands;
  std::string values;
  std::string arguments;
  std::string options;
  for (const CommandText& command : text.commands) {
    commands.push_back(command.name);
    values += case_of_values(command);
    arguments += case_of_arguments(command);
    options +=
        fmt::format("            {}) choices=({}) ;;\n", command.name, shell_words(option_names(command)));
  }
  return fmt::format(kBash, shell_words(commands) + " help " + shell_words(option_names(text.program)),
                     shell_words(commands), values, arguments, options);
}

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
