// Coop as a service of the machine: the unit file, and what the launcher tells systemd.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <iostream>

#include "core/atomic_file.hpp"
#include "launcher/unix_socket.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = COOP_SOURCE_DIR;
const fs::path kAnalyze = "/usr/bin/systemd-analyze";

/// Of systemd's scale from 0 (shut away) to 10 (open). What is left: network and serial devices.
constexpr double kMostExposure = 1.5;

class UnitFile : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kAnalyze)) GTEST_SKIP() << "not run: no systemd-analyze (Debian: systemd)";
    std::string text = read_file(kSource / "systemd/coop@.service");
    // The launcher of this build stands for the installed one.
    const std::string installed = "/usr/lib/coop/launcher";
    const std::size_t at = text.find("ExecStart=" + installed);
    ASSERT_NE(at, std::string::npos);
    text.replace(at + 10, installed.size(), COOP_BIN_DIR "/launcher");
    write_file_atomically(unit(), text);
  }
  [[nodiscard]] fs::path unit() const { return folder_.path() / "coop@sim.service"; }
  std::string analyze(std::vector<std::string> arguments) const {
    arguments.push_back(unit().string());
    Program program(kAnalyze.string(), arguments, folder_.path() / "output");
    const auto status = program.wait();
    EXPECT_TRUE(status && status->clean()) << program.output();
    return program.output();
  }
  TemporaryFolder folder_;
};

TEST_F(UnitFile, IsAcceptedWithoutAWord) {
  EXPECT_EQ(analyze({"verify", "--man=no"}), "");
}

TEST_F(UnitFile, LeavesTheServiceLittleOfTheMachine) {
  const std::string text = analyze({"security", "--offline=yes", "--no-pager"});
  const std::string mark = "exposure level for coop@sim.service: ";
  const std::size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos) << text;
  const double exposure = std::stod(text.substr(at + mark.size()));
  std::cout << "exposure: " << exposure << '\n';
  EXPECT_LE(exposure, kMostExposure) << text;
}

/// Stands for systemd.
class NotifySocket {
 public:
  explicit NotifySocket(const fs::path& path)
      : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    const launcher::UnixAddress address(path.string());
    if (bind(socket_.get(), address.get(), address.size()) != 0) throw std::runtime_error("bind");
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
    setenv("WATCHDOG_USEC", "3000000", 1);  // fed once a second: the socket's queue holds ten
  }
  ~NotifySocket() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
  }
  /// How often a text has come, until now.
  int count(const std::string& text) {
    char buffer[512];
    for (ssize_t n = 0; (n = recv(socket_.get(), buffer, sizeof buffer, 0)) > 0;) {
      heard_.emplace_back(buffer, static_cast<std::size_t>(n));
    }
    return static_cast<int>(std::ranges::count_if(
        heard_, [&](const auto& line) { return line.find(text) != std::string::npos; }));
  }

 private:
  launcher::FileDescriptor socket_;
  std::vector<std::string> heard_;
};

TEST(Service, LauncherTellsSystemdThatItIsReadyFedAndStopping) {
  const TemporaryFolder folder;
  NotifySocket systemd(folder.path() / "notify");
  RunningSystem system(kSource / "config/launch/sim.yaml");
  ASSERT_TRUE(wait_until([&] { return systemd.count("READY=1") == 1; }));
  const int fed = systemd.count("WATCHDOG=1");
  EXPECT_TRUE(wait_until([&] { return systemd.count("WATCHDOG=1") > fed + 1; }));
  system.launcher().signal(SIGSTOP);
  wait_until([] { return false; }, milliseconds(300));  // what was on its way has arrived
  const int before = systemd.count("WATCHDOG=1");
  wait_until([] { return false; }, milliseconds(2500));
  EXPECT_EQ(systemd.count("WATCHDOG=1"), before) << "a launcher that hangs feeds no watchdog";
  system.launcher().signal(SIGCONT);
  const auto status = system.stop();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, 0);
  EXPECT_EQ(systemd.count("STOPPING=1"), 1);
}

}  // namespace
}  // namespace coop::test
