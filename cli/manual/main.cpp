#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/version.h"
#include "cli/command.h"
#include "cli/manual/command_texts.h"
#include "cli/manual/completions.h"
#include "io/system/files.h"

namespace veldt {
namespace {

/// File name of a command's page, without ".1": "veldt-generate"; the program's is "veldt".
[[nodiscard]] std::string page_name(const ProgramText& text, const CommandText& command);

/// Sections on environment variables and files.
constexpr const char* kSurroundings = R"(.SH ENVIRONMENT
.TP
.B VELDT_HOME
Folder with assets, blender_scripts and configs, instead of the one below FILES.
.TP
.B VELDT_PYTHON
Python that plans scenes, instead of /usr/bin/python3; it needs NumPy.
.SH FILES
.TP
.I ../share/veldt
As seen from the folder of the program, such as /usr/share/veldt: species, materials, cameras and their sources
.RI ( assets ),
configs to start from and their schemas
.RI ( configs ),
and the scripts that plan and render
.RI ( blender_scripts ).
)";

constexpr const char* kStopped = R"(.TP
.B 130
stopped with Ctrl\-C, or 128 + N with signal N; the same command again resumes
)";

void append_utf8(std::string& roff, std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  unsigned code = byte(0) & (0xFFU >> (character.size() + 1));
  for (std::size_t i = 1; i < character.size(); ++i) code = code << 6U | (byte(i) & 0x3FU);
  roff += fmt::format("\\[u{:04X}]", code);
}

/// `text` (UTF-8, one line) escaped for roff. Hyphens are ASCII's, so that options can be copied.
std::string roff(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (lead >= 0xC0) {
      const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
      append_utf8(escaped, text.substr(i, size));
      i += size - 1;
    } else if (text[i] == '-') {
      escaped += "\\-";
    } else if (text[i] == '\\') {
      escaped += "\\e";
    } else if (text[i] == '\'') {
      escaped += "\\(aq";
    } else if (i == 0 && text[i] == '.') {
      escaped += "\\&.";
    } else {
      escaped += text[i];
    }
  }
  return escaped;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

/// With a small first letter, for the middle of a sentence; "HTML" is unchanged.
std::string uncapitalised(std::string text) {
  if (text.size() > 1 && std::isupper(static_cast<unsigned char>(text[1])) == 0)
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string upper_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// "a, b", each formatted by `form`.
template <typename Form>
std::string listed(const std::vector<std::string>& names, Form form) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + form(name);
  return text;
}

bool is_argument(const OptionText& option) { return !option.names.front().starts_with('-'); }

/// "--out DIR", or "passes ..." for an argument.
std::string usage(const OptionText& option) {
  if (is_argument(option)) return italic(option.names.front()) + (option.repeated ? " ..." : "");
  return listed(option.names, bold) + (option.value.empty() ? "" : " " + italic(option.value));
}

/// Description of an option, then of its values.
std::string explanation(const OptionText& option) {
  std::string text = roff(option.purpose) + ".";
  if (option.required && !is_argument(option)) text += " Required.";
  if (!option.choices.empty()) text += " One of " + listed(option.choices, bold) + ".";
  if (!option.bounds.empty()) text += " From " + roff(option.bounds) + ".";
  if (!option.default_value.empty()) text += " Default: " + bold(option.default_value) + ".";
  if (option.repeated) text += " Takes several values.";
  if (!option.needed.empty()) text += " Needs " + listed(option.needed, bold) + ".";
  if (!option.excluded.empty()) text += " Excludes " + listed(option.excluded, bold) + ".";
  return text;
}

std::string entry(const std::string& heading, const std::string& body) {
  return ".TP\n" + heading + "\n" + body + "\n";
}

std::string synopsis(const ProgramText& text, const CommandText& command) {
  if (&command == &text.program)
    return bold("veldt") + " " + italic("COMMAND") + " [" + italic("OPTIONS") + "]";
  std::string line = bold("veldt " + command.name);
  for (const OptionText& argument : command.arguments)
    line += argument.required ? " " + usage(argument) : " [" + usage(argument) + "]";
  for (const OptionText& option : command.options)
    if (option.required) line += " " + usage(option);
  return line + " [" + italic("OPTIONS") + "]";
}

std::string description(const CommandText& command) {
  std::string page = ".SH DESCRIPTION\n" + roff(command.purpose) + ".\n";
  for (const std::string& remark : command.remarks) page += ".PP\n" + roff(remark) + "\n";
  return page;
}

std::string section_of(const std::string& heading, const std::vector<OptionText>& options) {
  std::string page;
  for (const OptionText& option : options) page += entry(usage(option), explanation(option));
  return page.empty() ? "" : ".SH " + heading + "\n" + page;
}

std::string commands(const ProgramText& text) {
  std::string page = ".SH COMMANDS\n";
  for (const CommandText& command : text.commands)
    page +=
        entry(bold(command.name), roff(command.purpose) + ". See " + bold(page_name(text, command)) + "(1).");
  return page;
}

std::string exit_status() {
  std::string page = ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : kExitMeanings) page += entry(bold(std::to_string(code)), roff(meaning));
  return page + kStopped;
}

/// Whether a command's texts name another: "veldt convert".
bool is_named(const CommandText& other, const CommandText& command) {
  const auto names = [&](const std::string& text) {
    return text.find("veldt " + other.name) != std::string::npos;
  };
  return std::ranges::any_of(command.options, names, &OptionText::purpose) ||
         std::ranges::any_of(command.arguments, names, &OptionText::purpose) ||
         std::ranges::any_of(command.remarks, names) || names(command.purpose);
}

std::string examples(const CommandText& command) {
  std::string page;
  for (const std::string& example : command.examples) page += ".PP\n" + bold(example) + "\n";
  return page.empty() ? "" : ".SH EXAMPLES\n" + page;
}

std::string see_also(const ProgramText& text, const CommandText& command) {
  const bool is_program = &command == &text.program;
  std::vector<std::string> pages;
  if (!is_program) pages.emplace_back("veldt");
  for (const CommandText& other : text.commands)
    if (is_program || (&other != &command && is_named(other, command)))
      pages.push_back(page_name(text, other));
  return ".SH SEE ALSO\n" + listed(pages, [](const std::string& page) { return bold(page) + "(1)"; }) + "\n";
}

std::string page_name(const ProgramText& text, const CommandText& command) {
  return &command == &text.program ? "veldt" : "veldt-" + command.name;
}

/// A page of section 1 in roff, with macros of man(7) for groff and mandoc, for a command or the program. `version` is
/// in its footer; it has no date, so that pages are reproducible.
/// @param command  text.program or one of text.commands
std::string man_page(const ProgramText& text, const CommandText& command, const std::string& version) {
  const std::string name = page_name(text, command);
  return fmt::format(".TH {} 1 \"\" \"veldt {}\" \"Veldt\"\n", roff(upper_case(name)), version) +
         ".SH NAME\n" + roff(name) + " \\- " + roff(uncapitalised(command.purpose)) + "\n" +
         ".SH SYNOPSIS\n" + synopsis(text, command) + "\n" + description(command) +
         section_of("ARGUMENTS", command.arguments) + (&command == &text.program ? commands(text) : "") +
         section_of("OPTIONS", command.options) + exit_status() + kSurroundings + examples(command) +
         see_also(text, command);
}

void write_text(const thermal::Path& file, const std::string& text) {
  thermal::make_folder(file.parent_path());
  thermal::write_file_atomically(file, text);
}

/// Writes manual pages and completions into a folder, in the subfolders of share/ that Debian's man, bash, zsh and fish
/// use. Throws exceptions on failure.
void write_manual(const char* share) {
  const ProgramText text = read_texts(make_parser()->app());
  const thermal::Path folder = share;
  const auto write_page = [&](const CommandText& command) {
    write_text(folder / "man/man1" / (page_name(text, command) + ".1"),
               man_page(text, command, std::string(thermal::kVersion)));
  };
  write_page(text.program);
  for (const CommandText& command : text.commands) write_page(command);
  write_text(folder / "bash-completion/completions/veldt", bash_completion(text));
  write_text(folder / "zsh/_veldt", zsh_completion(text));
  write_text(folder / "fish/vendor_completions.d/veldt.fish", fish_completion(text));
}

}  // namespace

}  // namespace veldt

/// Usage: veldt_manual FOLDER; a build step.
int main(int argc, char** argv) {
  if (argc != 2) {
    (void)std::fputs("usage: veldt_manual FOLDER\n", stderr);
    return 1;
  }
  try {
    veldt::write_manual(argv[1]);
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "veldt_manual: %s\n", error.what());
    return 1;
  }
  return 0;
}
