#include "cli/manual/write_manual.h"

#include <string>

#include <CLI/CLI.hpp>

#include "base/version.h"
#include "cli/command.h"
#include "cli/manual/command_texts.h"
#include "cli/manual/completions.h"
#include "cli/manual/man_page.h"
#include "io/system/files.h"

namespace veldt {
namespace {

void write_text(const thermal::Path& file, const std::string& text) {
  thermal::make_folder(file.parent_path());
  thermal::write_file_atomically(file, text);
}

}  // namespace

void write_manual(const char* share) {
  CLI::App app;
  Session session;
  add_commands(app, session);
  const ProgramText text = read_texts(app);
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

}  // namespace veldt
