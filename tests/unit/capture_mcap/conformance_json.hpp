#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "capture/mcap/reader.hpp"

/// Cases of the conformance suite, from and to its JSON: a record is {"type", "fields": [[name,
/// value] ...]} with fields sorted by name, numbers as decimal text and bytes as such numbers.
namespace coop::mcap::conformance {

struct Case {
  std::string name;
  std::set<std::string> features;
  nlohmann::json records;  // the file's, in order

  [[nodiscard]] bool has(const char* feature) const { return features.contains(feature); }
};

[[nodiscard]] Case load(const std::filesystem::path& path);
/// The file the case describes, made by our writer.
[[nodiscard]] std::vector<std::byte> write(const Case& one);
/// All records of a file, those of chunks in the chunk's place, as the suite wants them told.
[[nodiscard]] nlohmann::json read_records(std::vector<std::byte> bytes);
[[nodiscard]] nlohmann::json read_messages(Reader& reader);
[[nodiscard]] nlohmann::json messages_by_time(const Case& one);
[[nodiscard]] std::size_t count(const Case& one, const std::string& type);

}  // namespace coop::mcap::conformance
