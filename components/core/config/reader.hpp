#pragma once
#include <yaml-cpp/yaml.h>

#include <set>
#include <string>
#include <vector>

#include "core/config/fields.hpp"

namespace coop::config {

/// Where a node came from, for messages: `file:line` of the document, or `--set key=value`.
struct Source {
  std::string name;
  std::set<std::string> overridden;  ///< dotted keys set on the command line

  [[nodiscard]] std::string where(const YAML::Node& node, const std::string& key) const;
};

/// Fields visitor that fills a struct from a YAML mapping, strictly.
class Reader : public Fields {
 public:
  Reader(const YAML::Node& root, const Source& source);

  using Fields::integer;
  void number(std::string_view name, double& value, const Spec& spec) override;
  void integer(std::string_view name, std::int64_t& value, const Spec& spec) override;
  void flag(std::string_view name, bool& value, const Spec& spec) override;
  void text(std::string_view name, std::string& value, const Spec& spec) override;
  void choice(std::string_view name, std::string& value, std::span<const std::string_view> choices,
              const Spec& spec) override;
  void numbers(std::string_view name, std::vector<double>& value, const Spec& spec) override;
  void texts(std::string_view name, std::vector<std::string>& value, const Spec& spec) override;
  void assignments(std::string_view name, std::vector<Assignment>& value,
                   const Spec& spec) override;
  [[nodiscard]] std::string where(std::string_view name) const override;

  /// Throws Error when the mapping held a key that nobody asked for.
  void finish() { reject_unknown(stack_.front()); }

 protected:
  bool begin_section(std::string_view name) override;
  void end_section() override;
  bool begin_list(std::string_view name, std::size_t& size) override;
  void begin_element(std::size_t index) override;
  void end_list() override;
  bool begin_mapping(std::string_view name, std::vector<std::string>& names) override;

 private:
  struct Level {
    YAML::Node node;
    std::string path;
    std::vector<std::string> known;
  };

  [[nodiscard]] YAML::Node take(std::string_view name);
  [[nodiscard]] std::string path_of(std::string_view name) const;
  [[noreturn]] void reject(const YAML::Node& node, std::string_view name,
                           const std::string& expected) const;
  void check_bounds(const YAML::Node& node, std::string_view name, double value,
                    const Spec& spec) const;
  void reject_unknown(const Level& level) const;
  void flatten(const YAML::Node& node, const std::string& path, const std::string& prefix,
               std::vector<Assignment>& value) const;
  template <class T>
  [[nodiscard]] T scalar(const YAML::Node& node, std::string_view name, const char* expected) const;
  void require_sequence(const YAML::Node& node, std::string_view name, const char* of) const;

  Source source_;
  std::vector<Level> stack_;
};

}  // namespace coop::config
