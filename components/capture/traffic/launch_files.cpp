#include "capture/traffic/launch_files.hpp"

#include <algorithm>
#include <regex>
#include <string>

#include "core/atomic_file.hpp"
#include "core/places.hpp"

namespace coop::capture {
namespace {

/// A larger one is a recording, not a description.
constexpr std::uintmax_t kLargest = std::uintmax_t{16} << 20U;

class Collection {
 public:
  explicit Collection(const std::filesystem::path& share) : share_(share) {}

  std::vector<std::filesystem::path> files;

  void add(const std::filesystem::path& name, const std::filesystem::path& beside) {
    const auto found = find_file(name, {beside, share_});
    std::error_code error;
    if (found.empty() || !std::filesystem::is_regular_file(found, error)) return;
    const auto file = std::filesystem::weakly_canonical(found, error);
    const auto size = std::filesystem::file_size(file, error);
    if (error || size > kLargest || std::ranges::find(files, file) != files.end()) return;
    files.push_back(file);
    if (file.extension() == ".yaml") read(read_file(file), file.parent_path());
  }

  void read(const std::string& text, const std::filesystem::path& beside) {
    static const std::regex kFile(R"([A-Za-z0-9_./-]+\.(?:yaml|urdf|pgm|png|xml|xacro))");
    for (std::sregex_iterator it(text.begin(), text.end(), kFile), end; it != end; ++it) {
      add(it->str(), beside);
    }
  }

  /// Every key of the launch may be a component, every executable a program with a configuration.
  void add_configurations(const std::string& text) {
    static const std::regex kName(R"re(^(?:  (\w+):\s*$| +executable: "?(\w+)"?))re",
                                  std::regex::multiline);
    for (std::sregex_iterator it(text.begin(), text.end(), kName), end; it != end; ++it) {
      const std::string name = (*it)[1].matched ? (*it)[1].str() : (*it)[2].str();
      add("config/" + name + ".yaml", share_);
    }
  }

 private:
  std::filesystem::path share_;
};

}  // namespace

std::vector<std::filesystem::path> files_of_launch(std::string_view launch_text,
                                                   const std::filesystem::path& share) {
  Collection collection(share);
  const std::string text(launch_text);
  collection.add_configurations(text);
  collection.read(text, share);
  const auto is_robot = [](const auto& file) { return file.extension() == ".urdf"; };
  const auto robots = share / "config/robot";
  if (std::ranges::none_of(collection.files, is_robot) && std::filesystem::exists(robots)) {
    for (const auto& entry : std::filesystem::directory_iterator(robots)) {
      if (is_robot(entry.path())) collection.add(entry.path(), robots);
    }
  }
  return std::move(collection.files);
}

std::string_view media_type_of(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".yaml") return "application/yaml";
  if (extension == ".urdf" || extension == ".xml" || extension == ".xacro") {
    return "application/xml";
  }
  if (extension == ".pgm") return "image/x-portable-graymap";
  if (extension == ".png") return "image/png";
  return "application/octet-stream";
}

}  // namespace coop::capture
