#include "io/system/child_process.h"

#include <csignal>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/patience.h"
#include "support/test_folder.h"

namespace child_process_test {

using namespace thermal;

namespace {

std::vector<std::string> shell(const std::string& script) { return {"/bin/sh", "-c", script}; }

/// Every line a program reports until it closes the channel.
std::vector<std::string> lines_of(ChildProcess& child) {
  std::vector<std::string> lines;
  while (!child.ended()) {
    if (auto line = child.next_line(kPatienceMs)) lines.push_back(*line);
  }
  return lines;
}

bool is_running(const std::string& process) { return std::filesystem::exists("/proc/" + process + "/exe"); }

}  // namespace

TEST_CASE("A program reports line by line on its channel") {
  const TestFolder folder;
  ChildProcess child(shell("echo one >&3; echo >&3; printf 'two\\nthree\\n' >&3"), folder / "log");
  CHECK(lines_of(child) == std::vector<std::string>{"one", "", "two", "three"});
  CHECK(child.wait().code == 0);
}

TEST_CASE("What a program prints goes to its log, both streams") {
  const TestFolder folder;
  ChildProcess child(shell("echo out; echo error >&2; cat"), folder / "log");  // cat: the input is empty
  (void)child.wait();
  CHECK(read_file(folder / "log") == "out\nerror\n");
}

TEST_CASE("A log that is there is added to") {
  const TestFolder folder;
  const Path log = folder.file("log", "first\n");
  ChildProcess child(shell("echo second"), log);
  (void)child.wait();
  CHECK(read_file(log) == "first\nsecond\n");
}

TEST_CASE("How a program ended is put into words") {
  const TestFolder folder;
  ChildProcess failing(shell("exit 7"), folder / "log");
  CHECK(failing.wait().in_words() == "ended with exit code 7");
  CHECK(failing.wait().code == 7);  // and again
  ChildProcess dying(shell("kill -9 $$"), folder / "log");
  CHECK(dying.wait().in_words() == "was killed by signal 9 (Killed)");
}

TEST_CASE("A program that cannot be run ends like a shell's") {
  const TestFolder folder;
  ChildProcess child({"/nowhere/blender"}, folder / "log");
  CHECK(child.wait().code == 127);
}

TEST_CASE("A log that cannot be written is a fault") {
  CHECK(message_of<IoError>([] { const ChildProcess child(shell("true"), "/nowhere/log"); }) ==
        "cannot open /nowhere/log: No such file or directory");
}

TEST_CASE("An incomplete line, from a program that was killed while writing it, is dropped") {
  const TestFolder folder;
  ChildProcess child(shell("printf 'whole\\nhal' >&3; kill -9 $$"), folder / "log");
  CHECK(lines_of(child) == std::vector<std::string>{"whole"});
  CHECK(child.wait().signal == SIGKILL);
}

TEST_CASE("Many lines, and long ones, come through whole") {
  const TestFolder folder;
  ChildProcess child(shell("i=0; while [ $i -lt 2000 ]; do echo $i >&3; i=$((i+1)); done; "
                           "head -c 100000 /dev/zero | tr '\\0' x >&3; echo >&3"),
                     folder / "log");
  const std::vector<std::string> lines = lines_of(child);
  REQUIRE(lines.size() == 2001);
  CHECK(lines[1999] == "1999");
  CHECK(lines[2000] == std::string(100000, 'x'));
}

TEST_CASE("Waiting for a line ends after the time given") {
  const TestFolder folder;
  ChildProcess child(shell("sleep 3600"), folder / "log");
  CHECK_FALSE(child.next_line(20).has_value());
  CHECK_FALSE(child.ended());
}

TEST_CASE("Stopping ends the program and what it started") {
  const TestFolder folder;
  ChildProcess child(shell("sleep 3600 & echo $! >&3; wait"), folder / "log");
  const std::string grandchild = child.next_line(kPatienceMs).value_or("none");
  REQUIRE(is_running(grandchild));
  child.stop();
  CHECK(child.wait().signal == SIGTERM);
  CHECK(wait_until([&] { return !is_running(grandchild); }));  // init reaps it some time later
}

TEST_CASE("A program that will not end when asked is killed") {
  const TestFolder folder;
  ChildProcess child(shell("trap '' TERM; echo ready >&3; while :; do sleep 1; done"), folder / "log");
  REQUIRE(child.next_line(kPatienceMs) == "ready");
  child.stop();
  CHECK(child.wait().signal == SIGKILL);
}

TEST_CASE("A program does not outlive the process that started it") {
  const TestFolder folder;
  std::string process;
  {
    ChildProcess child(shell("echo $$ >&3; exec sleep 3600"), folder / "log");
    process = child.next_line(kPatienceMs).value_or("none");
    REQUIRE(is_running(process));
  }
  CHECK_FALSE(is_running(process));
}

TEST_CASE("run_program returns both streams and the exit code") {
  const Output output = run_program(shell("echo out; echo error >&2; exit 3"));
  CHECK(output.out == "out\n");
  CHECK(output.error == "error\n");
  CHECK(output.status.code == 3);
}

TEST_CASE("run_program hands on its input, of any length") {
  CHECK(run_program(shell("wc -c"), std::string(300000, 'a')).out == "300000\n");
  CHECK(run_program(shell("cat"), "text").out == "text");
  CHECK(run_program(shell("cat")).out.empty());
}

TEST_CASE("run_program takes more output than a pipe holds, on both streams at once") {
  const Output output =
      run_program(shell("head -c 300000 /dev/zero | tr '\\0' a & "
                        "head -c 300000 /dev/zero | tr '\\0' b >&2; wait"));
  CHECK(output.out == std::string(300000, 'a'));
  CHECK(output.error == std::string(300000, 'b'));
}

TEST_CASE("run_program passes on the lines of the event channel while the program runs") {
  std::vector<std::string> lines;
  const Output output = run_program(shell("echo one >&3; echo two >&3; echo out; printf half >&3"), {},
                                    [&lines](const std::string& line) { lines.push_back(line); });
  CHECK(lines == std::vector<std::string>{"one", "two"});
  CHECK(output.out == "out\n");
  CHECK(run_program(shell("echo one >&3")).status.code != 0);  // without a listener there is no channel
}

TEST_CASE("run_program reports programs that are killed or cannot be run") {
  CHECK(run_program(shell("kill -15 $$")).status.in_words() == "was killed by signal 15 (Terminated)");
  CHECK(run_program({"/nowhere/python3"}).status.code == 127);
}

TEST_CASE("run_program does not wait for what a killed program has started, and ends it") {
  std::string grandchild;
  const Output output = run_program(shell("sleep 3600 & echo $! >&3; kill -9 $$"), {},
                                    [&grandchild](const std::string& line) { grandchild = line; });
  CHECK(output.status.signal == SIGKILL);
  CHECK(wait_until([&] { return !is_running(grandchild); }));  // init reaps it some time later
}

TEST_CASE("run_program ends what a program leaves running without its streams") {
  const Output output = run_program(shell("sleep 3600 >/dev/null 2>&1 & echo $!"));
  const std::string grandchild = output.out.substr(0, output.out.find('\n'));
  CHECK(wait_until([&] { return !is_running(grandchild); }));
}

TEST_CASE("The reason of a program's failure is the last line of its output that is not empty") {
  CHECK(run_program(shell("printf 'first\\nlast\\n\\n' >&2")).last_error_line() == "last");
  CHECK(run_program(shell("echo out")).last_error_line().empty());
}

}  // namespace child_process_test
