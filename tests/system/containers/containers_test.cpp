// The robot as containers on a real engine: built, brought up, hurt in every way an operator or a
// bad day knows, and its mission completed.
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <thread>

#include "core/atomic_file.hpp"
#include "system/containers/composition.hpp"
#include "system/mission/mission_watch.hpp"
#include "system/security/guest.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;
namespace State = coop_msgs::msg::MissionStatus_Constants;

const fs::path kSource = COOP_SOURCE_DIR;
constexpr const char* kImage = "coop:test";
constexpr double kMostMegabytes = 250;
constexpr std::chrono::minutes kMissionLimit{8};
const fs::path kLaunch = kSource / "config/launch/collect.yaml";
/// The user in the image (docker/Dockerfile).
constexpr const char* kUser = "10001:10001";

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What the package needs of Debian, by its own word, without the versions.
std::string needed_packages(const fs::path& package) {
  std::string names;
  std::string word;
  for (const char c : need_tool("dpkg-deb", {"--field", package.string(), "Depends"}) + ",") {
    if (c == ',' || c == '\n') {
      if (!word.empty()) names += (names.empty() ? "" : ",") + word;
      word.clear();
    } else if (c != ' ' && word.find('(') == std::string::npos) {
      word += c;
    }
  }
  std::erase(names, '(');
  return names;
}

class Containers : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string obstacle = ContainerEngine::obstacle();
    if (!obstacle.empty()) GTEST_SKIP() << "not run: " << obstacle;
    try {
      engine_.emplace();
    } catch (const std::runtime_error& problem) {
      GTEST_SKIP() << "not run: " << problem.what();
    }
    package();
    build("1");
    write_composition();
  }
  void TearDown() override {
    if (HasFailure() && composition_) std::cout << composition_->logs();
    composition_.reset();
    if (engine_ && !engine_->is_own()) (void)run_tool("docker", {"image", "rm", kImage});
  }

  /// The Debian package of this build, alone in a build context.
  void package() {
    need_tool(COOP_CPACK,
              {"-G", "DEB", "--config", COOP_BUILD_DIR "/CPackConfig.cmake", "-B",
               (folder_.path() / "package").string()},
              std::chrono::minutes(5));
    fs::create_directories(context() / "docker");
    for (const auto& entry : fs::directory_iterator(folder_.path() / "package")) {
      if (entry.path().extension() == ".deb") fs::rename(entry.path(), context() / "coop.deb");
    }
    for (const char* script : {"package.sh", "image_root.sh"}) {
      fs::copy_file(kSource / "docker" / script, context() / "docker" / script);
    }
    engine_->need_base_image(COOP_BUILD_DIR "/containers/base.tar",
                             needed_packages(context() / "coop.deb"));
  }
  void build(const std::string& revision) const {
    need_tool("docker",
              {"build", "--file", (kSource / "docker/Dockerfile").string(), "--build-arg",
               "PACKAGE=coop.deb", "--label", "revision=" + revision, "--tag", kImage,
               context().string()},
              std::chrono::minutes(10));
  }
  [[nodiscard]] fs::path context() const { return folder_.path() / "context"; }

  /// What `coop compose` makes of the shipped mission, with a world of two eggs (which names its
  /// map by where both lie).
  void write_composition() {
    const auto compose = run_launcher(
        {"compose", kLaunch.string(), "--domain", std::to_string(test_domain()), "--set",
         "world=tests/data/two_eggs.world.yaml", "--set", "sequencer.mission.expected_eggs=2"},
        folder_.path());
    ASSERT_EQ(compose.code, 0) << compose.output;
    write_file_atomically(folder_.path() / "compose.yaml", compose.output);
    write_file_atomically(folder_.path() / "data.yaml",
                          "services:\n  simulator:\n    volumes:\n      - " +
                              (kSource / "tests/data").string() +
                              ":/usr/share/coop/tests/data:ro\n");
    setenv("COOP_IMAGE", kImage, 1);
    composition_.emplace(
        "coop-test-" + std::to_string(test_domain()),
        std::vector{folder_.path() / "compose.yaml", folder_.path() / "data.yaml"});
    services_ = composition_->services();
  }

  void bring_up() {
    const auto begin = std::chrono::steady_clock::now();
    composition_->compose({"up", "--detach"});
    ASSERT_TRUE(composition_->wait_until_healthy(services_));
    std::cout << "up to all healthy: " << seconds_since(begin) << " s" << std::endl;
    watch_.emplace(test_domain());
  }
  bool wait(const std::function<bool()>& condition) {
    return look_until(*watch_, condition, kMissionLimit);
  }
  bool reached(std::uint8_t state) {
    return wait([&] { return watch_->mission().state() == state; });
  }
  void kill(const std::vector<std::string>& services) {
    for (const std::string& service : services) {
      const int before = composition_->restarts(service);
      EXPECT_TRUE(composition_->kill_program(service)) << service;
      EXPECT_TRUE(wait_until([&] { return composition_->restarts(service) > before; })) << service;
    }
    EXPECT_TRUE(composition_->wait_until_healthy(services));
  }

  /// The same composition with an override laid over it comes up, and who has `keys` hears it.
  void expect_heard_with(const std::string& name, const fs::path& keys) {
    const auto lines =
        run_launcher({"compose", kLaunch.string(), "--override", name}, folder_.path());
    ASSERT_EQ(lines.code, 0) << lines.output;
    const fs::path file = folder_.path() / (name + ".yaml");
    write_file_atomically(file, lines.output);
    const Composition composition(
        "coop-test-" + name + "-" + std::to_string(test_domain()),
        {folder_.path() / "compose.yaml", folder_.path() / "data.yaml", file});
    const auto begin = std::chrono::steady_clock::now();
    composition.compose({"up", "--detach"});
    EXPECT_TRUE(composition.wait_until_healthy(services_)) << composition.logs();
    std::cout << name << ".yaml: up to all healthy: " << seconds_since(begin) << " s" << std::endl;
    Guest person("person", "", keys);
    person.listen_to_scans();
    std::optional<Guest> nobody;
    if (!keys.empty()) {
      nobody.emplace("person", "", fs::path());
      nobody->listen_to_scans();
    }
    EXPECT_TRUE(wait_until([&] {
      person.look();
      if (nobody) nobody->look();
      return person.scans() >= 10;
    })) << composition.logs();
    EXPECT_EQ(nobody ? nobody->scans() : 0, 0);
  }
  /// Keys that the containers' user may read.
  [[nodiscard]] fs::path make_keys() const {
    const fs::path keys = folder_.path() / "keys";
    need_tool(COOP_BIN_DIR "/keys", {"make", kLaunch.string(), "--folder", keys.string(),
                                     "--domain", std::to_string(test_domain())});
    need_tool("chown", {"--recursive", kUser, keys.string()});
    setenv("COOP_KEYS", keys.c_str(), 1);
    return keys;
  }

  TemporaryFolder folder_;
  std::optional<ContainerEngine> engine_;
  std::optional<Composition> composition_;
  std::vector<std::string> services_;
  std::optional<MissionWatch> watch_;
};

TEST_F(Containers, AMissionSurvivesKilledPausedStoppedAndReplacedContainers) {
  const double megabytes =
      1e-6 * std::stod(need_tool("docker", {"image", "inspect", "--format", "{{.Size}}", kImage}));
  std::cout << "image: " << megabytes << " MB" << std::endl;
  EXPECT_LE(megabytes, kMostMegabytes);
  ASSERT_NO_FATAL_FAILURE(bring_up());

  ASSERT_TRUE(reached(State::SEARCHING)) << watch_->mission().detail();
  kill({"simulator", "lidar_driver", "camera_driver"});
  composition_->docker("pause", "amcl");
  std::this_thread::sleep_for(
      std::chrono::seconds(2));  // the pause itself, not a wait for something
  composition_->docker("unpause", "amcl");
  EXPECT_TRUE(composition_->wait_until_healthy({"amcl"}));

  ASSERT_TRUE(reached(State::DRIVING)) << watch_->mission().detail();
  kill({"amcl", "global_planner", "dwa"});
  composition_->compose({"stop", "global_planner"});
  composition_->compose({"start", "global_planner"});
  EXPECT_TRUE(composition_->wait_until_healthy({"global_planner"}));

  const std::string others = composition_->inspect("simulator", "{{.Id}}");
  const std::string replaced = composition_->inspect("dwa", "{{.Id}}");
  build("2");
  composition_->compose({"up", "--detach", "--no-deps", "dwa"});
  EXPECT_TRUE(composition_->wait_until_healthy({"dwa"}));
  EXPECT_NE(composition_->inspect("dwa", "{{.Id}}"), replaced);
  EXPECT_EQ(composition_->inspect("dwa", "{{.Config.Labels.revision}}"), "2");
  EXPECT_EQ(composition_->inspect("simulator", "{{.Id}}"), others) << "the rest is left alone";

  kill({"arm_driver", "sequencer"});
  ASSERT_TRUE(wait([&] { return watch_->is_done(); })) << watch_->mission().detail();
  EXPECT_EQ(watch_->eggs_picked(), 2) << watch_->mission().detail();
  EXPECT_TRUE(wait([&] { return watch_->eggs_collected() == 2; }));
  EXPECT_EQ(watch_->mission().eggs().size(), 2U) << "no egg counted twice";
  EXPECT_EQ(watch_->truth().collision_count(), 0U);

  const auto begin = std::chrono::steady_clock::now();
  composition_->compose({"down", "--volumes"});
  std::cout << "down: " << seconds_since(begin) << " s" << std::endl;
  EXPECT_TRUE(composition_->states().empty());

  expect_heard_with("host", {});
  expect_heard_with("security", make_keys());
}

}  // namespace
}  // namespace coop::test
