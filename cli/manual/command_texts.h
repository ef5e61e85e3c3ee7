#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library has it so
class App;
}

namespace veldt {

/// An option or an argument, for help, manual and completions.
struct OptionText {
  std::vector<std::string> names;             ///< "-h", "--help"; of an argument: "config"
  std::string purpose;                        ///< one line, without a full stop at its end
  std::string value;                          ///< placeholder of the value, such as "DIR"; empty: no value
  std::vector<std::string> choices;           ///< all valid values; empty: any
  std::string bounds;                         ///< "1 to 64"; empty: none, or unknown
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

/// Texts of make_parser().app().
[[nodiscard]] ProgramText read_texts(const CLI::App& app);

/// Words for a list in bash, zsh and fish: "a b\ c". Blanks are the only special characters allowed in words.
[[nodiscard]] std::string shell_words(const std::vector<std::string>& words);

}  // namespace veldt
