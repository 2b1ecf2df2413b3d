// Every configuration and launch file that comes with Coop is accepted by the programs it is for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/atomic_file.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

const std::filesystem::path kRoot = COOP_SOURCE_DIR;

std::vector<std::string> yaml_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / folder)) {
    if (entry.path().extension() == ".yaml") {
      files.push_back(folder + "/" + entry.path().filename().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// A CARMEN log of two readings.
std::filesystem::path small_log(const std::filesystem::path& folder) {
  const auto file = folder / "small.clf";
  write_file_atomically(file,
                        "ODOM 0 0 0 0 0 0 100.0 host 0.0\n"
                        "FLASER 4 1.0 1.0 1.0 1.0 0 0 0 0 0 0 100.1 host 0.1\n"
                        "ODOM 0.1 0 0 0 0 0 100.2 host 0.2\n"
                        "FLASER 4 1.0 1.0 1.0 1.0 0.1 0 0 0.1 0 0 100.3 host 0.3\n");
  return file;
}

class LaunchFile : public ::testing::TestWithParam<std::string> {};

TEST_P(LaunchFile, IsAcceptedByEveryComponentItNames) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"check", (kRoot / GetParam()).string()};
  if (GetParam().ends_with("map_log.yaml")) {
    arguments.insert(arguments.end(), {"--set", "log=" + small_log(folder.path()).string()});
  }
  const auto result = run_launcher(arguments, folder.path());
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(result.output, "");
}

INSTANTIATE_TEST_SUITE_P(Shipped, LaunchFile, ::testing::ValuesIn(yaml_files("config/launch")),
                         test_name);

/// What only a launch can know, for programs that do not run without.
std::vector<std::string> told_by_a_launch(const std::string& program) {
  if (program == "amcl") return {"--set", "map_file=" + (kRoot / "maps/duck_house.yaml").string()};
  return {};
}

class Configuration : public ::testing::TestWithParam<std::string> {};

TEST_P(Configuration, IsAcceptedByItsProgram) {
  const TemporaryFolder folder;
  const std::string name = std::filesystem::path(GetParam()).stem().string();
  std::vector<std::string> arguments = told_by_a_launch(name);
  arguments.insert(arguments.end(), {"--check", "--config", (kRoot / GetParam()).string()});
  Program program(name, arguments, folder.path() / "out");
  const auto status = program.wait();
  ASSERT_TRUE(status) << name << " does not answer --check";
  EXPECT_EQ(status->code, 0) << program.output();
}

INSTANTIATE_TEST_SUITE_P(Shipped, Configuration, ::testing::ValuesIn(yaml_files("config")),
                         test_name);

TEST(ShippedFiles, AreThere) {
  EXPECT_THAT(yaml_files("config/launch"), testing::Contains("config/launch/sim.yaml"));
}

/// `coop compose config/launch/sim.yaml [--override NAME]` against the file that comes with Coop.
class ComposeFile : public ::testing::TestWithParam<std::string> {};

TEST_P(ComposeFile, IsWhatTheLaunchFileSays) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"compose", (kRoot / "config/launch/sim.yaml").string()};
  if (GetParam() != "compose") arguments.insert(arguments.end(), {"--override", GetParam()});
  const auto made = run_launcher(arguments, folder.path());
  EXPECT_EQ(made.code, 0);
  EXPECT_EQ(made.output, read_file(kRoot / "docker" / (GetParam() + ".yaml")))
      << "make it anew with `coop compose config/launch/sim.yaml`";
}

INSTANTIATE_TEST_SUITE_P(Shipped, ComposeFile,
                         ::testing::Values("compose", "host", "security", "hardware"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace coop::test
