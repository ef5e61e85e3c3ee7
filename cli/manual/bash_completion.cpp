#include <fmt/format.h>

#include "cli/manual/completions.h"

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

}  // namespace veldt
