#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace coop::architecture {

/// A text file of the tree.
struct SourceFile {
  std::string path;  ///< relative to the root, with '/'
  std::string text;

  [[nodiscard]] std::vector<std::string> lines() const;
  [[nodiscard]] bool is_cpp() const;
  /// Code of any language, the front door and the scripts included.
  [[nodiscard]] bool is_code() const;
};

/// All text files below `root` that are part of the project: no hidden folders but .ci, no build,
/// runs or node_modules.
[[nodiscard]] std::vector<SourceFile> read_tree(const std::filesystem::path& root);

}  // namespace coop::architecture
