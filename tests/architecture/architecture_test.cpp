#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <regex>

#include "architecture/function_length.hpp"
#include "architecture/include_arrows.hpp"
#include "architecture/source_tree.hpp"

namespace coop::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::size_t kMaxFileLines = 400;
constexpr std::size_t kMaxFunctionLines = 80;

const std::vector<SourceFile>& tree() {
  static const std::vector<SourceFile> files = read_tree(COOP_SOURCE_DIR);
  return files;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += "\n  " + line;
  return out;
}

TEST(ArrowsTest, TheTreeKeepsThem) {
  const auto broken = broken_arrows(tree());
  EXPECT_THAT(broken, IsEmpty()) << joined(broken);
}

TEST(ArrowsTest, TheTreeIsThere) {
  EXPECT_GT(std::ranges::count_if(tree(), &SourceFile::is_cpp), 100);
}

struct Arrow {
  const char* file;
  const char* include;
  bool allowed;
};

class ArrowTest : public ::testing::TestWithParam<Arrow> {};

TEST_P(ArrowTest, IsAsTheDesignPageSays) {
  const auto [file, include, allowed] = GetParam();
  EXPECT_EQ(may_include(part_of_file(file), part_of_include(include)), allowed)
      << file << " -> " << include;
}

INSTANTIATE_TEST_SUITE_P(
    Table, ArrowTest,
    ::testing::Values(
        Arrow{"components/core/grid.hpp", "vector", true},
        Arrow{"components/core/grid.hpp", "Eigen/Core", true},
        Arrow{"components/core/grid.hpp", "core/pose.hpp", true},
        Arrow{"components/core/grid.hpp", "yaml-cpp/yaml.h", false},
        Arrow{"components/core/config/reader.cpp", "yaml-cpp/yaml.h", true},
        Arrow{"components/core/grid.cpp", "opencv2/core.hpp", false},
        Arrow{"components/core/image/png.cpp", "opencv2/core.hpp", true},
        Arrow{"components/core/robot/model.cpp", "urdf_parser/urdf_parser.h", true},
        Arrow{"components/core/grid.cpp", "runtime/node.hpp", false},
        Arrow{"components/core/grid.cpp", "dwa/critic.hpp", false},
        Arrow{"components/core/grid.cpp", "nav_msgs/msg/Path.h", false},
        Arrow{"components/dwa/critic.cpp", "core/pose.hpp", true},
        Arrow{"components/dwa/critic.cpp", "dwa/critic.hpp", true},
        Arrow{"components/dwa/critic.cpp", "amcl/filter.hpp", false},
        Arrow{"components/dwa/critic.cpp", "dwa/node/dwa_node.hpp", false},
        Arrow{"components/dwa/critic.cpp", "runtime/node.hpp", false},
        Arrow{"components/dwa/critic.cpp", "conversions/time.hpp", false},
        Arrow{"components/dwa/critic.cpp", "nav_msgs/msg/Path.h", false},
        Arrow{"components/dwa/critic.cpp", "yaml-cpp/yaml.h", false},
        Arrow{"components/dwa/critic.cpp", "spdlog/spdlog.h", false},
        Arrow{"components/runtime/security_keys.cpp", "openssl/pem.h", true},
        Arrow{"components/amcl/amcl.cpp", "openssl/pem.h", false},
        Arrow{"components/dwa/critic.cpp", "fastdds/dds/domain/DomainParticipant.hpp", false},
        Arrow{"components/dwa/node/dwa_node.cpp", "dwa/critic.hpp", true},
        Arrow{"components/dwa/node/dwa_node.cpp", "dwa/node/dwa_node.hpp", true},
        Arrow{"components/dwa/node/dwa_node.cpp", "runtime/node.hpp", true},
        Arrow{"components/dwa/node/dwa_node.cpp", "conversions/time.hpp", true},
        Arrow{"components/dwa/node/dwa_node.cpp", "nav_msgs/msg/Path.h", true},
        Arrow{"components/dwa/node/dwa_node.cpp", "amcl/filter.hpp", false},
        Arrow{"components/dwa/node/dwa_node.cpp", "amcl/node/amcl_node.hpp", false},
        Arrow{"components/dwa/node/dwa_node.cpp", "fastrtps/types/TypesBase.h", false},
        Arrow{"components/dwa/node/dwa_node.cpp", "launcher/plan.hpp", false},
        Arrow{"components/conversions/time.cpp", "builtin_interfaces/msg/Time.h", true},
        Arrow{"components/conversions/time.cpp", "core/time.hpp", true},
        Arrow{"components/conversions/time.cpp", "runtime/node.hpp", false},
        Arrow{"components/runtime/node.cpp", "fastdds/dds/domain/DomainParticipant.hpp", true},
        Arrow{"components/runtime/node.cpp", "conversions/time.hpp", true},
        Arrow{"components/runtime/node.cpp", "dwa/critic.hpp", false},
        Arrow{"launcher/session.cpp", "runtime/transport.hpp", true},
        Arrow{"launcher/session.cpp", "fastdds/dds/domain/DomainParticipant.hpp", false},
        Arrow{"launcher/session.cpp", "dwa/critic.hpp", false},
        Arrow{"launcher/session.cpp", "yaml-cpp/yaml.h", false},
        Arrow{"tests/unit/dwa/critic_test.cpp", "runtime/node.hpp", true}));

TEST(ArrowsTest, APlantedIncludeIsFound) {
  const std::vector<SourceFile> files{
      {"components/dwa/critic.cpp", "#include \"dwa/critic.hpp\"\n\n  # include <amcl/x.hpp>\n"}};
  EXPECT_THAT(broken_arrows(files),
              ElementsAre("components/dwa/critic.cpp:3: dwa may not include amcl (amcl/x.hpp)"));
}

TEST(SizeTest, NoFileIsLongerThanAPersonReads) {
  std::vector<std::string> long_files;
  for (const SourceFile& file : tree()) {
    const std::size_t lines = file.lines().size();
    if (file.is_code() && lines > kMaxFileLines) {
      long_files.push_back(file.path + ": " + std::to_string(lines) + " lines");
    }
  }
  EXPECT_THAT(long_files, IsEmpty()) << joined(long_files);
}

TEST(SizeTest, NoFunctionIsLongerThanAScreen) {
  std::vector<std::string> long_functions;
  for (const SourceFile& file : tree()) {
    if (!file.is_cpp()) continue;
    for (const Function& function : find_functions(file.text)) {
      if (function.length <= kMaxFunctionLines) continue;
      long_functions.push_back(file.path + ":" + std::to_string(function.line) + ": " +
                               std::to_string(function.length) + " lines: " + function.head);
    }
  }
  EXPECT_THAT(long_functions, IsEmpty()) << joined(long_functions);
}

TEST(SizeTest, FunctionsAreFoundByTheirBraces) {
  const auto functions = find_functions(R"text(
#define OPEN {
namespace a {  // {
struct S {
  S() : x{1} {}
  int f() const {
    if (x) { return '{'; }
    return 1'000;
  }
  int x = 0;
};
const char* kText = R"({ not ( a function)";
struct S make(int n) {
  const auto twice = [n] {
    return 2 * n;
  };
  return S{};
}
}  // namespace a
)text");
  ASSERT_EQ(functions.size(), 3U);
  EXPECT_EQ(functions[1].line, 6U);
  EXPECT_EQ(functions[1].length, 4U);
  EXPECT_EQ(functions[2].line, 13U);
  EXPECT_EQ(functions[2].length, 6U);
}

TEST(TreeTest, NoPathOfOneMachineStandsInIt) {
  // In pieces, so that this file holds none itself.
  const std::regex machine(
      "(^|[^A-Za-z0-9_.])/("
      "work|root|farm|home|Users"
      ")/");
  std::vector<std::string> found;
  for (const SourceFile& file : tree()) {
    if (file.path.starts_with("docker/")) continue;
    const std::vector<std::string> lines = file.lines();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].size() > 2000 || !std::regex_search(lines[i], machine)) continue;
      found.push_back(file.path + ":" + std::to_string(i + 1) + ": " + lines[i]);
    }
  }
  EXPECT_THAT(found, IsEmpty()) << joined(found);
}

TEST(TreeTest, EveryFileIsFormatted) {
  const std::string program = COOP_CLANG_FORMAT;
  if (program.empty()) GTEST_SKIP() << "not run: clang-format is not installed";
  std::string command = "cd '" COOP_SOURCE_DIR "' && '" + program + "' --dry-run -Werror";
  for (const SourceFile& file : tree()) {
    if (file.is_cpp()) command += " '" + file.path + "'";
  }
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string output;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    if (output.size() < 4000) output.append(buffer.data(), count);
  }
  EXPECT_EQ(pclose(pipe), 0) << output << "\n  mend it with: ./coop format";
}

}  // namespace
}  // namespace coop::architecture
