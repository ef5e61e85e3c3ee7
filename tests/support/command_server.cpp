/// Runs command lines for tests without starting a program for each: this one has loaded the libraries, and a forked
/// child runs the command as a function. That takes a twentieth of the time; each run still has a process of its own.
///
/// Standard input has a JSON object a line: {"arguments": […], "environment": {…}, "folder": …, "out": …, "err": …},
/// the last three being paths. The answer is a line with the exit code, or the negative number of a signal.

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/program.h"
#include "io/json/file.h"

namespace {

using thermal::Json;

void connect(int descriptor, const std::string& file, int flags) {
  const int opened = open(file.c_str(), flags | O_CLOEXEC);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

void set_environment(const Json& variables) {
  clearenv();
  for (const auto& [name, value] : variables.items())
    setenv(name.c_str(), value.get<std::string>().c_str(), 1);
}

[[noreturn]] void run(const Json& order) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  connect(STDIN_FILENO, "/dev/null", O_RDONLY);
  connect(STDOUT_FILENO, order.at("out").get<std::string>(), O_WRONLY);
  connect(STDERR_FILENO, order.at("err").get<std::string>(), O_WRONLY);
  if (chdir(order.at("folder").get<std::string>().c_str()) != 0) _exit(126);
  set_environment(order.at("environment"));
  const auto arguments = order.at("arguments").get<std::vector<std::string>>();
  std::vector<const char*> words = {"veldt"};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  std::exit(veldt::run_program(static_cast<int>(words.size()), words.data()));
}

int run_apart(const Json& order) {
  const pid_t child = fork();
  if (child == 0) run(order);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) return 125;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    std::printf("%d\n", run_apart(thermal::parse_json(line, "order")));
    (void)std::fflush(stdout);
  }
  return 0;
}
