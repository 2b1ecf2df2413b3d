#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop::test {

/// Launch files made of fake components.
class LaunchText {
 public:
  /// `more`: further lines of the component, in YAML flow style, e.g. "after: [a]".
  LaunchText& add(const std::string& name, const std::string& parameters = "",
                  const std::string& more = "") {
    text_ += "  " + name + ": {executable: \"" COOP_FAKE_COMPONENT "\"";
    if (!parameters.empty()) text_ += ", parameters: {" + parameters + "}";
    if (!more.empty()) text_ += ", " + more;
    text_ += "}\n";
    return *this;
  }
  std::filesystem::path file() {
    const auto path = folder_.path() / "test.yaml";
    write_file_atomically(path, text_);
    return path;
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  std::string text_ = "components:\n";
};

}  // namespace coop::test
