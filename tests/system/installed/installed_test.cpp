// What `cmake --install` leaves is whole: it needs neither the checkout nor the build folder.
#include <gtest/gtest.h>

#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

void expect_success(const std::string& program, const std::vector<std::string>& arguments,
                    const std::filesystem::path& folder) {
  Program running(program, arguments, folder / "output");
  const auto status = running.wait();
  ASSERT_TRUE(status) << program << " did not end:\n" << running.output();
  EXPECT_TRUE(status->clean()) << program << ' ' << status->text() << ":\n" << running.output();
}

TEST(Installed, SystemOfAnotherPrefixIsCheckedAndBecomesReady) {
  (void)control_folder();
  const TemporaryFolder folder;
  const auto prefix = folder.path() / "prefix";
  expect_success(COOP_CMAKE, {"--install", COOP_BUILD_DIR, "--strip", "--prefix", prefix.string()},
                 folder.path());
  const auto front_door = (prefix / "bin" / "coop").string();
  const auto launch_file = (prefix / "share" / "coop" / "config" / "launch" / "sim.yaml").string();
  expect_success(front_door, {"check", launch_file}, folder.path());
  expect_success(front_door,
                 {"up", launch_file, "--domain", std::to_string(test_domain()), "--run-dir",
                  (folder.path() / "runs").string(), "--until", "ready", "--timeout", "15"},
                 folder.path());
}

}  // namespace
}  // namespace coop::test
