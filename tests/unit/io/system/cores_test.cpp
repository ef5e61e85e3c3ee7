#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/system/machine.h"
#include "support/catch.h"
#include "support/test_folder.h"

namespace cores_test {

using namespace thermal;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;  // names and contents

std::optional<double> limit_on(const Files& files) {
  const TestFolder root;
  for (const auto& [name, content] : files) {
    std::filesystem::create_directories((root / name).parent_path());
    (void)root.file(name, content);
  }
  return smallest_cpu_limit(root.path());
}

constexpr const char* kOwn = "proc/self/cgroup";

int usable(int affinity, std::optional<double> limit) {
  return Cores{.machine = 64, .affinity = affinity, .limit = limit}.usable();
}

}  // namespace

TEST_CASE("A quota and its period give the cores that a control group may keep busy") {
  CHECK(cpu_limit("150000 100000\n") == 1.5);
  CHECK(cpu_limit("5000 100000") == 0.05);
  CHECK(cpu_limit("400000\n 50000\n") == 8);
  CHECK(cpu_limit("-1\n 100000\n") == std::nullopt);
  for (const char* text :
       {"", "max 100000\n", "100000", "100000 0", "0 100000", "1e5 100000", "100000 100000 1",
        "100000 -100000", "99999999999999999999 1", "quota period", "100000,100000"}) {
    INFO(text);
    CHECK(cpu_limit(text) == std::nullopt);
  }
}

TEST_CASE("Of a process's groups, those of version 2 and of the controller cpu are taken") {
  const std::vector<CpuGroup> groups =
      cpu_groups("5:cpuset:/set\n4:cpu,cpuacct:/docker/ab:c\n1:name=systemd:/x\n0::/user.slice/run\n");
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].version == 1);
  CHECK(groups[0].path == "docker/ab:c");
  CHECK(groups[1].version == 2);
  CHECK(groups[1].path == "user.slice/run");
  CHECK(cpu_groups("0::/\n").at(0).path.empty());
  CHECK(cpu_groups("0::/../../other\n").at(0).path == "other");  // outside of the container's own
  for (const char* text : {"", "\n", "0", "0::", "::", "0::relative", "cpu", "\n\n:"}) {
    INFO(text);
    CHECK(cpu_groups(text).empty());
  }
}

TEST_CASE("The limit of a group of version 2") {
  CHECK(limit_on({{kOwn, "0::/\n"}, {"sys/fs/cgroup/cpu.max", "250000 100000\n"}}) == 2.5);
  CHECK(limit_on({{kOwn, "0::/a/b\n"}, {"sys/fs/cgroup/a/b/cpu.max", "50000 100000\n"}}) == 0.5);
  CHECK(limit_on({{kOwn, "0::/a\n"}, {"sys/fs/cgroup/a/cpu.max", "max 100000\n"}}) == std::nullopt);
}

TEST_CASE("The tightest of the groups around a process counts, and others do not") {
  const auto nested = [](const std::string& outer, const std::string& inner) {
    return limit_on({{kOwn, "0::/pod/box\n"},
                     {"sys/fs/cgroup/pod/cpu.max", outer},
                     {"sys/fs/cgroup/pod/box/cpu.max", inner},
                     {"sys/fs/cgroup/pod/box/in/cpu.max", "1000 100000\n"},
                     {"sys/fs/cgroup/other/cpu.max", "1000 100000\n"}});
  };
  CHECK(nested("200000 100000\n", "400000 100000\n") == 2);
  CHECK(nested("400000 100000\n", "300000 100000\n") == 3);
  CHECK(nested("200000 100000\n", "max 100000\n") == 2);
  CHECK(nested("max 100000\n", "300000 100000\n") == 3);
  CHECK(nested("max 100000\n", "max 100000\n") == std::nullopt);
}

TEST_CASE("The limit of a group of version 1, also where its path is that on the host") {
  const auto limit = [](const std::string& quota, const std::string& folder) {
    return limit_on({{kOwn, "3:cpu,cpuacct:/docker/abc\n0::/docker/abc\n"},
                     {"sys/fs/cgroup/cpu" + folder + "/cpu.cfs_quota_us", quota},
                     {"sys/fs/cgroup/cpu" + folder + "/cpu.cfs_period_us", "100000\n"}});
  };
  CHECK(limit("350000\n", "") == 3.5);
  CHECK(limit("350000\n", "/docker") == 3.5);
  CHECK(limit("350000\n", "/docker/abc") == 3.5);
  CHECK(limit("-1\n", "") == std::nullopt);
}

TEST_CASE("What is missing, damaged or no file is no limit") {
  CHECK(limit_on({}) == std::nullopt);
  CHECK(limit_on({{kOwn, "0::/\n"}}) == std::nullopt);
  CHECK(limit_on({{"sys/fs/cgroup/cpu.max", "100000 100000\n"}}) == std::nullopt);
  CHECK(limit_on({{kOwn, "0::/\n"},
                  {"sys/fs/cgroup/cpu.max",
                   "\x7f"
                   "ELF"}}) == std::nullopt);
  CHECK(limit_on({{kOwn, "0::/\n"}, {"sys/fs/cgroup/cpu.max/x", "1 1"}}) == std::nullopt);
  CHECK(limit_on({{kOwn, "0::/\n"}, {"sys/fs/cgroup/cpu.max", std::string(1 << 20, '1')}}) == std::nullopt);
  CHECK(limit_on({{kOwn, "3:cpu:/\n"}, {"sys/fs/cgroup/cpu/cpu.cfs_quota_us", "100000\n"}}) == std::nullopt);
}

TEST_CASE("Usable cores are those of affinity and limit, rounded up, and at least one") {
  CHECK(usable(8, std::nullopt) == 8);
  CHECK(usable(8, 2.0) == 2);
  CHECK(usable(8, 2.1) == 3);
  CHECK(usable(8, 0.05) == 1);
  CHECK(usable(2, 7.5) == 2);
  CHECK(usable(2, 1e18) == 2);
}

TEST_CASE("The cores of this machine") {
  const Cores cores = find_cores();
  CHECK(cores.usable() >= 1);
  CHECK(cores.usable() <= cores.affinity);
  CHECK(cores.affinity <= cores.machine);
}

}  // namespace cores_test
