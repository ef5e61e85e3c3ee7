#include "cli/manual/command_texts.h"

#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/text.h"
#include "cli/command.h"

namespace veldt {
namespace {

/// Replaces line breaks by blanks.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

/// Parses the text after the options. A line break after a full stop begins a paragraph.
void read_footer(const std::string& footer, CommandText& text) {
  const std::string example = "Example: ";
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(example))
      text.examples.push_back(line.substr(example.size()));
    else if (text.remarks.empty() || text.remarks.back().ends_with('.'))
      text.remarks.push_back(line);
    else
      text.remarks.back() += " " + line;
  }
}

std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);  // the set is ordered by addresses
  return names;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  if (option.get_positional()) return {option.get_single_name()};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The text from `begin` to the closing bracket at the end of a type.
std::string inside(const std::string& type, std::size_t begin) {
  return type.substr(begin, type.size() - 1 - begin);
}

/// The elements of a set, which commas without a blank separate.
std::vector<std::string> elements_of(const std::string& set) {
  std::vector<std::string> elements;
  for (const std::string_view part : thermal::split(set, ',')) {
    if (part.starts_with(' '))
      elements.back() += "," + std::string(part);
    else
      elements.emplace_back(part);
  }
  return elements;
}

/// Parses the type of an option: "TEXT:{a,b}" has choices, "INT:INT in [1 - 64]" bounds.
void read_type(const std::string& type, OptionText& text) {
  const std::size_t set = type.find(":{");
  const std::size_t range = type.find(" in [");
  if (set != std::string::npos) {
    text.value = type.substr(0, set);
    text.choices = elements_of(inside(type, set + 2));
  } else if (range != std::string::npos) {
    text.value = type.substr(0, type.find(':'));
    text.bounds = inside(type, range + 5);
    text.bounds.replace(text.bounds.find(" - "), 3, " to ");
  } else {
    text.value = type;
  }
}

OptionText text_of(const CLI::Option& option) {
  OptionText text = {.names = names_of(option),
                     .purpose = one_line(option.get_description()),
                     .value = "",
                     .choices = {},
                     .bounds = "",
                     .default_value = option.get_default_str(),
                     .excluded = names_of(option.get_excludes()),
                     .needed = names_of(option.get_needs()),
                     .required = option.get_required(),
                     .repeated = false};
  if (option.get_items_expected_max() == 0) return text;  // a flag
  text.repeated = option.get_expected_max() > 1;
  read_type(option.get_type_name(), text);
  return text;
}

CommandText text_of(const CLI::App& app) {
  CommandText text = {.name = app.get_name(),
                      .purpose = one_line(app.get_description()),
                      .remarks = {},
                      .examples = {},
                      .arguments = {},
                      .options = {}};
  read_footer(app.get_footer(), text);
  for (const CLI::Option* option : app.get_options({}))
    (option->get_positional() ? text.arguments : text.options).push_back(text_of(*option));
  return text;
}

}  // namespace

std::string shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    line += line.empty() ? "" : " ";
    for (const char c : word) line += c == ' ' ? std::string("\\ ") : std::string(1, c);
  }
  return line;
}

ProgramText read_texts(const CLI::App& app) {
  ProgramText text = {.program = text_of(app), .commands = {}};
  text.program.purpose = kPurpose;
  for (const CLI::App* command : app.get_subcommands({})) text.commands.push_back(text_of(*command));
  return text;
}

}  // namespace veldt
