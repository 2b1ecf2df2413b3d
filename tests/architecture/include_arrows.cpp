#include "architecture/include_arrows.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <set>

namespace coop::architecture {
namespace {

constexpr std::string_view kComponents = "components/";

std::string_view first_segment(std::string_view path) {
  return path.substr(0, path.find('/'));
}

/// "dwa/node/x.hpp" -> "dwa/node", "core/config/x.hpp" -> "core/config", "core/grid.hpp" -> "core".
std::string part_below_components(std::string_view path) {
  static const std::set<std::string_view> kPartsOfCore{"config", "image", "robot"};
  const std::string_view first = first_segment(path);
  if (first.size() == path.size()) return {};  // components/CMakeLists.txt
  const std::string_view rest = path.substr(first.size() + 1);
  const std::string_view second = first_segment(rest);
  const bool has_second = second.size() < rest.size();
  if (has_second && (second == "node" || (first == "core" && kPartsOfCore.contains(second)))) {
    return std::string(first) + "/" + std::string(second);
  }
  return std::string(first);
}

struct Library {
  std::string_view folder;
  std::string_view name;
};
constexpr std::array<Library, 14> kLibraries{{{"fastdds", "Fast DDS"},
                                              {"fastrtps", "Fast DDS"},
                                              {"fastcdr", "Fast DDS"},
                                              {"yaml-cpp", "yaml-cpp"},
                                              {"opencv2", "OpenCV"},
                                              {"urdf_parser", "urdfdom"},
                                              {"urdf_model", "urdfdom"},
                                              {"urdf_exception", "urdfdom"},
                                              {"console_bridge", "urdfdom"},
                                              {"Eigen", "Eigen"},
                                              {"unsupported", "Eigen"},
                                              {"spdlog", "spdlog"},
                                              {"openssl", "OpenSSL"},
                                              {"coop_idl", "idl"}}};

bool is_message_package(std::string_view folder) {
  return folder.ends_with("_msgs") || folder == "builtin_interfaces";
}

bool is_node(std::string_view part) {
  return part.ends_with("/node");
}

bool is_core(std::string_view part) {
  return first_segment(part) == "core";
}

/// What each part may include beside itself. A component's own library and shell are handled in
/// may_include().
bool table_allows(std::string_view from, std::string_view to) {
  if (to == "Eigen" || is_core(to)) return true;
  // The parts of core that have a library of their own are the only places of these.
  if (to == "yaml-cpp") return from == "core/config";
  if (to == "urdfdom") return from == "core/robot";
  if (to == "Fast DDS" || to == "spdlog") return from == "runtime";
  // Keys are made by the launcher's tool and looked at before a participant is given them.
  if (to == "OpenSSL") return from == "runtime" || from == "launcher";
  if (to == "OpenCV") return from == "core/image" || !is_core(from);
  if (is_core(from)) return false;
  if (from == "conversions") return to == "idl";
  if (from == "runtime") return to == "idl" || to == "conversions";
  // Messages are the words in which one speaks with the runtime.
  if (from == "launcher") return to == "runtime" || to == "idl";
  if (is_node(from)) return to == "runtime" || to == "conversions" || to == "idl";
  return false;
}

}  // namespace

std::string part_of_file(std::string_view path) {
  if (path.starts_with(kComponents)) return part_below_components(path.substr(kComponents.size()));
  const std::string_view first = first_segment(path);
  return first == "launcher" || first == "tests" ? std::string(first) : std::string();
}

std::string part_of_include(std::string_view include) {
  const std::string_view folder = first_segment(include);
  if (folder.size() == include.size()) return {};  // <vector>, <unistd.h>
  if (is_message_package(folder)) return "idl";
  const auto library = std::ranges::find(kLibraries, folder, &Library::folder);
  if (library != kLibraries.end()) return std::string(library->name);
  static const std::set<std::string_view> kOthers{
      "sys", "linux",    "systemd", "arpa",  "net",       "netinet", "CLI", "fmt",
      "tl",  "nlohmann", "gtest",   "gmock", "benchmark", "asm",     "bits"};
  if (kOthers.contains(folder)) return {};
  if (folder == "launcher") return "launcher";
  return part_below_components(include);
}

bool may_include(std::string_view from, std::string_view to) {
  if (from.empty() || to.empty() || from == "tests" || from == to) return true;
  if (is_node(from) && to == first_segment(from)) return true;
  return table_allows(from, to);
}

std::vector<std::string> broken_arrows(const std::vector<SourceFile>& files) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> broken;
  for (const SourceFile& file : files) {
    const std::string from = part_of_file(file.path);
    if (!file.is_cpp() || from.empty()) continue;
    const std::vector<std::string> lines = file.lines();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_search(lines[i], match, kInclude)) continue;
      const std::string to = part_of_include(match[1].str());
      if (may_include(from, to)) continue;
      broken.push_back(file.path + ":" + std::to_string(i + 1) + ": " + from + " may not include " +
                       to + " (" + match[1].str() + ")");
    }
  }
  return broken;
}

}  // namespace coop::architecture
