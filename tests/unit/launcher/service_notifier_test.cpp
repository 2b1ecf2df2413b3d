#include "launcher/service_notifier.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <utility>

#include "launcher/file_descriptor.hpp"
#include "launcher/unix_socket.hpp"
#include "support/temporary_folder.hpp"

namespace coop::launcher {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Stands for systemd: a datagram socket, and a clock that only the test moves.
class ServiceNotifierTest : public ::testing::Test {
 protected:
  ServiceNotifierTest() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    const std::string path = (folder_.path() / "notify").string();
    const UnixAddress address(path);
    EXPECT_EQ(bind(socket_.get(), address.get(), address.size()), 0);
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
    setenv("WATCHDOG_USEC", "3000000", 1);
    unsetenv("WATCHDOG_PID");
  }
  ~ServiceNotifierTest() override {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
  }
  /// The first lines of what has come since the last call.
  std::vector<std::string> heard() {
    listen();
    return std::exchange(texts_, {});
  }
  void listen() {
    char buffer[512];
    for (ssize_t n = 0; (n = recv(socket_.get(), buffer, sizeof buffer, 0)) > 0;) {
      const std::string text(buffer, static_cast<std::size_t>(n));
      texts_.push_back(text.substr(0, text.find('\n')));
    }
  }
  /// Every half second, as the launcher's loop does.
  void run(ServiceNotifier& notifier, bool up, milliseconds time) {
    for (const Instant end = now_ + time; now_ < end; now_ += milliseconds(500)) {
      notifier.tick(up, now_);
      listen();  // the queue holds ten, then a sender waits
    }
  }
  test::TemporaryFolder folder_;
  FileDescriptor socket_;
  std::vector<std::string> texts_;
  Instant now_{seconds(1000)};
};

TEST_F(ServiceNotifierTest, ReadyIsSaidOnceWhenAllRequiredAreUp) {
  ServiceNotifier notifier(now_);
  notifier.tick(false, now_);
  EXPECT_THAT(heard(), ElementsAre("WATCHDOG=1"));
  notifier.tick(true, now_);
  notifier.tick(true, now_);
  EXPECT_THAT(heard(), ElementsAre("READY=1"));
}

TEST_F(ServiceNotifierTest, TheWatchdogIsFedThreeTimesWithinItsLimit) {
  ServiceNotifier notifier(now_);
  notifier.tick(true, now_);
  (void)heard();
  now_ += milliseconds(500);
  notifier.tick(true, now_);
  EXPECT_THAT(heard(), IsEmpty());
  now_ += milliseconds(500);
  notifier.tick(true, now_);
  EXPECT_THAT(heard(), ElementsAre("WATCHDOG=1"));
}

TEST_F(ServiceNotifierTest, ARequiredComponentMissingForTooLongStarvesTheWatchdog) {
  ServiceNotifier notifier(now_);
  notifier.tick(true, now_);
  run(notifier, false, ServiceNotifier::kPatience);
  EXPECT_FALSE(heard().empty()) << "a restart takes its time";
  run(notifier, false, seconds(2));
  (void)heard();
  run(notifier, false, seconds(30));
  EXPECT_THAT(heard(), IsEmpty());
  run(notifier, true, seconds(1));
  EXPECT_THAT(heard(), ElementsAre("WATCHDOG=1")) << "back in time";
}

TEST_F(ServiceNotifierTest, BeforeTheFirstReadyAndWhileStoppingTheWatchdogIsFed) {
  ServiceNotifier notifier(now_);
  run(notifier, false, seconds(100));
  (void)heard();
  run(notifier, false, seconds(2));
  EXPECT_FALSE(heard().empty());
  notifier.tick(true, now_);
  notifier.stopping();
  notifier.stopping();
  EXPECT_THAT(heard(), ::testing::Contains("STOPPING=1").Times(1));
  run(notifier, false, seconds(100));
  (void)heard();
  run(notifier, false, seconds(2));
  EXPECT_FALSE(heard().empty());
}

}  // namespace
}  // namespace coop::launcher
