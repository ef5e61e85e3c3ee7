#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace veldt {

/// An option or an argument, as help, manual and completions show it.
struct OptionText {
  std::vector<std::string> names;             ///< "-h", "--help"; of an argument: "config"
  std::string purpose;                        ///< one line, without a full stop at its end
  std::string value;                          ///< what to put there, such as "DIR"; empty: nothing
  std::vector<std::string> choices;           ///< all values there are; empty: any
  std::string bounds;                         ///< "1 to 64"; empty: none, or none that help knows
  std::string default_value;                  ///< empty: none
  std::vector<std::string> excluded, needed;  ///< names of options that it excludes and needs
  bool required = false;
  bool repeated = false;  ///< takes several values
};

/// The program, or one of its commands.
struct CommandText {
  std::string name;                   ///< "veldt", or "generate"
  std::string purpose;                ///< one line, without a full stop at its end
  std::vector<std::string> remarks;   ///< paragraphs
  std::vector<std::string> examples;  ///< command lines
  std::vector<OptionText> arguments, options;
};

struct ProgramText {
  CommandText program;
  std::vector<CommandText> commands;  ///< in the order that help shows them
};

/// All that a parser says about itself, after add_commands().
[[nodiscard]] ProgramText read_texts(const CLI::App& app);

/// Words as bash, zsh and fish read them in a list: "a b\ c". Of what they treat in a special way, words may have blanks.
[[nodiscard]] std::string shell_words(const std::vector<std::string>& words);

}  // namespace veldt
