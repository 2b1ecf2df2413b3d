#include "architecture/source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace coop::architecture {
namespace {

namespace fs = std::filesystem;

bool is_foreign(const fs::path& folder) {
  static const std::set<std::string> kForeign{"build", "runs", "node_modules"};
  const std::string name = folder.filename().string();
  return kForeign.contains(name) || (name.starts_with('.') && name != ".ci");
}

bool is_text(const std::string& content) {
  return content.substr(0, 4096).find('\0') == std::string::npos;
}

}  // namespace

std::vector<std::string> SourceFile::lines() const {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

bool SourceFile::is_cpp() const {
  return path.ends_with(".cpp") || path.ends_with(".hpp");
}

bool SourceFile::is_code() const {
  static const std::set<std::string> kExtensions{".cpp", ".hpp", ".h",   ".c",     ".py",
                                                 ".sh",  ".js",  ".css", ".cmake", ".in"};
  return kExtensions.contains(fs::path(path).extension().string()) || path == "coop" ||
         path.starts_with(".ci/") || path.ends_with("CMakeLists.txt");
}

std::vector<SourceFile> read_tree(const fs::path& root) {
  std::vector<SourceFile> files;
  for (auto entry = fs::recursive_directory_iterator(root);
       entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->is_directory()) {
      if (is_foreign(entry->path())) entry.disable_recursion_pending();
      continue;
    }
    // `.git` is a file where the checkout is one of several of a repository.
    if (!entry->is_regular_file() || entry->path().filename() == ".git") continue;
    std::ifstream in(entry->path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    SourceFile file{entry->path().lexically_relative(root).generic_string(), std::move(text).str()};
    if (is_text(file.text)) files.push_back(std::move(file));
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace coop::architecture
