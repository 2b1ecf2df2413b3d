#include "launcher/compose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/atomic_file.hpp"

namespace coop::launcher {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::filesystem::path kRoot = COOP_SOURCE_DIR;

PlannedComponent service_of(const std::string& name) {
  PlannedComponent planned;
  planned.name = name;
  planned.where = "x.yaml:3";
  planned.executable = "/opt/checkout/build/bin/" + name;
  planned.arguments = {"--name", name, "--log-dir", "/var/lib/coop/logs"};
  planned.start_timeout = 15;
  planned.stop_timeout = 2.5;
  return planned;
}

class ComposeTest : public ::testing::Test {
 protected:
  ComposeTest() {
    plan_.components = {service_of("simulator"), service_of("dwa")};
    plan_.components[1].after = {0};
  }
  PlannedComponent& dwa() { return plan_.components[1]; }
  [[nodiscard]] YAML::Node services() const {
    return YAML::Load(compose_file(plan_, places_, "x.yaml"))["services"];
  }
  static std::vector<std::string> texts(const YAML::Node& list) {
    return list.as<std::vector<std::string>>();
  }
  Places places_{.programs = "/opt/checkout/build/bin", .share = "/opt/checkout"};
  Plan plan_;
};

TEST_F(ComposeTest, FilesOfThisMachineBecomeThoseOfTheImage) {
  dwa().arguments.insert(dwa().arguments.end(), {"--config", "/opt/checkout/config/dwa.yaml",
                                                 "--set", "map=\"/opt/checkout/maps/m.yaml\""});
  EXPECT_THAT(texts(services()["dwa"]["command"]),
              ElementsAre("/usr/lib/coop/dwa", "--name", "dwa", "--config",
                          "/usr/share/coop/config/dwa.yaml", "--set",
                          "map=\"/usr/share/coop/maps/m.yaml\""));
}

TEST_F(ComposeTest, AFileTheImageCannotHaveIsRefusedWithItsPlace) {
  dwa().arguments.insert(dwa().arguments.end(), {"--config", "/etc/mine.yaml"});
  try {
    (void)services();
    FAIL() << "no error";
  } catch (const config::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("x.yaml:3: dwa: /etc/mine.yaml is not in the image"));
  }
}

TEST_F(ComposeTest, AfterIsTheOrderOfStartsAndDoesNotWaitForHealth) {
  EXPECT_EQ(services()["dwa"]["depends_on"]["simulator"]["condition"].as<std::string>(),
            "service_started");
  EXPECT_THAT(texts(services()["dwa"]["healthcheck"]["test"]),
              ElementsAre("CMD", "/usr/lib/coop/health", "dwa"));
  plan_.components[0].sends_heartbeat = false;
  EXPECT_FALSE(services()["simulator"]["healthcheck"]);
}

TEST_F(ComposeTest, RestartAndStopAreThoseOfTheLaunchFile) {
  const auto restart = [this](const std::string& policy) {
    dwa().restart.policy = policy;
    return services()["dwa"]["restart"].as<std::string>();
  };
  EXPECT_EQ(restart("always"), "unless-stopped");
  EXPECT_EQ(restart("on-failure"), "on-failure");
  EXPECT_EQ(restart("never"), "no");
  EXPECT_EQ(services()["dwa"]["stop_grace_period"].as<std::string>(), "3s");
}

TEST_F(ComposeTest, DollarSignsAndQuotesReachTheProgramAsTheyAre) {
  dwa().arguments = {"--set", R"(a="$x")"};
  EXPECT_EQ(texts(services()["dwa"]["command"]).back(), R"(a="$$x")")
      << "Compose makes one of two dollar signs";
}

TEST_F(ComposeTest, NothingRunsWithMoreRightsThanItNeeds) {
  for (const char* name : {"simulator", "dwa"}) {
    const YAML::Node service = services()[name]["<<"];  // the library leaves merging to us
    EXPECT_TRUE(service["read_only"].as<bool>());
    EXPECT_TRUE(service["init"].as<bool>());
    EXPECT_THAT(texts(service["cap_drop"]), ElementsAre("ALL"));
    EXPECT_THAT(texts(service["security_opt"]), ElementsAre("no-new-privileges:true"));
  }
}

TEST_F(ComposeTest, KeysLieWhereTheContainerSeesThem) {
  dwa().arguments = {"--dds", "security=true", "--dds", "keys=/opt/keys"};
  EXPECT_EQ(texts(services()["dwa"]["command"]).back(), "keys=/etc/coop/keys");
}

TEST_F(ComposeTest, OverridesNameTheServicesTheyAreFor) {
  const auto override_services = [this](const std::string& name) {
    return YAML::Load(compose_override(plan_, name, "x.yaml"))["services"];
  };
  EXPECT_EQ(override_services("host")["dwa"]["network_mode"].as<std::string>(), "host");
  EXPECT_EQ(override_services("host")["dwa"]["ipc"].as<std::string>(), "host");
  EXPECT_THAT(texts(override_services("security")["dwa"]["volumes"]),
              ElementsAre("${COOP_KEYS:-./keys}/public:/etc/coop/keys/public:ro",
                          "${COOP_KEYS:-./keys}/dwa:/etc/coop/keys/dwa:ro"));
  EXPECT_EQ(override_services("security")["dwa"]["environment"]["COOP_DDS"].as<std::string>(),
            "security=true keys=/etc/coop/keys ${COOP_DDS:-}");
  plan_.components.push_back(service_of("lidar_driver"));
  EXPECT_FALSE(override_services("hardware")["dwa"]);
  EXPECT_THAT(texts(override_services("hardware")["lidar_driver"]["devices"]),
              ElementsAre("${COOP_LIDAR_DEVICE:-/dev/null}:/dev/lidar"));
  EXPECT_THROW((void)compose_override(plan_, "other", "x.yaml"), config::Error);
}

}  // namespace
}  // namespace coop::launcher
