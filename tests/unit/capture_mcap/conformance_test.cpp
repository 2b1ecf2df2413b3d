/// The conformance suite of the format's authors: each case is a JSON file of records and the
/// SHA-256 of the file that has just these bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "core/atomic_file.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/conformance_json.hpp"

namespace coop::mcap {
namespace {

using conformance::Case;

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const auto folder = coop::test::shared_data("ros2/mcap_conformance");
  if (!folder) return cases;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
    if (entry.path().extension() == ".json") cases.push_back(conformance::load(entry.path()));
  }
  std::ranges::sort(cases, {}, &Case::name);
  return cases;
}

std::map<std::string, std::string> published_hashes() {
  std::map<std::string, std::string> hashes;
  std::ifstream table(*coop::test::shared_data("ros2/mcap_conformance/LFS_SHA256.tsv"));
  std::string path;
  std::string hash;
  std::string size;
  while (table >> path >> hash >> size) hashes[std::filesystem::path(path).stem()] = hash;
  return hashes;
}

/// By the program of the same name: of all files of the folder.
std::map<std::string, std::string> hashes_of_files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> hashes;
  const std::string command = "sha256sum " + folder.string() + "/*.mcap";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::array<char, 4096> line{};
  while (std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
    const std::string text = line.data();
    const std::size_t space = text.find(' ');
    std::filesystem::path path = text.substr(text.rfind('/') + 1);
    hashes[path.stem()] = text.substr(0, space);
  }
  return hashes;
}

#define NEEDS_THE_SUITE(cases) \
  if ((cases).empty()) GTEST_SKIP() << "not run: the conformance suite is absent"

TEST(Conformance, TheWriterMakesTheSameBytes) {
  const std::vector<Case> cases = all_cases();
  NEEDS_THE_SUITE(cases);
  EXPECT_GT(cases.size(), 400U);
  const coop::test::TemporaryFolder folder;
  for (const Case& one : cases) {
    const std::vector<std::byte> bytes = conformance::write(one);
    std::ofstream(folder.path() / (one.name + ".mcap"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  const auto published = published_hashes();
  const auto ours = hashes_of_files_in(folder.path());
  for (const Case& one : cases) {
    ASSERT_TRUE(published.contains(one.name)) << one.name;
    EXPECT_EQ(ours.at(one.name), published.at(one.name)) << one.name;
  }
}

TEST(Conformance, ReadRecordByRecordTheFilesGiveWhatTheSuiteSays) {
  const std::vector<Case> cases = all_cases();
  NEEDS_THE_SUITE(cases);
  for (const Case& one : cases) {
    EXPECT_EQ(conformance::read_records(conformance::write(one)), one.records) << one.name;
  }
}

TEST(Conformance, ReadByTheReaderTheFilesGiveTheirMessagesInTimeOrder) {
  const std::vector<Case> cases = all_cases();
  NEEDS_THE_SUITE(cases);
  for (const Case& one : cases) {
    Reader reader(open_memory(conformance::write(one)));
    EXPECT_TRUE(reader.summary().complete) << one.name << ": " << reader.summary().defect;
    EXPECT_EQ(conformance::read_messages(reader), conformance::messages_by_time(one)) << one.name;
    EXPECT_EQ(reader.summary().attachments.size(),
              reader.summary().scanned || one.has("ax") ? conformance::count(one, "Attachment") : 0)
        << one.name;
  }
}

}  // namespace
}  // namespace coop::mcap
