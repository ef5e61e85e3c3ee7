#include <cstdio>
#include <exception>
#include <string>

#include "base/error.h"
#include "base/version.h"
#include "cli/command.h"
#include "cli/manual/command_texts.h"
#include "cli/manual/completions.h"
#include "cli/manual/man_page.h"
#include "io/system/files.h"

namespace {

void write(const thermal::Path& file, const std::string& text) {
  thermal::make_folder(file.parent_path());
  thermal::write_file_atomically(file, text);
}

/// Where Debian's man, bash, zsh and fish look for them below share/.
void write_manual(const thermal::Path& share) {
  CLI::App app;
  veldt::Session session;
  veldt::add_commands(app, session);
  const veldt::ProgramText text = veldt::read_texts(app);
  const auto write_page = [&](const veldt::CommandText& command) {
    write(share / "man/man1" / (veldt::page_name(text, command) + ".1"),
          veldt::man_page(text, command, std::string(thermal::kVersion)));
  };
  write_page(text.program);
  for (const veldt::CommandText& command : text.commands) write_page(command);
  write(share / "bash-completion/completions/veldt", veldt::bash_completion(text));
  write(share / "zsh/_veldt", veldt::zsh_completion(text));
  write(share / "fish/vendor_completions.d/veldt.fish", veldt::fish_completion(text));
}

}  // namespace

/// usage: veldt_manual FOLDER; a step of the build.
int main(int argc, char** argv) {
  try {
    if (argc != 2) throw thermal::Error("usage: veldt_manual FOLDER");
    write_manual(argv[1]);
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "veldt_manual: %s\n", error.what());
    return veldt::kFailed;
  }
  return veldt::kDone;
}
