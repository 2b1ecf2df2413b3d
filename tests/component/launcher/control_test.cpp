#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <thread>

#include "core/config/error.hpp"
#include "launcher/control_client.hpp"
#include "launcher/control_server.hpp"
#include "launcher/system_lock.hpp"
#include "launcher/unix_socket.hpp"
#include "support/temporary_folder.hpp"

namespace coop::launcher {
namespace {

using ::testing::HasSubstr;

/// Client and server of the control socket, the server's loop on a thread of its own.
class ControlTest : public ::testing::Test {
 protected:
  ControlTest() { setenv("COOP_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~ControlTest() override {
    done_ = true;
    if (thread_.joinable()) thread_.join();
  }
  void serve(const std::string& robot, int domain) {
    server_.emplace(loop_, robot, domain, [this](const ControlRequest& request) {
      ControlReply reply;
      reply.ok = request.verb == "ps";
      if (!reply.ok) reply.error = "refused " + request.verb + " " + request.name;
      reply.system.launcher = 42;
      ++requests_;
      return reply;
    });
    thread_ = std::thread([this] {
      while (!done_) {
        loop_.run_once(std::chrono::steady_clock::now() + std::chrono::milliseconds(20));
      }
    });
  }
  test::TemporaryFolder folder_;
  EventLoop loop_;
  std::optional<ControlServer> server_;
  std::atomic<bool> done_ = false;
  std::atomic<int> requests_ = 0;
  std::thread thread_;
};

TEST_F(ControlTest, QuestionsAreAnsweredAndRefusalsAreErrors) {
  serve("", 17);
  auto client = ControlClient::connect(17, std::nullopt);
  ASSERT_TRUE(client);
  for (int i = 0; i < 3; ++i) {
    const auto reply = client->ask({"ps", ""});
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->system.launcher, 42);
  }
  const auto refused = client->ask({"stop", "dwa"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), "refused stop dwa");
  EXPECT_EQ(requests_, 4);
}

TEST_F(ControlTest, AClientFindsTheOnlySystemAndTheOneItNames) {
  serve("ducky", 17);
  EXPECT_TRUE(ControlClient::connect(std::nullopt, std::nullopt));
  EXPECT_TRUE(ControlClient::connect(17, "ducky"));
  const auto absent = ControlClient::connect(18, std::nullopt);
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error(), "no system runs as domain 18; start one with `coop up FILE`");
  EXPECT_FALSE(ControlClient::connect(17, "goose"));
}

TEST_F(ControlTest, ASocketLeftByADeadLauncherIsReplacedAndNotAsked) {
  { const auto dead = listen_unix((folder_.path() / "17.sock").string()); }
  EXPECT_FALSE(ControlClient::connect(17, std::nullopt));
  serve("", 17);
  EXPECT_TRUE(ControlClient::connect(17, std::nullopt));
}

TEST_F(ControlTest, AFolderOthersMayWriteIsNotUsed) {
  chmod(folder_.path().c_str(), 0777);
  EXPECT_THROW(serve("", 17), config::Error);
}

TEST_F(ControlTest, TheEndOfTheLauncherIsSeen) {
  serve("", 17);
  auto client = ControlClient::connect(17, std::nullopt);
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->ask({"ps", ""}));
  done_ = true;
  thread_.join();
  server_.reset();
  EXPECT_TRUE(client->wait_for_end(std::chrono::seconds(10)));
  EXPECT_FALSE(client->ask({"ps", ""}));
}

TEST(SystemLockTest, OneHolderARobotAndDomain) {
  // A domain beyond those systems and tests use.
  auto lock = SystemLock::acquire("lock-test", 232);
  ASSERT_TRUE(lock);
  const auto second = SystemLock::acquire("lock-test", 232);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error(), HasSubstr("robot 'lock-test' on domain 232 is in use by another "
                                        "launcher, pid " +
                                        std::to_string(getpid())));
  EXPECT_TRUE(SystemLock::acquire("lock-test-2", 232));
}

}  // namespace
}  // namespace coop::launcher
