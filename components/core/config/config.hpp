#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/error.hpp"
#include "core/config/fields.hpp"

namespace coop::config {

/// A YAML mapping to be read into configuration structs, strictly: an unknown key, a wrong type or
/// a value out of bounds is an Error that says file, line, key, what was expected and, for a key,
/// the nearest valid name.
class Document {
 public:
  /// Throws Error when the file is missing or is no YAML mapping. An empty file is an empty
  /// mapping.
  static Document load(const std::filesystem::path& path);
  /// `name` stands for the file in messages.
  static Document parse(std::string_view yaml, std::string name);
  Document();

  /// Applies `key.sub.key=value` (value in YAML) on top. Throws Error where it is malformed;
  /// whether the key exists is found when the document is read.
  void set(std::string_view assignment);

  /// Fills `fields` of the struct from the document; what the document does not name keeps its
  /// value.
  template <class Struct>
  void read(Struct& value) const {
    auto reader = make_reader();
    value.describe(*reader);
    finish(*reader);
    if constexpr (requires { value.validate(); }) value.validate();
  }
  template <class Struct>
  [[nodiscard]] Struct read() const {
    Struct value;
    read(value);
    return value;
  }

  /// The document as YAML, overrides applied.
  [[nodiscard]] std::string text() const;

 private:
  struct Impl;
  [[nodiscard]] std::unique_ptr<Fields> make_reader() const;
  void finish(Fields& reader) const;
  std::shared_ptr<Impl> impl_;
};

/// All fields with their values as YAML: the configuration in force.
[[nodiscard]] std::unique_ptr<Fields> make_yaml_writer(std::string& out);
template <class Struct>
[[nodiscard]] std::string to_yaml(Struct value) {
  std::string out;
  value.describe(*make_yaml_writer(out));
  return out;
}

/// A Markdown table of all fields: key, default, unit, bounds, meaning.
[[nodiscard]] std::unique_ptr<Fields> make_table_writer(std::string& out);
template <class Struct>
[[nodiscard]] std::string to_markdown_table() {
  std::string out = "| key | default | unit | bounds | meaning |\n|---|---|---|---|---|\n";
  Struct value;
  value.describe(*make_table_writer(out));
  return out;
}

/// The candidate with the smallest edit distance to `name`, or empty where none is near.
[[nodiscard]] std::string_view nearest_name(std::string_view name,
                                            const std::vector<std::string>& candidates);

}  // namespace coop::config
